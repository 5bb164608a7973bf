#include "kestrel/link/crc.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

/// The definition: a division of polynomials, one bit at a time.
std::uint16_t crc_by_bits(const test::Buffer& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    for (int i = 0; i < 8; ++i) {
      const bool carry = ((crc ^ byte >> i) & 1) != 0;
      crc = carry ? crc >> 1 ^ 0x8408 : crc >> 1;
    }
  }
  return std::uint16_t(crc);
}

TEST(Crc, HasTheCheckValueOfMcrf4xx) {
  const test::Buffer digits = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc_add(kCrcStart, test::view(digits)), 0x6F91);
  EXPECT_EQ(crc_add(kCrcStart, Bytes{}), kCrcStart);
}

TEST(Crc, IsTheDivisionBitByBit) {
  test::Random random("crc");
  for (int i = 0; i < 300; ++i) {
    test::Buffer bytes(std::size_t(random.integer(0, 280)));
    for (auto& byte : bytes) byte = test::random_byte(random);
    EXPECT_EQ(crc_add(kCrcStart, test::view(bytes)), crc_by_bits(bytes));
  }
}

TEST(Crc, ContinuesWhereItStopped) {
  const test::Buffer bytes = {7, 0, 255, 13};
  const std::uint16_t half = crc_add(kCrcStart, test::view(bytes).first(2));
  EXPECT_EQ(crc_add(half, test::view(bytes).after(2)), crc_add(kCrcStart, test::view(bytes)));
}

}  // namespace
}  // namespace kestrel
