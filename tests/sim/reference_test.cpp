#include "kestrel/sim/reference.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/sim/world.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Camera random_camera(test::Random& random) {
  CameraParameters p;
  p.width = 160;
  p.height = 120;
  p.px = random.uniform(140, 160);
  p.py = random.uniform(140, 160);
  p.u0 = random.uniform(75, 85);
  p.v0 = random.uniform(55, 65);
  return Camera(p);
}

/// A white poster, 2.0 x 1.5 m, on black.
Scene white_poster() {
  Scene scene;
  scene.background_grey = 0;
  scene.planes.push_back({cv::Mat(48, 64, CV_8U, cv::Scalar(255)), 2.0, 1.5, world_from_wall()});
  return scene;
}

TargetPose ahead(double distance_m) { return {Matrix3d::Identity(), {0, 0, distance_m}}; }

TEST(Reference, BoxIsExactlyTheTargetForTheDefaultCameraAtFiveMetres) {
  const Reference r = goal_view(white_poster(), default_camera(), ahead(5));
  EXPECT_EQ(r.box.u, 200);
  EXPECT_EQ(r.box.v, 150);
  EXPECT_EQ(r.box.width, 240);
  EXPECT_EQ(r.box.height, 180);
  EXPECT_DOUBLE_EQ(r.width_m, 2.0);
  EXPECT_DOUBLE_EQ(r.height_m, 1.5);
  EXPECT_NEAR(r.target_from_template.translation.norm(), 0, 1e-15);
}

// The corners of a template are the centres of its corner pixels, and its width_px pixels span
// width_m: so they must be seen, from the goal, in the corner pixels of the box.
TEST(Reference, TemplateCornersProjectIntoTheBoxsCornerPixels) {
  test::Random random("reference corners");
  for (int i = 0; i < 10; ++i) {
    const Camera camera = random_camera(random);
    const TargetPose goal = ahead(random.uniform(3.2, 6));
    const Reference r = goal_view(white_poster(), camera, goal);
    const double x = (r.box.width - 1) / 2 * r.width_m / r.box.width;
    const double y = (r.box.height - 1) / 2 * r.height_m / r.box.height;
    for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const Vector3d p = goal * (r.target_from_template * Vector3d(a * x, b * y, 0));
      const Pixel seen = camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
      EXPECT_NEAR(seen.u, r.box.u + (a > 0 ? r.box.width - 1 : 0), 1e-9);
      EXPECT_NEAR(seen.v, r.box.v + (b > 0 ? r.box.height - 1 : 0), 1e-9);
    }
  }
}

TEST(Reference, BoxHoldsTheWholePixelsOfTheTargetAndNoMore) {
  test::Random random("reference box");
  for (int i = 0; i < 10; ++i) {
    const Reference r =
        goal_view(white_poster(), random_camera(random), ahead(random.uniform(3.2, 6)));
    const cv::Rect box(int(r.box.u), int(r.box.v), int(r.box.width), int(r.box.height));
    double least = 0;
    cv::minMaxLoc(r.image(box), &least);
    EXPECT_GE(least, 254);
    const auto dark = [&](int u, int v) { EXPECT_LT(r.image.at<std::uint8_t>(v, u), 254); };
    dark(box.x - 1, box.y + 5);
    dark(box.x + box.width, box.y + 5);
    dark(box.x + 5, box.y - 1);
    dark(box.x + 5, box.y + box.height);
  }
}

TEST(Reference, LooksStraightWhateverTheGoalAndTheLens) {
  test::Random random("reference straight");
  CameraParameters p = random_camera(random).parameters();
  const Reference straight = goal_view(white_poster(), Camera(p), ahead(5));
  p.lens = Lens::PlumbBob;
  p.distortion = {-0.3, 0.1, 0, 0, 0};
  const TargetPose slanted{rotation_from_vector({0, 0.5, 0}), {3, 0, 4}};
  const Reference other = goal_view(white_poster(), Camera(p), slanted);
  EXPECT_EQ(cv::norm(straight.image, other.image, cv::NORM_INF), 0);
  EXPECT_EQ(straight.width_m, other.width_m);
}

TEST(Reference, RefusesWhatCannotBePhotographed) {
  EXPECT_THROW(goal_view(Scene{}, default_camera(), ahead(5)), std::invalid_argument);
  EXPECT_THROW(goal_view(white_poster(), default_camera(), ahead(-5)), std::invalid_argument);
  EXPECT_THROW(goal_view(white_poster(), default_camera(), ahead(std::nan(""))),
               std::invalid_argument);
  EXPECT_THROW(goal_view(white_poster(), default_camera(), ahead(1)), std::invalid_argument);
  EXPECT_THROW(goal_view(white_poster(), default_camera(), ahead(100)), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
