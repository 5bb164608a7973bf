#include "kestrel/vision/template.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/vision/window.hpp"

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

const TrackOptions kPaper = [] {
  TrackOptions options;
  options.method = TrackMethod::Paper;
  return options;
}();

using testing::AllOf;
using testing::HasSubstr;

cv::Mat scene() {
  test::Random random("scene");
  return test::texture(200, 160, random);
}

std::string complaint(const cv::Mat& gray, const PixelBox& box,
                      const TrackOptions& options = kPaper) {
  try {
    const Template model(gray, box, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Template, KeepsItsPictureWhenTheImageChanges) {
  cv::Mat image = scene();
  const cv::Mat before = image(cv::Rect(50, 40, 90, 70)).clone();
  const Template model(image, {50, 40, 90, 70}, kPaper);
  image.setTo(0);
  EXPECT_EQ(model.width(), 90);
  EXPECT_EQ(model.height(), 70);
  EXPECT_EQ(cv::norm(model.picture(), before, cv::NORM_INF), 0);
  EXPECT_EQ(model.box().u, 50);
}

TEST(Template, HasTheKeypointsOfTheFirstWindowThatLieInIt) {
  const cv::Mat image = scene();
  const PixelBox box{50, 40, 90, 70};
  const Template model(image, box, kPaper);
  const Keypoints& own = model.keypoints();
  ASSERT_GT(own.at.size(), 20U);
  ASSERT_EQ(own.descriptors.rows, int(own.at.size()));
  const Keypoints seen = detect_keypoints(image, first_window(box, 200, 160), {});
  std::size_t next = 0;
  for (std::size_t i = 0; i < seen.at.size(); ++i) {
    const double u = seen.at[i].u - 50;
    const double v = seen.at[i].v - 40;
    if (u < 0 || v < 0 || u > 89 || v > 69) continue;
    ASSERT_LT(next, own.at.size());
    EXPECT_EQ(own.at[next].u, u);
    EXPECT_EQ(own.at[next].v, v);
    EXPECT_EQ(cv::norm(own.descriptors.row(int(next)), seen.descriptors.row(int(i))), 0);
    ++next;
  }
  EXPECT_EQ(next, own.at.size());
}

TEST(Template, CanBeTheWholeImage) {
  const cv::Mat image = scene();
  EXPECT_NO_THROW(Template(image, {0, 0, 200, 160}, kPaper));
}

TEST(Template, SaysWhatToDoAboutARectangleOutside) {
  const cv::Mat image = scene();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const PixelBox& box :
       {PixelBox{-1, 0, 50, 50}, PixelBox{0, -1, 50, 50}, PixelBox{160, 0, 50, 50},
        PixelBox{0, 120, 50, 50}, PixelBox{nan, 0, 50, 50}, PixelBox{0, 0, nan, 50}}) {
    EXPECT_THAT(complaint(image, box), AllOf(HasSubstr("not inside the 200x160 image"),
                                             HasSubstr("give x,y,width,height within it")));
  }
  EXPECT_THAT(complaint(image, {160, 0, 50, 50}), HasSubstr("160,0,50,50"));
}

TEST(Template, SaysWhatToDoAboutARectangleTooSmall) {
  const cv::Mat image = scene();
  EXPECT_THAT(complaint(image, {50, 40, 15, 60}), HasSubstr("at least 16x16"));
  EXPECT_THAT(complaint(image, {50, 40, 60, 15}), HasSubstr("at least 16x16"));
  EXPECT_THAT(complaint(image, {50, 40, -60, 60}), HasSubstr("at least 16x16"));
  EXPECT_THAT(complaint(image, {50.5, 40, 60, 60}), HasSubstr("round its numbers"));
}

TEST(Template, SaysWhatToDoAboutTooLittleTexture) {
  cv::Mat flat(160, 200, CV_8U, cv::Scalar(90));
  EXPECT_THAT(complaint(flat, {50, 40, 90, 70}),
              AllOf(HasSubstr("too little texture (0 keypoints, 12 needed)"),
                    HasSubstr("choose a larger or more textured rectangle")));
  cv::rectangle(flat, {80, 60, 30, 25}, cv::Scalar(200), cv::FILLED);  // a few corners, no more
  EXPECT_THAT(complaint(flat, {50, 40, 90, 70}), HasSubstr("too little texture"));
}

TEST(Template, SaysWhatToDoAboutAnImageThatIsNotGrey) {
  EXPECT_THAT(complaint(cv::Mat(160, 200, CV_8UC3, cv::Scalar::all(1)), {50, 40, 90, 70}),
              HasSubstr("convert it first"));
  EXPECT_THAT(complaint(cv::Mat(), {0, 0, 20, 20}), HasSubstr("not 8-bit grey"));
}

TEST(Template, RefusesOptionsOutOfRange) {
  TrackOptions options = kPaper;
  options.sift.sigma = -1;
  EXPECT_THROW(Template(scene(), {50, 40, 90, 70}, options), std::invalid_argument);
  options = kPaper;
  options.match.ratio = 2;
  EXPECT_THROW(Template(scene(), {50, 40, 90, 70}, options), std::invalid_argument);
  options = {};
  options.blocks.noise_grey = 0;
  EXPECT_THROW(Template(scene(), {50, 40, 90, 70}, options), std::invalid_argument);
}

TEST(Template, LearnsForItsMethodOnly) {
  const Template paper(scene(), {50, 40, 90, 70}, kPaper);
  EXPECT_FALSE(paper.keypoints().at.empty());
  EXPECT_TRUE(paper.features().at.empty());
  EXPECT_TRUE(paper.blocks().levels.empty());
  TrackOptions options;
  for (const TrackMethod method : {TrackMethod::Detect, TrackMethod::Hybrid}) {
    options.method = method;
    const Template model(scene(), {50, 40, 90, 70}, options);
    EXPECT_TRUE(model.keypoints().at.empty());
    EXPECT_FALSE(model.features().at.empty());
    EXPECT_FALSE(model.blocks().levels.empty());
    EXPECT_EQ(model.blurred().empty(), method == TrackMethod::Detect);  // which follows nothing
  }
}

TEST(Template, HasTheFeaturesAndBlocksOfItsRectangle) {
  const cv::Mat image = scene();
  const PixelBox box{50, 40, 90, 70};
  const Template model(image, box, {});
  const LearnedFeatures alone = learn_features(image, box, {});
  ASSERT_EQ(model.features().at.size(), alone.at.size());
  ASSERT_GT(alone.at.size(), 100U);  // nine views of some twenty keypoints each
  for (std::size_t i = 0; i < alone.at.size(); ++i) {
    EXPECT_EQ(model.features().descriptors[i].bin, alone.descriptors[i].bin);
    EXPECT_GE(alone.at[i].in_template.u, 0);
    EXPECT_LE(alone.at[i].in_template.u, 89);
    EXPECT_LE(alone.at[i].in_template.v, 69);
  }
  EXPECT_EQ(model.blocks().width, 90);
  EXPECT_EQ(model.blocks().height, 70);
  ASSERT_EQ(model.blocks().levels.size(), 3U);  // 70, 35 and 17 px high; 8 would be too little
  EXPECT_EQ(model.blocks().levels[0].textures,
            template_blocks(model.picture(), {}).levels[0].textures);
}

TEST(Template, ForTheHybridSaysWhatToDoAboutTooLittleTexture) {
  const cv::Mat flat(160, 200, CV_8U, cv::Scalar(90));
  EXPECT_THAT(complaint(flat, {50, 40, 90, 70}, {}),
              AllOf(HasSubstr("too little texture (0 textured blocks of 8x8 px, 8 needed)"),
                    HasSubstr("choose a larger or more textured rectangle")));
  // Four blocks, all of them textured: fewer than can be told from chance.
  EXPECT_THAT(complaint(scene(), {50, 40, 16, 16}, {}), HasSubstr("(4 textured blocks"));
}

TEST(Template, ForTheHybridRefusesTheSameRectangles) {
  EXPECT_THAT(complaint(scene(), {160, 0, 50, 50}, {}), HasSubstr("not inside the 200x160 image"));
  EXPECT_THAT(complaint(scene(), {50, 40, 15, 60}, {}), HasSubstr("at least 16x16"));
  EXPECT_THAT(complaint(scene(), {50.5, 40, 60, 60}, {}), HasSubstr("round its numbers"));
  EXPECT_THAT(complaint(cv::Mat(160, 200, CV_8UC3, cv::Scalar::all(1)), {50, 40, 90, 70}, {}),
              HasSubstr("convert it first"));
}

TEST(Template, ForTheHybridNeedsNoKeypoints) {
  // A smooth wave, which has no corner: nothing for SIFT, but every block shows it.
  cv::Mat wave(160, 200, CV_8U);
  for (int v = 0; v < wave.rows; ++v) {
    for (int u = 0; u < wave.cols; ++u) {
      wave.at<uchar>(v, u) = uchar(128 + 100 * std::sin(0.0004 * u * u + 0.02 * v));
    }
  }
  EXPECT_THAT(complaint(wave, {50, 40, 90, 70}), HasSubstr("too little texture"));
  EXPECT_EQ(complaint(wave, {50, 40, 90, 70}, {}), "");
}

}  // namespace
}  // namespace kestrel
