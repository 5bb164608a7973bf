#include "kestrel/link/frame_place.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

TEST(FramePlace, IsReadAsItIsWritten) {
  for (const char* text : {"127.0.0.1:14570", "[::1]:14570", "./frames", "/tmp/frames", "a/b:3"}) {
    EXPECT_EQ(to_string(parse_frame_place(text)), text);
  }
  EXPECT_EQ(to_string(parse_frame_place("localhost:7")), "127.0.0.1:7");
}

TEST(FramePlace, AnythingWithASlashIsAPath) {
  EXPECT_TRUE(parse_frame_place("./127.0.0.1:14570").is_local());
  EXPECT_FALSE(parse_frame_place("127.0.0.1:14570").is_local());
  EXPECT_EQ(parse_frame_place("127.0.0.1:14570").address.port, 14570);
}

TEST(FramePlace, WhatIsNeitherIsRefusedWithTheWayToWriteIt) {
  for (const char* text : {"", "frames", "example.org:14570", "127.0.0.1", "127.0.0.1:99999"}) {
    EXPECT_THROW(parse_frame_place(text), std::invalid_argument) << text;
    EXPECT_THAT(test::message_of([&] { parse_frame_place(text); }),
                testing::HasSubstr("127.0.0.1:14570"));
  }
}

}  // namespace
}  // namespace kestrel
