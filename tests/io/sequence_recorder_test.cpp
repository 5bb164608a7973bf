#include "kestrel/io/sequence_recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/io/sequence.hpp"
#include "kestrel/io/sequence_file.hpp"
#include "kestrel/io/video_reader.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::HasSubstr;

cv::Mat picture(int k) {
  cv::Mat gray(48, 64, CV_8UC1, cv::Scalar(20 + 5 * k));
  gray.at<uchar>(k, k) = 255;
  return gray;
}

TEST(SequenceRecorder, WhatItWritesIsReadBackAsItWas) {
  const test::TempFolder folder;
  const auto output = folder / "a/b";
  SequenceRecorder recorder(output, {"camera:0 \"left\"\n", PixelBox{1, 2, 30, 20}}, 30);
  // Picture 2 was lost, and the rate is not steady.
  const std::vector<std::pair<std::int64_t, double>> taken = {{0, 0.25}, {1, 0.29}, {3, 0.7}};
  for (const auto& [index, stamp_s] : taken) recorder.write(index, stamp_s, picture(int(index)));
  recorder.close();
  EXPECT_EQ(recorder.pictures(), 3);
  const SequenceDescription read = load_sequence(recorder.result());
  EXPECT_EQ(read.template_px.width, 30);
  EXPECT_EQ(read.what, "recorded from camera:0 \"left\" ");
  const auto source = open_sequence(read.sequence);
  for (const auto& [index, stamp_s] : taken) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->index, index);
    EXPECT_EQ(frame->stamp_s, stamp_s);
    EXPECT_EQ(cv::norm(frame->gray, picture(int(index)), cv::NORM_INF), 0);
  }
  EXPECT_FALSE(source->next());
  EXPECT_EQ(source->skipped().size(), 1u);  // the lost one is named
}

TEST(SequenceRecorder, AnImageWithoutAStampIsNamed) {
  const test::TempFolder folder;
  SequenceRecorder recorder(folder / "s", {"x", {}}, 30);
  for (int k = 0; k < 3; ++k) recorder.write(k, k, picture(k));
  folder.write("s/stamps.csv", "frame,stamp_s\n0,0\n2,2\n");
  const SequenceDescription read = load_sequence(recorder.result());
  EXPECT_EQ(read.template_px.u, 16);  // the middle
  const auto source = open_sequence(read.sequence);
  EXPECT_EQ(source->next()->index, 0);
  EXPECT_EQ(source->next()->index, 2);
  EXPECT_EQ(source->skipped().at(0), "frame 1: has no stamp");
}

TEST(SequenceRecorder, AVideoKeepsTheTimes) {
  const test::TempFolder folder;
  SequenceRecorder recorder(folder / "v.mp4", {"x", {}}, 30);
  const std::vector<double> stamps = {3, 3.04, 3.5, 3.52};
  for (std::size_t k = 0; k < stamps.size(); ++k)
    recorder.write(std::int64_t(k), stamps[k], picture(int(k)));
  recorder.close();
  VideoReader video(recorder.result());
  for (const double stamp_s : stamps) {
    const auto shown = video.next();
    ASSERT_TRUE(shown);
    EXPECT_NEAR(*shown->time_s, stamp_s - 3, 1e-4);  // ticks of 1/90000 s
  }
  EXPECT_FALSE(video.next());
  EXPECT_TRUE(std::filesystem::exists(folder / "v.csv"));
}

TEST(SequenceRecorder, WritesNothingOver) {
  const test::TempFolder folder;
  folder.write("old/x", "x");
  folder.write("v.mp4", "x");
  EXPECT_THAT(message_of([&] {
                SequenceRecorder(folder / "old", {"x", {}}, 30);
              }),
              HasSubstr("is there already"));
  EXPECT_THAT(message_of([&] {
                SequenceRecorder(folder / "v.mp4", {"x", {}}, 30);
              }),
              HasSubstr("is there already"));
  EXPECT_THROW(SequenceRecorder("/proc/none/x", {"x", {}}, 30), std::runtime_error);
}

}  // namespace
}  // namespace kestrel
