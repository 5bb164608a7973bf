#include "kestrel/calibration/view_advice.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "board_views.hpp"

namespace kestrel {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const Board kBoard;
constexpr ImageSize kSize{640, 480};
constexpr double kSharp_px = 2;

/// The shape of a view of a pinhole camera of 640 px focal length.
ViewShape shape(const ImagePoint& direction, double depth_m, const Eigen::Vector3d& angles,
                double edge_px = kSharp_px) {
  test::Random random("shape");
  const Camera camera({640, 640, 319.5, 239.5, 640, 480});
  const TargetPose pose = test::board_pose_at(kBoard, direction, depth_m, angles);
  return view_shape(test::view_of(kBoard, camera, pose, 0, random), kBoard, kSize, edge_px).value();
}

// Rotation by +b about y turns the board's right side (x) to -z: nearer.
TEST(ViewShape, KnowsTiltAndItsDirection) {
  for (const double angle : {0.2, 0.4, 0.7}) {
    // Far away: the affine foreshortening is exact there; half a degree at 2 m.
    const ViewShape right_away = shape({0, 0}, 2, {0, -angle, 0});
    EXPECT_NEAR(right_away.lean_right, angle, 0.01);
    EXPECT_NEAR(right_away.lean_down, 0, 0.01);
    EXPECT_NEAR(shape({0, 0}, 2, {0, angle, 0}).lean_right, -angle, 0.01);
    const ViewShape low_away = shape({0, 0}, 2, {angle, 0, 0});
    EXPECT_NEAR(low_away.lean_down, angle, 0.01);
    EXPECT_NEAR(low_away.lean_right, 0, 0.01);
    EXPECT_NEAR(shape({0, 0}, 2, {-angle, 0, 0}).lean_down, -angle, 0.01);
  }
}

// A board rolled by a quarter turn: the direction is that of the image, not of the board.
TEST(ViewShape, LeansInTheImageHoweverTheBoardIsRolled) {
  const Eigen::Matrix3d tilt = rotation_from_rpy(0, -0.4, 0);
  const Eigen::Matrix3d R = tilt * rotation_from_rpy(0, 0, M_PI / 2);
  const auto points = board_points(kBoard);
  test::Random random("rolled");
  const TargetPose pose{R, Eigen::Vector3d(0, 0, 2) - R * (points.back() / 2)};
  const Camera camera({640, 640, 319.5, 239.5, 640, 480});
  const auto seen =
      view_shape(test::view_of(kBoard, camera, pose, 0, random), kBoard, kSize, kSharp_px);
  ASSERT_TRUE(seen.has_value());
  EXPECT_NEAR(seen->lean_right, 0.4, 0.01);
  EXPECT_NEAR(seen->lean_down, 0, 0.01);
}

TEST(ViewShape, KnowsPlaceAndSize) {
  const ViewShape seen = shape({0.1, -0.05}, 0.5, {0, 0, 0});
  EXPECT_NEAR(seen.centre.u, 319.5 + 64, 1e-6);
  EXPECT_NEAR(seen.centre.v, 239.5 - 32, 1e-6);
  // 0.2 x 0.125 m at 0.5 m: 256 x 160 px.
  EXPECT_NEAR(seen.size, std::sqrt(256.0 * 160 / (640 * 480)), 1e-6);
  EXPECT_NEAR(seen.reach.u, 319.5 + 64 - 128, 1);
  EXPECT_EQ(seen.edge_width_px, kSharp_px);
}

TEST(ViewShape, IsEmptyForPointsOnALine) {
  BoardView line;
  for (int i = 0; i < 9; ++i) line.points.push_back({i, {10.0 * i, 100}});
  EXPECT_FALSE(view_shape(line, kBoard, kSize, kSharp_px).has_value());
  EXPECT_FALSE(view_shape({}, kBoard, kSize, kSharp_px).has_value());
  EXPECT_FALSE(view_shape({"", {{99, {1, 1}}}}, kBoard, kSize, kSharp_px).has_value());
}

TEST(ViewAdvice, AsksForEveryKindOfViewAtFirst) {
  const ViewAdvice advice = view_advice({}, std::nullopt, kSize);
  EXPECT_FALSE(advice.take);
  EXPECT_EQ(advice.reason, "no board is seen");
  EXPECT_EQ(advice.missing.size(), 10u);
  EXPECT_EQ(advice.progress, 0);
}

TEST(ViewAdvice, TakesAGoodViewOnceAndSaysWhy) {
  const ViewShape seen = shape({0, 0}, 0.6, {0, -0.5, 0});
  const ViewAdvice first = view_advice({}, seen, kSize);
  EXPECT_TRUE(first.take);
  EXPECT_EQ(first.reason, "");
  EXPECT_GT(first.progress, 0);
  EXPECT_THAT(first.missing, Not(Contains("turn its right side away")));
  EXPECT_THAT(first.missing, Contains("turn its left side away"));
  const ViewAdvice again = view_advice({seen}, seen, kSize);
  EXPECT_FALSE(again.take);
  EXPECT_EQ(again.reason, "like a view that is kept");
  EXPECT_TRUE(view_advice({seen}, shape({0, 0}, 0.6, {0, 0.5, 0}), kSize).take);
}

TEST(ViewAdvice, TurnsBlurredViewsDown) {
  const ViewAdvice blurred = view_advice({}, shape({0, 0}, 0.6, {0, 0, 0}, 9), kSize);
  EXPECT_FALSE(blurred.take);
  EXPECT_THAT(blurred.reason, HasSubstr("blurred: edges are 9 px wide"));
  const double nan = std::nan("");
  EXPECT_FALSE(view_advice({}, shape({0, 0}, 0.6, {0, 0, 0}, nan), kSize).take);
}

/// What is still missing after one view.
std::vector<std::string> missing_after(const ViewShape& seen) {
  return view_advice({seen}, std::nullopt, kSize).missing;
}

TEST(ViewAdvice, KnowsEachKindOfView) {
  EXPECT_THAT(missing_after(shape({-0.25, 0}, 0.6, {0, 0, 0})),
              Not(Contains("move the board to the left border")));
  EXPECT_THAT(missing_after(shape({-0.25, 0}, 0.6, {0, 0, 0})),
              Contains("move the board to the right border"));
  EXPECT_THAT(missing_after(shape({0.25, 0}, 0.6, {0, 0, 0})),
              Not(Contains("move the board to the right border")));
  EXPECT_THAT(missing_after(shape({0, -0.25}, 0.6, {0, 0, 0})),
              Not(Contains("move the board to the upper border")));
  EXPECT_THAT(missing_after(shape({0, 0.25}, 0.6, {0, 0, 0})),
              Not(Contains("move the board to the lower border")));
  EXPECT_THAT(missing_after(shape({0, 0}, 0.6, {0.5, 0, 0})),
              Not(Contains("turn its lower side away")));
  EXPECT_THAT(missing_after(shape({0, 0}, 0.6, {-0.5, 0, 0})),
              Not(Contains("turn its upper side away")));
  EXPECT_THAT(missing_after(shape({0, 0}, 0.3, {0, 0, 0})),
              Not(Contains(HasSubstr("bring it nearer"))));
}

TEST(ViewAdvice, IsContentAfterTheViewsItAskedFor) {
  GuideOptions options;
  options.views = 9;
  std::vector<ViewShape> kept;
  for (const ViewShape& seen : {shape({-0.25, 0}, 0.6, {0, 0, 0}), shape({0.25, 0}, 0.6, {0, 0, 0}),
                                shape({0, -0.25}, 0.6, {0, 0, 0}), shape({0, 0.25}, 0.6, {0, 0, 0}),
                                shape({0, 0}, 0.6, {0.5, 0, 0}), shape({0, 0}, 0.6, {-0.5, 0, 0}),
                                shape({0, 0}, 0.6, {0, 0.5, 0}), shape({0, 0}, 0.6, {0, -0.5, 0}),
                                shape({0, 0}, 0.3, {0, 0, 0})}) {
    const ViewAdvice advice = view_advice(kept, seen, kSize, options);
    ASSERT_TRUE(advice.take) << advice.reason;
    kept.push_back(seen);
  }
  const ViewAdvice end = view_advice(kept, std::nullopt, kSize, options);
  EXPECT_TRUE(end.missing.empty());
  EXPECT_EQ(end.progress, 1);
}

TEST(GuideOptions, NamesTheOptionOutOfRange) {
  const auto throws = [](auto change) {
    GuideOptions options;
    change(options);
    EXPECT_THROW(options.check(), std::invalid_argument);
  };
  throws([](GuideOptions& o) { o.views = 2; });
  throws([](GuideOptions& o) { o.lean_rad = 0; });
  throws([](GuideOptions& o) { o.border = 0.5; });
  throws([](GuideOptions& o) { o.near_size = 1; });
  throws([](GuideOptions& o) { o.largest_edge_px = 1; });
  throws([](GuideOptions& o) { o.smallest_change = std::nan(""); });
}

}  // namespace
}  // namespace kestrel
