#include "kestrel/calibration/visp_solver.hpp"

#include <gtest/gtest.h>

#include "board_views.hpp"

namespace kestrel {
namespace {

const Board kBoard = parse_board("chessboard:7x5:0.03");
constexpr ImageSize kSize{640, 480};

// The same least squares by another program: without distortion the two minima are one; ViSP stops
// at steps of a thousandth of a pixel.
TEST(VispCheck, AgreesWithoutDistortion) {
  test::Random random("visp straight");
  const auto views = test::usual_views(kBoard, test::straight(), 8, 0.2, random);
  const auto check = visp_check(views, kBoard, kSize, CameraModel::None);
  ASSERT_TRUE(check.has_value());
  EXPECT_EQ(check->visp.lens, Lens::Pinhole);
  EXPECT_EQ(check->ours.model, CameraModel::None);
  EXPECT_LT(check->largest_deviations, 0.1);
  EXPECT_NEAR(check->visp_rms_px, check->ours.rms_px, 1e-3);
}

// With distortion ViSP fits kud and kdu at once, each to half of the residuals: another minimum,
// but the same camera within the noise.
TEST(VispCheck, AgreesWithRadialDistortion) {
  test::Random random("visp radial");
  const Camera camera({540, 538, 331, 236, 640, 480, Lens::PlumbBob, {-0.12, 0, 0, 0, 0}});
  const auto views = test::usual_views(kBoard, camera, 8, 0.2, random);
  const auto check = visp_check(views, kBoard, kSize, CameraModel::RadialTangential);
  ASSERT_TRUE(check.has_value());
  EXPECT_EQ(check->visp.lens, Lens::VispRadial);
  EXPECT_EQ(check->ours.model, CameraModel::Radial);
  EXPECT_LT(check->largest_deviations, 3);
  EXPECT_NEAR(check->visp.distortion[0], -0.12, 0.02);
  EXPECT_LT(check->visp_rms_px, 1.2 * check->ours.rms_px);
}

TEST(VispCheck, IsEmptyForAFisheye) {
  EXPECT_FALSE(visp_check({}, kBoard, kSize, CameraModel::KannalaBrandt).has_value());
}

TEST(VispCheck, RefusesWhatTheSolverRefuses) {
  EXPECT_THROW(visp_check({}, kBoard, kSize, CameraModel::None), CalibrationError);
}

}  // namespace
}  // namespace kestrel
