#include "kestrel/io/overlay.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "support/random.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const double kNan = std::numeric_limits<double>::quiet_NaN();

cv::Mat grey(int width, int height, int value) {
  return cv::Mat(height, width, CV_8UC1, cv::Scalar(value));
}

cv::Mat noise(int width, int height) {
  test::Random random("overlay.noise");
  cv::Mat picture = grey(width, height, 0);
  for (auto it = picture.begin<uchar>(); it != picture.end<uchar>(); ++it)
    *it = uchar(random.integer(40, 200));
  return picture;
}

Track seen() {
  Track track;
  track.window = {200, 120, 400, 300};
  track.matches = 12;
  track.image_from_template.emplace().H << 1, 0, 300, 0, 1, 200, 0, 0, 1;
  return track;
}

bool is_colour(const cv::Vec3b& pixel) {
  const auto [low, high] = std::minmax({pixel[0], pixel[1], pixel[2]});
  return high - low > 60;
}

int coloured_pixels(const cv::Mat& picture) {
  int count = 0;
  for (auto it = picture.begin<cv::Vec3b>(); it != picture.end<cv::Vec3b>(); ++it)
    count += is_colour(*it) ? 1 : 0;
  return count;
}

cv::Mat as_bgr(const cv::Mat& picture) {
  cv::Mat bgr;
  cv::cvtColor(picture, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

double difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(Overlay, HasTheTemplateUnscaledInTheCorner) {
  const cv::Mat model = noise(120, 90);
  const cv::Mat drawn = overlay({0, 0, grey(640, 480, 50), {}}, model, seen());
  EXPECT_EQ(difference(drawn(cv::Rect(0, 0, 120, 90)), as_bgr(model)), 0);
}

TEST(Overlay, FitsALargeTemplateIntoAQuarter) {
  const cv::Mat model = noise(500, 100);
  const cv::Mat drawn = overlay({0, 0, grey(640, 480, 50), {}}, model, Track{});
  cv::Mat small;
  cv::resize(model, small, {320, 64}, 0, 0, cv::INTER_AREA);
  EXPECT_EQ(difference(drawn(cv::Rect(0, 0, 320, 64)), as_bgr(small)), 0);
}

TEST(Overlay, HasTheOutlineWhite) {
  const cv::Mat drawn = overlay({0, 0, grey(640, 480, 50), {}}, noise(120, 90), seen());
  for (const Pixel& p : outline(*seen().image_from_template, 120, 90))
    EXPECT_GT(drawn.at<cv::Vec3b>(int(p.v), int(p.u))[0], 200);
  EXPECT_GT(drawn.at<cv::Vec3b>(200, 360)[1], 200);  // the middle of the upper side
}

TEST(Overlay, HasTheWindowBlackAlsoOnDarkImages) {
  for (const int value : {0, 50, 255}) {
    const cv::Mat drawn = overlay({0, 0, grey(640, 480, value), {}}, noise(120, 90), seen());
    // First and last pixel of the window, and the middle of its sides.
    for (const cv::Point& p : {cv::Point(200, 120), {599, 419}, {400, 120}, {599, 250}, {200, 300}})
      EXPECT_EQ(drawn.at<cv::Vec3b>(p), cv::Vec3b(0, 0, 0));
    EXPECT_GT(drawn.at<cv::Vec3b>(119, 400)[0], 150);
  }
}

TEST(Overlay, JoinsMatchesByColouredLines) {
  Track track = seen();
  track.inliers = {{{60, 45}, {360, 245}}};
  const cv::Mat drawn = overlay({0, 0, grey(640, 480, 50), {}}, noise(120, 90), track);
  for (const double part : {0.3, 0.5, 0.7})
    EXPECT_TRUE(is_colour(drawn.at<cv::Vec3b>(int(45 + 200 * part), int(60 + 300 * part)))) << part;
}

TEST(Overlay, MapsMatchesOfAShrunkTemplate) {
  Track track = seen();
  track.inliers = {{{399.5, 299.5}, {500, 400}}};  // the centre of an 800x600 template
  const cv::Mat drawn = overlay({0, 0, grey(640, 480, 50), {}}, noise(800, 600), track);
  EXPECT_TRUE(is_colour(drawn.at<cv::Vec3b>(120, 160)));  // the centre of the quarter
}

TEST(Overlay, KeepsAKeypointsColour) {
  const Frame frame{0, 0, grey(640, 480, 50), {}};
  Track alone = seen();
  alone.image_from_template.reset();
  alone.image_from_template.emplace().H << 0.01, 0, 620, 0, 0.01, 460, 0, 0, 1;  // out of the way
  alone.inliers = {{{60, 45}, {360, 245}}};
  Track among = alone;
  among.inliers.insert(among.inliers.begin(), {{{3, 80}, {100, 440}}, {{4, 70}, {90, 440}}});
  const cv::Mat model = noise(120, 90);
  const cv::Point on_line(300, 205);
  EXPECT_EQ(overlay(frame, model, alone).at<cv::Vec3b>(on_line),
            overlay(frame, model, among).at<cv::Vec3b>(on_line));
}

TEST(Overlay, DrawsNoMoreLinesThanAsked) {
  test::Random random("overlay.lines");
  Track track = seen();
  for (int i = 0; i < 400; ++i)
    track.inliers.push_back({{random.uniform(0, 119), random.uniform(0, 89)},
                             {random.uniform(300, 420), random.uniform(200, 290)}});
  const Frame frame{0, 0, grey(640, 480, 50), {}};
  OverlayOptions none;
  none.max_lines = 0;
  OverlayOptions few;
  few.max_lines = 5;
  const cv::Mat model = grey(120, 90, 80);
  EXPECT_EQ(coloured_pixels(overlay(frame, model, track, none).rowRange(0, 480)), 0);
  const int five = coloured_pixels(overlay(frame, model, track, few));
  EXPECT_GT(five, 500);  // five lines of some 350 px; anti-aliasing pales some pixels
  EXPECT_GT(coloured_pixels(overlay(frame, model, track)), 4 * five);
}

TEST(Overlay, MarksTheGoal) {
  OverlayOptions options;
  options.goal_corners = {{{310, 210}, {500, 210}, {500, 350}, {310, 350}}};
  const cv::Mat drawn = overlay({0, 0, grey(640, 480, 50), {}}, noise(120, 90), seen(), options);
  const auto goal = drawn.at<cv::Vec3b>(350, 500);
  EXPECT_GT(goal[2], goal[1] + 100);  // red
  const auto current = drawn.at<cv::Vec3b>(289, 419);
  EXPECT_GT(current[1], current[2] + 100);  // green
}

TEST(Overlay, TakesAnySizeAndNonsense) {
  test::Random random("overlay.any");
  const double odd[] = {kNan, 1 / 0., -1e300, 1e300, -5e9, 5e9, -3, 0, 7, 40000};
  const auto any = [&] { return odd[random.integer(0, 9)]; };
  for (int i = 0; i < 100; ++i) {
    Track track = seen();
    track.window = {any(), any(), any(), any()};
    track.image_from_template.emplace().H = Eigen::Matrix3d::NullaryExpr(any);
    for (int k = 0; k < 5; ++k) track.inliers.push_back({{any(), any()}, {any(), any()}});
    OverlayOptions options;
    options.goal_corners = {{{any(), any()}, {any(), any()}, {any(), any()}, {any(), any()}}};
    options.sent = FailsafeCommand{{any(), any(), any(), any()}, CommandState::Servo};
    const int width = i < 20 ? i + 1 : random.integer(1, 300);
    const cv::Mat drawn =
        overlay({i, any(), grey(width, random.integer(1, 200), 90), {}},
                noise(random.integer(1, 400), random.integer(1, 90)), track, options);
    EXPECT_EQ(drawn.cols, width);
    EXPECT_EQ(drawn.type(), CV_8UC3);
  }
}

TEST(Overlay, OfNoImageIsAField) {
  EXPECT_FALSE(overlay({}, cv::Mat(), Track{}).empty());
  const cv::Mat colour(48, 64, CV_8UC3, cv::Scalar::all(1));
  EXPECT_EQ(overlay({0, 0, colour, {}}, cv::Mat(), Track{}).cols, 64);
}

TEST(Overlay, HasOneHeightInARun) {
  Track lost;
  lost.miss = Miss::FewKeypoints;
  for (const int width : {64, 160, 320, 384, 640, 752, 1280, 1920}) {
    const Frame frame{12345, 0, grey(width, 40, 50), {}};
    OverlayOptions options;
    options.sent = FailsafeCommand{{}, CommandState::Servo};
    const int rows = overlay(frame, cv::Mat(), seen(), options).rows;
    options.sent = FailsafeCommand{{-1, -1, -1, -0.5}, CommandState::Hover};
    EXPECT_EQ(overlay(frame, cv::Mat(), lost, options).rows, rows);
    EXPECT_EQ(overlay(frame, cv::Mat(), lost).rows, overlay(frame, cv::Mat(), seen()).rows);
  }
}

TEST(Overlay, LeavesTheFrameAlone) {
  const cv::Mat picture = noise(200, 100);
  const cv::Mat before = picture.clone();
  (void)overlay({0, 0, picture, {}}, noise(50, 40), seen());
  EXPECT_EQ(difference(picture, before), 0);
}

TEST(StatusLine, SaysWhatCounts) {
  Track track = seen();
  track.inliers.resize(9);
  const FailsafeCommand sent{{0.5, -0.25, 0, -M_PI / 18}, CommandState::Servo};
  EXPECT_EQ(status_line({17, 0, {}, {}}, track, sent),
            "frame 17   SERVO   9/12 inliers   v +0.50 -0.25 +0.00 m/s   yaw -10.0 deg/s");
  Track lost;
  lost.miss = Miss::FewMatches;
  lost.matches = 3;
  EXPECT_EQ(status_line({18, 0, {}, {}}, lost, FailsafeCommand{{}, CommandState::Hover}),
            "frame 18   LOST: few matches   HOVER   0/3 inliers   v +0.00 +0.00 +0.00 m/s   "
            "yaw +0.0 deg/s");
  EXPECT_THAT(status_line({17, 0, {}, {}}, track, {}), Not(HasSubstr("yaw")));
  const FailsafeCommand tiny{{-0.001, -0., 0, -0.0001}, CommandState::Servo};
  EXPECT_THAT(status_line({17, 0, {}, {}}, track, tiny), HasSubstr("v +0.00 +0.00 +0.00 m/s"));
  EXPECT_THAT(status_line({17, 0, {}, {}}, track, tiny), HasSubstr("yaw +0.0 deg/s"));
}

}  // namespace
}  // namespace kestrel
