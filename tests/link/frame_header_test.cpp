#include "kestrel/link/frame_header.hpp"

#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

using testing::HasSubstr;

FrameHeader some_header() {
  FrameHeader header;
  header.width_px = 640;
  header.height_px = 480;
  header.number = 0x0102030405060708;
  header.capture_s = 12.25;
  header.sent_s = 12.5;
  return header;
}

std::string complaint(const std::vector<std::uint8_t>& bytes) {
  const auto decoded = decode_frame_header({bytes.data(), bytes.size()});
  const auto* words = std::get_if<std::string>(&decoded);
  return words != nullptr ? *words : "none";
}

std::vector<std::uint8_t> bytes_of(const FrameHeader& header) {
  const auto bytes = encode(header);
  return {bytes.begin(), bytes.end()};
}

// The layout that the header file promises, byte by byte: another program may rely on it.
TEST(FrameHeader, LiesOnTheWireAsDescribed) {
  const auto bytes = encode(some_header());
  const std::vector<std::uint8_t> expected = {
      'K', 'S', 'T', 'F', 1, 0, 40, 0, 0x80, 2,    0,    0,    0xE0, 1, 0, 0, 8, 7, 6,    5,
      4,   3,   2,   1,   0, 0, 0,  0, 0,    0x80, 0x28, 0x40, 0,    0, 0, 0, 0, 0, 0x29, 0x40};
  EXPECT_EQ(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), expected);
  EXPECT_EQ(some_header().pixels(), 307200u);
}

TEST(FrameHeader, IsReadAsItWasWritten) {
  test::Random random("frame header");
  for (int i = 0; i < 200; ++i) {
    FrameHeader header;
    header.width_px = std::uint32_t(random.integer(1, int(kMaxFrameSide_px)));
    header.height_px = std::uint32_t(random.integer(1, int(kMaxFrameSide_px)));
    header.number = std::uint64_t(random.integer(0, 1 << 30)) << 20;
    header.capture_s = random.uniform(-1e6, 1e6);
    header.sent_s = header.capture_s + random.uniform(0, 10);
    const auto bytes = encode(header);
    const auto decoded = decode_frame_header({bytes.data(), bytes.size()});
    ASSERT_TRUE(std::holds_alternative<FrameHeader>(decoded));
    const auto& read = std::get<FrameHeader>(decoded);
    EXPECT_EQ(read.width_px, header.width_px);
    EXPECT_EQ(read.height_px, header.height_px);
    EXPECT_EQ(read.number, header.number);
    EXPECT_EQ(read.capture_s, header.capture_s);
    EXPECT_EQ(read.sent_s, header.sent_s);
  }
}

TEST(FrameHeader, WhatIsWrongIsSaid) {
  std::vector<std::uint8_t> bytes = bytes_of(some_header());
  EXPECT_EQ(complaint(bytes), "none");
  bytes[0] = 'k';
  EXPECT_THAT(complaint(bytes), HasSubstr("KSTF"));
  bytes = bytes_of(some_header());
  bytes[4] = 2;
  EXPECT_THAT(complaint(bytes), HasSubstr("version 2"));
  bytes = bytes_of(some_header());
  bytes[6] = 48;
  EXPECT_THAT(complaint(bytes), HasSubstr("headers of 48 bytes"));
  bytes = bytes_of(some_header());
  bytes.pop_back();
  EXPECT_THAT(complaint(bytes), HasSubstr("39 bytes"));
}

// Whatever the numbers say, a reader never allocates more than the largest frame.
TEST(FrameHeader, ASizeOrTimeThatCannotBeIsRefused) {
  const auto changed = [](auto change) {
    FrameHeader header = some_header();
    change(header);
    return complaint(bytes_of(header));
  };
  EXPECT_THAT(changed([](FrameHeader& h) { h.width_px = 0; }), HasSubstr("0x480"));
  EXPECT_THAT(changed([](FrameHeader& h) { h.height_px = 0; }), HasSubstr("640x0"));
  EXPECT_THAT(changed([](FrameHeader& h) { h.width_px = kMaxFrameSide_px + 1; }),
              HasSubstr("8193x480"));
  EXPECT_THAT(changed([](FrameHeader& h) { h.height_px = 0xFFFFFFFF; }), HasSubstr("4294967295"));
  EXPECT_THAT(changed([](FrameHeader& h) { h.sent_s = 12.2; }), HasSubstr("before"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(changed([&](FrameHeader& h) { h.capture_s = nan; }), HasSubstr("no time"));
  EXPECT_THAT(changed([&](FrameHeader& h) { h.sent_s = nan; }), HasSubstr("no time"));
}

TEST(FrameHeader, AnyBytesAreAHeaderOrAComplaint) {
  test::Random random("noise for a frame header");
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes = bytes_of(some_header());
    for (int k = random.integer(1, 6); k > 0; --k) {
      bytes[std::size_t(random.integer(0, 39))] = std::uint8_t(random.integer(0, 255));
    }
    const auto decoded = decode_frame_header({bytes.data(), bytes.size()});
    if (const auto* header = std::get_if<FrameHeader>(&decoded)) {
      EXPECT_GT(header->pixels(), 0u);
      EXPECT_LE(header->pixels(), std::size_t(kMaxFrameSide_px) * kMaxFrameSide_px);
    }
  }
}

}  // namespace
}  // namespace kestrel
