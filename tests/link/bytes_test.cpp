#include "kestrel/link/bytes.hpp"

#include <array>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

constexpr std::array<std::uint8_t, 3> kData = {1, 2, 3};

TEST(Bytes, FirstAndAfterPartThem) {
  const Bytes all{kData.data(), kData.size()};
  for (std::size_t count = 0; count <= 3; ++count) {
    EXPECT_EQ(all.first(count).size, count);
    EXPECT_EQ(all.after(count).size, 3 - count);
    EXPECT_EQ(all.first(count).end(), all.data + count);
    EXPECT_EQ(all.after(count).end(), all.after(count).data + 3 - count);
  }
  EXPECT_EQ(all.after(1).data[0], 2);
}

TEST(Bytes, NeverGrow) {
  const Bytes all{kData.data(), kData.size()};
  EXPECT_EQ(all.first(4).size, 3u);
  EXPECT_EQ(all.after(4).size, 0u);
  EXPECT_EQ(all.after(std::size_t(-1)).size, 0u);
  EXPECT_EQ(all.after(4).data, all.end());
  EXPECT_EQ(Bytes{}.after(1).size, 0u);
}

}  // namespace
}  // namespace kestrel
