#include "kestrel/ground/stream_frame.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(StreamFrame, LengthsComeFirstMostSignificantByteFirst) {
  const std::string bytes = stream_frame("{}", std::vector<unsigned char>(258, 0xD8));
  ASSERT_EQ(bytes.size(), 8u + 2 + 258);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\0\0\0\x02\0\0\x01\x02", 8));
  EXPECT_EQ(bytes.substr(8, 2), "{}");
}

TEST(StreamFrame, FramesComeBackHoweverTheStreamIsCut) {
  std::string stream;
  for (int i = 0; i < 5; ++i) {
    stream += stream_frame("{\"frame\":" + std::to_string(i) + "}",
                           std::vector<unsigned char>(std::size_t(300 * i), (unsigned char)(i)));
  }
  for (const std::size_t piece :
       {std::size_t(1), std::size_t(7), std::size_t(1000), stream.size()}) {
    StreamReader reader;
    int count = 0;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      reader.add(std::string_view(stream).substr(at, piece));
      while (const auto frame = reader.next()) {
        EXPECT_EQ(frame->json, "{\"frame\":" + std::to_string(count) + "}");
        EXPECT_EQ(frame->jpeg, std::string(std::size_t(300 * count), char(count)));
        ++count;
      }
    }
    EXPECT_EQ(count, 5) << "in pieces of " << piece;
  }
}

TEST(StreamFrame, ALengthThatNoFrameHasIsDamage) {
  StreamReader reader;
  reader.add(std::string("\xFF\0\0\0\0\0\0\0", 8));
  EXPECT_THROW(reader.next(), std::runtime_error);
  EXPECT_THROW(stream_frame(std::string(kMaxStreamPart + 1, ' '), {}), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
