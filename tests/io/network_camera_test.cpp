#include "kestrel/io/network_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/io/live_camera.hpp"

#include "io/mjpeg_server.hpp"
#include "io/quick_live.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using test::MjpegServer;
using test::quick;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Takes frames until the source fails; what it says then.
std::string end_of(FrameSource& source) {
  return message_of([&] {
    while (source.next()) continue;
  });
}

TEST(NetworkCamera, GivesNewFramesWithGrowingStamps) {
  const MjpegServer server(60, MjpegServer::Then::End);
  const auto source = open_live(server.url(), quick(5, 0.3));
  std::int64_t index = -1;
  double stamp_s = -1;
  int images = 0;
  const std::string end = message_of([&] {
    while (const auto frame = source->next()) {
      EXPECT_GT(frame->index, index);
      EXPECT_GT(frame->stamp_s, stamp_s);
      index = frame->index;
      stamp_s = frame->stamp_s;
      if (!has_image(*frame)) continue;
      EXPECT_EQ(frame->gray.size(), cv::Size(64, 48));
      ++images;
    }
  });
  EXPECT_GT(images, 0);
  EXPECT_THAT(end, AllOf(HasSubstr(server.url()), HasSubstr("no picture for")));
  ASSERT_FALSE(source->skipped().empty());
  EXPECT_THAT(source->skipped()[0], HasSubstr("the stream ended"));
}

TEST(NetworkCamera, TheIndexIsThePicturesNumber) {
  const MjpegServer server(60, MjpegServer::Then::Stall);
  LiveOptions options = quick(5, 1);
  options.blind_s = 20;
  options.stall_timeout_s = 20;
  const auto source = open_live(server.url(), options);
  for (std::int64_t index = -1; index < 50;) {
    const auto frame = source->next();
    index = frame->index;
    // The number that the server wrote in grey; a flat JPEG keeps it within a level or two.
    ASSERT_NEAR(frame->gray.at<uchar>(20, 20), double(index % 20) * 10, 3);
  }
}

TEST(NetworkCamera, SaysThatItStalls) {
  const MjpegServer server(40, MjpegServer::Then::Stall);
  const auto source = open_live(server.url(), quick(5, 0.3));
  EXPECT_THAT(end_of(*source), HasSubstr("no picture for"));
  EXPECT_THAT(source->skipped().at(0), HasSubstr("no picture for 0.2 s"));
}

TEST(NetworkCamera, TellsThatPicturesComeDamaged) {
  const test::MjpegServer server(20, test::MjpegServer::Then::Spoil);
  const auto source = open_live(server.url(), quick(10, 20));
  auto frame = source->next();
  EXPECT_TRUE(has_image(*frame));
  while (has_image(*frame)) frame = source->next();  // and then the loop is told that it is blind
  EXPECT_GT(source->status().damaged, 0);
  EXPECT_EQ(source->status().connections, 1) << "it is there: nothing is gained by a new one";
}

}  // namespace
}  // namespace kestrel
