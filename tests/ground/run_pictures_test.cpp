#include "kestrel/ground/run_pictures.hpp"

#include <gtest/gtest.h>

#include "kestrel/io/image_codec.hpp"
#include "kestrel/io/video_writer.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

/// How bright the picture of a frame is: far enough apart for a video's losses (a few grey levels).
int brightness(std::int64_t frame) { return int(20 + 20 * frame); }

class Pictures : public testing::Test {
 protected:
  std::filesystem::path video(int columns, int frames) {
    const auto path = folder_ / "run.mp4";
    VideoWriter writer(path, 30);
    for (int i = 0; i < frames; ++i) {
      cv::Mat picture(48, columns, CV_8UC3, cv::Scalar::all(0));
      picture.colRange(columns / 2, columns).setTo(cv::Scalar::all(brightness(i)));
      writer.write(picture);
    }
    writer.close();
    return writer.path();
  }
  SequenceOptions images(int frames) {
    for (int i = 0; i < frames; ++i) {
      if (i == 3) continue;  // missing
      const auto png = encode_png(cv::Mat(48, 64, CV_8UC1, cv::Scalar(brightness(i))));
      char name[16];
      std::snprintf(name, sizeof name, "%03d.png", i);
      folder_.write(name, std::string(png.begin(), png.end()));
    }
    SequenceOptions options;
    options.input = (folder_ / "%03d.png").string();
    return options;
  }
  const test::TempFolder folder_;
};

TEST_F(Pictures, OfAVideoComeInAnyOrder) {
  RunPictures pictures(video(128, 10), 64);
  EXPECT_STREQ(pictures.kind(), "video");
  for (const int row : {0, 4, 4, 9, 2, 3, 0}) {
    const cv::Mat picture = pictures.picture(row, 1000 + row);
    ASSERT_EQ(picture.cols, 64) << row;
    EXPECT_NEAR(picture.at<unsigned char>(24, 40), brightness(row), 6) << row;
  }
  EXPECT_TRUE(pictures.picture(10, 0).empty()) << "a video that ends before the log";
  EXPECT_FALSE(pictures.picture(1, 0).empty()) << "and goes on before its end";
}

TEST_F(Pictures, ABlackEdgeIsNotTheViewFromOutside) {
  RunPictures pictures(video(64, 2), 63);
  const cv::Mat picture = pictures.picture(1, 1);
  ASSERT_EQ(picture.cols, 63);
  EXPECT_NEAR(picture.at<unsigned char>(24, 10), 0, 6) << "from the left";
}

TEST_F(Pictures, OfASequenceGoByTheFramesNumber) {
  RunPictures pictures(images(9));
  EXPECT_STREQ(pictures.kind(), "sequence");
  for (const int frame : {5, 6, 8, 0, 7}) {
    EXPECT_EQ(int(pictures.picture(0, frame).at<unsigned char>(24, 24)), brightness(frame))
        << frame;
  }
  EXPECT_TRUE(pictures.picture(0, 3).empty()) << "a file that is missing";
  EXPECT_TRUE(pictures.picture(0, 99).empty());
  EXPECT_FALSE(pictures.picture(0, 4).empty());
}

TEST_F(Pictures, NoneAreEmptyAndNoVideoIsAnError) {
  RunPictures none;
  EXPECT_STREQ(none.kind(), "none");
  EXPECT_TRUE(none.picture(0, 0).empty());
  EXPECT_THROW(RunPictures(folder_.write("run.mp4", "cut"), 0), std::runtime_error);
}

}  // namespace
}  // namespace kestrel
