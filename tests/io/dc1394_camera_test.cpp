// There is no FireWire camera on the machines that run this: libdc1394 is replaced by the stand-in
// of dc1394_standin.cpp, which ctest preloads.
#include "kestrel/io/dc1394_camera.hpp"

#include <cstdlib>

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::HasSubstr;

class Dc1394 : public ::testing::Test {
 protected:
  void SetUp() override {
    frames_out_ = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "kestrel_dc1394_frames_out"));
    if (frames_out_ == nullptr) GTEST_SKIP() << "run by ctest, which preloads the stand-in";
    unsetenv("KESTREL_DC1394_FAULT");
  }
  void TearDown() override { unsetenv("KESTREL_DC1394_FAULT"); }
  static void inject(const char* fault) { setenv("KESTREL_DC1394_FAULT", fault, 1); }
  /// What is wrong after the frames that came.
  static std::string failure_of(const std::string& guid = "") {
    return message_of([&] {
      const auto camera = open_dc1394(guid, 0.05);
      for (int i = 0; i < 10; ++i) camera->next();
    });
  }
  int (*frames_out_)() = nullptr;
};

TEST_F(Dc1394, GivesTheNewestFrameAndGivesEveryBufferBack) {
  const auto camera = open_dc1394("");
  double stamp_s = -1;
  for (const int expected : {0, 1, 2, 3, 5, 6}) {  // 4 was there with 5, so it is old
    const auto frame = camera->next();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->index, expected);
    EXPECT_EQ(frame->gray.size(), cv::Size(640, 480));
    EXPECT_EQ(frame->gray.at<uchar>(479, 639), expected);
    EXPECT_GE(frame->stamp_s, stamp_s);
    stamp_s = frame->stamp_s;
    EXPECT_EQ(frames_out_(), 0);
  }
  EXPECT_TRUE(camera->skipped().empty());
  EXPECT_FALSE(camera->frame_count().has_value());
}

TEST_F(Dc1394, NamesACorruptFrameAndGoesOn) {
  inject("corrupt");
  const auto camera = open_dc1394("0123456789abcdef");
  EXPECT_EQ(camera->next()->index, 0);
  EXPECT_EQ(camera->next()->index, 2);
  ASSERT_EQ(camera->skipped().size(), 1u);
  EXPECT_EQ(camera->skipped()[0], "frame 1: it arrived corrupt");
  EXPECT_EQ(frames_out_(), 0);
}

TEST_F(Dc1394, SaysThatAnUnpluggedCameraIsSilent) {
  inject("unplugged");
  EXPECT_THAT(failure_of(), HasSubstr("no frame for 0.05 s; check that the camera"));
}

TEST_F(Dc1394, SaysThatTakingAFrameFails) {
  inject("dequeue_error");
  EXPECT_THAT(failure_of(), HasSubstr("taking a frame; check the cable"));
}

TEST_F(Dc1394, SaysWhyItCannotBeOpened) {
  inject("no_bus");
  EXPECT_THAT(failure_of(), HasSubstr("the FireWire bus cannot be opened"));
  inject("no_camera");
  EXPECT_THAT(failure_of(), HasSubstr("no camera on the FireWire bus"));
  inject("odd_modes");
  EXPECT_THAT(failure_of(), HasSubstr("none of the modes"));
  inject("no_bandwidth");
  EXPECT_THAT(failure_of(), HasSubstr("reserving the bus"));
  inject("none");
  EXPECT_THAT(failure_of("12"), HasSubstr("there is 0123456789abcdef"));
  EXPECT_THAT(failure_of("front"), HasSubstr("'front' is no GUID"));
}

}  // namespace
}  // namespace kestrel
