#include "kestrel/io/live_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/mjpeg_server.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using test::MjpegServer;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(OpenLive, SaysWhatAnAddressMayBe) {
  EXPECT_THAT(message_of([] { open_live("ftp://x"); }),
              AllOf(HasSubstr("'ftp://x' is no live camera"), HasSubstr("camera:N")));
  EXPECT_THAT(message_of([] { open_live("camera:front"); }), HasSubstr("is not a number"));
  EXPECT_THAT(message_of([] { open_live("camera:"); }), HasSubstr("e.g. camera:0"));
  EXPECT_THROW(open_live("camera:0", {0, 1}), std::invalid_argument);
  EXPECT_THROW(open_live("camera:0", {1, std::nan("")}), std::invalid_argument);
}

TEST(OpenLive, NamesTheDeviceThatIsMissing) {
  EXPECT_THAT(message_of([] { open_live("camera:99"); }),
              AllOf(HasSubstr("camera:99: there is no /dev/video99"), HasSubstr("connect")));
}

TEST(OpenLive, SaysThatNobodyAnswers) {
  // Port 1 of the loopback: nothing listens there, and the refusal is at once.
  EXPECT_THAT(message_of([] {
                open_live("http://127.0.0.1:1/video", {1, 1});
              }),
              HasSubstr("no video within 1 s; check the address"));
}

TEST(NetworkCamera, GivesNewFramesWithGrowingStampsThenSaysThatItEnded) {
  const MjpegServer server(80, MjpegServer::Then::End);
  const auto source = open_live(server.url(), {5, 2});
  EXPECT_FALSE(source->frame_count().has_value());
  std::int64_t index = -1;
  double stamp_s = -1;
  std::string end;
  int frames = 0;
  try {
    while (const auto frame = source->next()) {
      EXPECT_GT(frame->index, index);
      EXPECT_GE(frame->stamp_s, stamp_s);
      EXPECT_EQ(frame->gray.size(), cv::Size(64, 48));
      EXPECT_EQ(frame->gray.type(), CV_8UC1);
      // The number that the server wrote in grey; a flat JPEG keeps it within a level or two.
      EXPECT_NEAR(frame->gray.at<uchar>(20, 20), double(frame->index % 20) * 10, 3);
      index = frame->index;
      stamp_s = frame->stamp_s;
      ++frames;
    }
  } catch (const std::runtime_error& error) {
    end = error.what();
  }
  EXPECT_GT(frames, 0);
  EXPECT_THAT(end, HasSubstr("the stream ended"));
}

TEST(NetworkCamera, SaysThatItStalls) {
  const MjpegServer server(80, MjpegServer::Then::Stall);
  const auto source = open_live(server.url(), {5, 0.2});
  const std::string end = message_of([&] {
    while (source->next()) continue;
  });
  EXPECT_THAT(end, AllOf(HasSubstr(server.url()), HasSubstr("no frame for 0.2 s")));
}

}  // namespace
}  // namespace kestrel
