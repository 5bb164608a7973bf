#include "kestrel/ground/template_verdict.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Grade = TemplateVerdict::Grade;

/// Spots of every grey in a part of a picture.
cv::Mat spots(const cv::Rect& where) {
  test::Random random("template verdict");
  cv::Mat picture(240, 320, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < where.area() / 150; ++i) {
    const cv::Point at(random.integer(where.x, where.x + where.width - 1),
                       random.integer(where.y, where.y + where.height - 1));
    cv::circle(picture, at, random.integer(2, 7), cv::Scalar(random.integer(0, 255)), -1);
  }
  cv::GaussianBlur(picture, picture, {}, 1);
  return picture;
}

TemplateVerdict verdict_of(const cv::Mat& picture) {
  const TrackOptions options;
  const PixelBox box{40, 30, 240, 180};
  return template_verdict(Template(picture, box, options), options);
}

TEST(TemplateVerdict, TextureAllOverIsGood) {
  const TemplateVerdict v = verdict_of(spots({0, 0, 320, 240}));
  EXPECT_EQ(v.grade, Grade::Good) << v.words;
  EXPECT_EQ(v.spread, 1);
  EXPECT_LT(v.self_likeness, kSomeLikeness);
  EXPECT_GT(v.keypoints, 50);
}

TEST(TemplateVerdict, TextureInOneCornerIsPoor) {
  const TemplateVerdict v = verdict_of(spots({45, 35, 70, 50}));
  EXPECT_EQ(v.grade, Grade::Poor) << v.words;
  EXPECT_LE(v.spread, 1.0 / 3);
}

TEST(TemplateVerdict, AChessboardIsPoorAndSaysWhy) {
  cv::Mat board(240, 320, CV_8UC1, cv::Scalar(40));
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 11; ++x) {
      if ((x + y) % 2 == 0)
        board(cv::Rect(30 * x, 30 * y, 30, 30) & cv::Rect(0, 0, 320, 240)) = 210;
    }
  }
  cv::GaussianBlur(board, board, {}, 1);
  const TemplateVerdict v = verdict_of(board);
  EXPECT_EQ(v.grade, Grade::Poor) << v.self_likeness;
  EXPECT_GE(v.self_likeness, kMuchLikeness);
  EXPECT_NE(v.words.find("repeats itself"), std::string::npos);
}

TEST(TemplateVerdict, ATemplateOfTheMethodPaperHasOneToo) {
  TrackOptions options;
  options.method = TrackMethod::Paper;
  const Template model(spots({0, 0, 320, 240}), {40, 30, 240, 180}, options);
  const TemplateVerdict v = template_verdict(model, options);
  EXPECT_EQ(v.grade, Grade::Good) << v.words;
  EXPECT_GE(v.keypoints, Template::kMinKeypoints);
}

TEST(TemplateVerdict, HasAWordForEach) {
  EXPECT_STREQ(name(Grade::Good), "good");
  EXPECT_STREQ(name(Grade::Fair), "fair");
  EXPECT_STREQ(name(Grade::Poor), "poor");
}

}  // namespace
}  // namespace kestrel
