// A hundred synthetic calibrations of each lens, whose truth is known: are the standard deviations
// what they say?
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "kestrel/calibration/camera_solver.hpp"

#include "board_views.hpp"

namespace kestrel {
namespace {

struct Trial {
  Camera camera;
  CameraModel model;
};

class Trials : public ::testing::TestWithParam<int> {
 protected:
  static Trial trial(int which) {
    switch (which) {
      case 0:
        return {test::straight(), CameraModel::None};
      case 1:
        return {test::wide_angle(), CameraModel::RadialTangential};
      case 2:
        return {test::wide_angle(), CameraModel::RadialTangential3};
      default:
        return {test::fisheye(), CameraModel::KannalaBrandt};
    }
  }
};

INSTANTIATE_TEST_SUITE_P(OfEachLens, Trials, ::testing::Range(0, 4));

// All parameters of a calibration within three of its standard deviations, in 95 of 100. (Were
// they independent, 97.6 % of the sets of nine would be.) And their squares in these units have
// the mean 1: deviations that are stated too large would pass the first law.
TEST_P(Trials, TruthIsWithinThreeDeviationsInNinetyFiveOfAHundred) {
  const Trial t = trial(GetParam());
  const Board board;
  const std::vector<double> truth = values_of(t.model, t.camera.parameters());
  int good = 0;
  double squares = 0;
  for (int seed = 0; seed < 100; ++seed) {
    test::Random random(std::string(name(t.model)) + " trial " + std::to_string(seed));
    const auto views = test::usual_views(board, t.camera, 13, 0.2, random);
    const Calibration found = solve_camera(views, board, {640, 480}, t.model);
    bool all = true;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const ParameterEstimate& p = found.parameters[i];
      const double off = (p.value - truth[i]) / p.deviation;
      all = all && std::abs(off) < 3;
      squares += off * off / (100.0 * double(truth.size()));
    }
    if (all) ++good;
  }
  std::printf("%s: %d of 100 within 3 standard deviations, mean square %.3f\n", name(t.model), good,
              squares);
  EXPECT_GE(good, 95);
  // Correlated parameters: at worst a hundred independent squares, whose mean has the deviation
  // sqrt(2 / 100); three of them.
  EXPECT_NEAR(squares, 1, 0.42);
}

}  // namespace
}  // namespace kestrel
