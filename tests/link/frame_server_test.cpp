#include "kestrel/link/frame_server.hpp"

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "kestrel/link/autopilot_link.hpp"
#include "kestrel/link/frame_reader.hpp"
#include "kestrel/link/stream_socket.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

const FramePlace kAnyPort{{"127.0.0.1", 0}, {}};

FrameHeader numbered(std::uint64_t number) {
  FrameHeader made;
  made.width_px = 640;
  made.height_px = 480;
  made.number = number;
  made.capture_s = link_clock_s();
  return made;
}

const std::vector<std::uint8_t> kPixels(640 * 480, 7);
const Bytes kBytes{kPixels.data(), kPixels.size()};

/// Serves until it is done, at most for some seconds.
template <class Done>
bool serve_until(FrameServer& server, const Done& done) {
  const double end_s = link_clock_s() + 10;
  while (!done() && link_clock_s() < end_s) server.serve(0.005);
  return done();
}

TEST(FrameServer, APublishedFrameIsSentToEachReader) {
  FrameServer server(kAnyPort);
  FrameReader first(server.place());
  FrameReader second(server.place());
  ASSERT_TRUE(serve_until(server, [&] { return server.counts().readers == 2; }));
  server.publish(numbered(1), kBytes);
  EXPECT_TRUE(serve_until(server, [&] { return server.counts().sent == 2; }));
  EXPECT_EQ(server.counts().published, 1);
  EXPECT_EQ(server.counts().replaced, 0);
}

// 60 frames are 18 MB, more than the kernel holds: one reads them, one only listens. The newest
// is what waits for the latter, and the former is not held up.
TEST(FrameServer, AReaderThatDoesNotReadLosesFramesAndHoldsUpNobody) {
  FrameServer server(kAnyPort);
  const StreamSocket deaf = StreamSocket::connecting_to(server.place().address);
  FrameReader keen(server.place());
  ASSERT_TRUE(serve_until(server, [&] { return server.counts().readers == 2; }));
  for (std::uint64_t k = 0; k < 60; ++k) {
    server.publish(numbered(k), kBytes);
    ASSERT_TRUE(serve_until(server, [&] { return keen.counts().received == long(k) + 1; }));
  }
  EXPECT_GT(server.counts().replaced, 10);
  EXPECT_EQ(server.counts().sent + server.counts().replaced, 2 * 60 - 2);  // one begun, one waits
}

TEST(FrameServer, AReaderThatLeavesIsForgotten) {
  FrameServer server(kAnyPort);
  for (std::size_t k = 0; k < 2 * FrameServer::kMaxReaders; ++k) {
    const StreamSocket passing = StreamSocket::connecting_to(server.place().address);
    ASSERT_TRUE(serve_until(server, [&] { return server.counts().readers == long(k) + 1; }));
  }
  server.serve(0.01);
  EXPECT_EQ(server.counts().refused, 0);
}

TEST(FrameServer, ThereAreNoMoreReadersThanItIsMadeFor) {
  FrameServer server(kAnyPort);
  std::vector<std::unique_ptr<StreamSocket>> all;
  for (std::size_t k = 0; k < FrameServer::kMaxReaders + 2; ++k) {
    all.push_back(
        std::make_unique<StreamSocket>(StreamSocket::connecting_to(server.place().address)));
  }
  EXPECT_TRUE(serve_until(server, [&] { return server.counts().refused == 2; }));
}

TEST(FrameServer, AHeaderThatDoesNotFitItsPixelsIsAMistake) {
  FrameServer server(kAnyPort);
  EXPECT_THROW(server.publish(numbered(0), kBytes.after(1)), std::invalid_argument);
  FrameHeader wide = numbered(0);
  wide.width_px = kMaxFrameSide_px + 1;
  EXPECT_THROW(server.publish(wide, kBytes), std::invalid_argument);
  EXPECT_THROW(server.publish({}, {}), std::invalid_argument);
}

TEST(FrameServer, ALocalSocketIsForThisUserAndGoesWithTheServer) {
  const test::TempFolder folder;
  const FramePlace place{{}, folder / "frames"};
  {
    const FrameServer server(place);
    struct stat found {};
    ASSERT_EQ(::stat(place.path.c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777, 0600);
    EXPECT_THAT(test::message_of([&] { FrameServer{place}; }),
                testing::HasSubstr("another program listens there"));
  }
  EXPECT_FALSE(std::filesystem::exists(place.path));
}

TEST(FrameServer, APortThatIsTakenIsSaid) {
  const FrameServer server(kAnyPort);
  EXPECT_THAT(test::message_of([&] { FrameServer{server.place()}; }),
              testing::HasSubstr("cannot listen"));
}

}  // namespace
}  // namespace kestrel
