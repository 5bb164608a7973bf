#include "kestrel/geometry/nearest_visp_camera.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

CameraParameters plumb_bob(const std::array<double, 5>& distortion) {
  return {610, 605, 320.5, 241.25, 640, 480, Lens::PlumbBob, distortion};
}

TEST(NearestVispCamera, IsTheCameraItselfWhereViSPHoldsIt) {
  CameraParameters p = plumb_bob({-0.02, 0.01, 0, 0, 0});
  for (const Lens lens : {Lens::Pinhole, Lens::VispRadial, Lens::KannalaBrandt}) {
    p.lens = lens;
    const NearestVispCamera nearest = nearest_visp_camera(Camera(p));
    EXPECT_EQ(nearest.parameters.lens, lens);
    EXPECT_EQ(nearest.parameters.px, 610);
    EXPECT_EQ(nearest.largest_px, 0);
  }
}

// k1 alone is ViSP's kud: the fit must come back to it.
TEST(NearestVispCamera, FindsKudOfARadialLens) {
  const NearestVispCamera nearest = nearest_visp_camera(Camera(plumb_bob({-0.2, 0, 0, 0, 0})));
  EXPECT_EQ(nearest.parameters.lens, Lens::VispRadial);
  EXPECT_NEAR(nearest.parameters.px, 610, 1e-6);
  EXPECT_NEAR(nearest.parameters.py, 605, 1e-6);
  EXPECT_NEAR(nearest.parameters.u0, 320.5, 1e-6);
  EXPECT_NEAR(nearest.parameters.v0, 241.25, 1e-6);
  EXPECT_NEAR(nearest.parameters.distortion[0], -0.2, 1e-9);
  EXPECT_LT(nearest.largest_px, 1e-6);
  // The inverse of x (1 - 0.2 r^2) begins with x (1 + 0.2 r^2); further terms make it larger.
  EXPECT_GT(nearest.parameters.distortion[1], 0.2);
  EXPECT_LT(nearest.parameters.distortion[1], 0.35);
}

TEST(NearestVispCamera, SaysHowFarAnotherLensIs) {
  const Camera camera(plumb_bob({-0.28, 0.09, 1e-3, -5e-4, 0}));
  const NearestVispCamera nearest = nearest_visp_camera(camera);
  // Of a Gauss-Newton written apart, on the same 33 x 25 pixels: px 606.373, kud -0.23018.
  EXPECT_NEAR(nearest.largest_px, 3.4012, 1e-3);
  EXPECT_NEAR(nearest.parameters.px, 606.3727, 1e-3);
  EXPECT_NEAR(nearest.parameters.distortion[0], -0.230178, 1e-5);
  const Pixel corner = Camera(nearest.parameters).to_pixel(camera.to_image_point({0, 0}));
  EXPECT_LE(distance(corner, {0, 0}), nearest.largest_px + 1e-9);
}

TEST(NearestVispCamera, WantsTheSizeOfTheImage) {
  CameraParameters p = plumb_bob({-0.2, 0, 0, 0, 0});
  p.width = 0;
  EXPECT_THROW(nearest_visp_camera(Camera(p)), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
