#include "kestrel/calibration/visp_solver.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "../../src/calibration/visp_bundle.hpp"
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

// With distortion ViSP fits kud and kdu at once, each to half of the residuals: so do we here, and
// the minima are one again: far inside the deviations.
TEST(VispCheck, AgreesWithRadialDistortion) {
  test::Random random("visp radial");
  const Camera camera({540, 538, 331, 236, 640, 480, Lens::PlumbBob, {-0.12, 0, 0, 0, 0}});
  const auto views = test::usual_views(kBoard, camera, 8, 0.2, random);
  const auto check = visp_check(views, kBoard, kSize, CameraModel::RadialTangential);
  ASSERT_TRUE(check.has_value());
  EXPECT_EQ(check->visp.lens, Lens::VispRadial);
  EXPECT_EQ(check->ours.camera.lens, Lens::VispRadial);
  ASSERT_EQ(check->ours.parameters.size(), 6u);
  EXPECT_EQ(visp_values(*check).size(), 6u);
  EXPECT_LT(check->largest_deviations, 0.01);
  EXPECT_NEAR(check->visp_rms_px, check->ours.rms_px, 1e-4);
  // And it is the camera that was there: k1 by four of its deviations, and kdu its inverse to
  // second order.
  const ParameterEstimate& kud = check->ours.parameters[4];
  EXPECT_NEAR(kud.value, -0.12, 4 * kud.deviation);
  EXPECT_NEAR(check->ours.parameters[5].value, 0.12, 0.03);
}

// The deviations say how far the noise of the points scatters the minimum: the rms of all
// differences from the truth in them is 1, here over a hundred draws of five parameters each, which
// tell it to 5 % were the parameters one. It is root 2 more where each coordinate counts for two.
TEST(VispCheck, StatesTheScatterOfItsParameters) {
  const Board small = parse_board("chessboard:5x4:0.04");
  const Camera camera({540, 538, 331, 236, 640, 480, Lens::PlumbBob, {-0.02, 0, 0, 0, 0}});
  const std::vector<double> truth = {540, 538, 331, 236, -0.02};
  constexpr int kDraws = 100;
  double square = 0;
  for (int k = 0; k < kDraws; ++k) {
    test::Random random("visp scatter " + std::to_string(k));
    const auto views = test::usual_views(small, camera, 6, 0.2, random);
    const auto solved =
        solve_as_visp(views, small, solve_camera(views, small, kSize, CameraModel::Radial));
    ASSERT_TRUE(solved.has_value());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const ParameterEstimate& p = solved->parameters[i];
      square += std::pow((p.value - truth[i]) / p.deviation, 2) / double(kDraws * truth.size());
    }
  }
  EXPECT_NEAR(std::sqrt(square), 1, 0.15);
}

TEST(VispCheck, IsEmptyForAFisheye) {
  EXPECT_FALSE(visp_check({}, kBoard, kSize, CameraModel::KannalaBrandt).has_value());
}

TEST(VispCheck, RefusesWhatTheSolverRefuses) {
  EXPECT_THROW(visp_check({}, kBoard, kSize, CameraModel::None), CalibrationError);
}

}  // namespace
}  // namespace kestrel
