#include "kestrel/calibration/hold_out.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "board_views.hpp"

namespace kestrel {
namespace {

const Board kBoard = parse_board("chessboard:6x5:0.04");
constexpr ImageSize kSize{640, 480};

// Left-out views are explained as well as the noise allows, a little worse than those calibrated.
TEST(HoldOut, OfTheRightModelIsTheNoise) {
  test::Random random("hold out");
  const auto views = test::usual_views(kBoard, test::wide_angle(), 12, 0.2, random);
  const auto found = hold_out(views, kBoard, kSize, CameraModel::RadialTangential, 3);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->folds, 3);
  EXPECT_GT(found->rms_px, 0.2 * std::sqrt(2) * 0.85);
  EXPECT_LT(found->rms_px, 0.2 * std::sqrt(2) * 1.3);
}

TEST(HoldOut, ShowsAModelThatDoesNotFit) {
  test::Random random("wrong model");
  const auto views = test::usual_views(kBoard, test::wide_angle(), 12, 0.1, random);
  const auto straight = hold_out(views, kBoard, kSize, CameraModel::None, 3);
  const auto bent = hold_out(views, kBoard, kSize, CameraModel::RadialTangential, 3);
  ASSERT_TRUE(straight && bent);
  EXPECT_GT(straight->rms_px, 4 * bent->rms_px);
}

TEST(HoldOut, IsEmptyForTooFewViews) {
  test::Random random("few");
  const auto views = test::usual_views(kBoard, test::straight(), 4, 0.1, random);
  EXPECT_FALSE(hold_out(views, kBoard, kSize, CameraModel::None).has_value());
  EXPECT_FALSE(hold_out({}, kBoard, kSize, CameraModel::None).has_value());
}

TEST(HoldOut, IsEmptyWhereAFoldHasNoSolution) {
  test::Random random("broken");
  auto views = test::usual_views(kBoard, test::straight(), 8, 0.1, random);
  views[3].points[0].in_image.u = std::nan("");
  EXPECT_FALSE(hold_out(views, kBoard, kSize, CameraModel::None, 2).has_value());
}

}  // namespace
}  // namespace kestrel
