#include "kestrel/geometry/camera.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

CameraParameters with(Lens lens, const std::array<double, 5>& distortion) {
  CameraParameters p{610, 605, 320.5, 241.25, 640, 480};
  p.lens = lens;
  p.distortion = distortion;
  return p;
}

const std::array<double, 5> kBarrel{-0.31, 0.12, 1.5e-3, -2e-3, -0.02};
const std::array<double, 5> kFisheye{-0.03, 0.01, -0.004, 0.0007, 0};

std::vector<Camera> cameras() {
  return {Camera(with(Lens::Pinhole, {})), Camera(with(Lens::VispRadial, {-0.2, 0.2})),
          Camera(with(Lens::PlumbBob, kBarrel)),
          Camera(with(Lens::PlumbBob, {0.25, 0.1, -1e-3, 1e-3, 0.02})),
          Camera(with(Lens::KannalaBrandt, kFisheye))};
}

bool is_finite(const Pixel& p) { return std::isfinite(p.u) && std::isfinite(p.v); }
bool is_finite(const ImagePoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

TEST(Camera, PinholeIsKTimesThePoint) {
  test::Random random("pinhole");
  const Camera camera(with(Lens::Pinhole, {}));
  for (int i = 0; i < 20; ++i) {
    const ImagePoint m{random.uniform(-1, 1), random.uniform(-1, 1)};
    const Eigen::Vector3d by_K = camera.K() * Eigen::Vector3d(m.x, m.y, 1);
    const Pixel p = camera.to_pixel(m);
    EXPECT_NEAR(p.u, by_K.x(), 1e-12);
    EXPECT_NEAR(p.v, by_K.y(), 1e-12);
    EXPECT_EQ(by_K.z(), 1);
  }
}

TEST(Camera, PixelAndPointAreInverse) {
  test::Random random("round trip");
  for (const Camera& camera : cameras()) {
    if (camera.parameters().lens == Lens::VispRadial) continue;  // two approximate inverses
    for (int i = 0; i < 300; ++i) {
      // A little beyond the image on all sides.
      const Pixel p{random.uniform(-20, 660), random.uniform(-20, 500)};
      const Pixel back = camera.to_pixel(camera.to_image_point(p));
      EXPECT_LT(distance(p, back), 1e-9) << p.u << ' ' << p.v;
    }
  }
}

// ViSP gives two polynomials: with kdu = -kud they undo each other up to the next order,
// 3 kud^2 r^5 on the normalised plane (0.4 % of the radius at the corner of this image).
TEST(Camera, VispRadialUndoesItselfToItsOrder) {
  test::Random random("visp radial");
  const double kud = -0.05;
  const Camera camera(with(Lens::VispRadial, {kud, -kud}));
  for (int i = 0; i < 300; ++i) {
    const ImagePoint m{random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4)};
    const ImagePoint back = camera.to_image_point(camera.to_pixel(m));
    const double r = std::hypot(m.x, m.y);
    EXPECT_LE(std::hypot(back.x - m.x, back.y - m.y), 3.2 * kud * kud * std::pow(r, 5) + 1e-15);
  }
}

// vpMeterPixelConversion and vpPixelMeterConversion of ViSP 3.5, by hand at one point.
TEST(Camera, VispRadialUsesKudOutwardsAndKduInwards) {
  const Camera camera(with(Lens::VispRadial, {-0.2, 0.3}));
  const Pixel p = camera.to_pixel({0.3, 0.4});  // r^2 = 0.25: factor 0.95
  EXPECT_NEAR(p.u, 320.5 + 610 * 0.3 * 0.95, 1e-10);
  EXPECT_NEAR(p.v, 241.25 + 605 * 0.4 * 0.95, 1e-10);
  const ImagePoint m = camera.to_image_point({320.5 + 610 * 0.3, 241.25 + 605 * 0.4});
  EXPECT_NEAR(m.x, 0.3 * 1.075, 1e-14);
  EXPECT_NEAR(m.y, 0.4 * 1.075, 1e-14);
}

// Brown's model on the complex plane: z (1 + k1 |z|^2 + ...) + 2 |z|^2 P + z^2 conj(P) with
// P = p2 + i p1.
TEST(Camera, PlumbBobIsBrownsModel) {
  test::Random random("plumb bob");
  const Camera camera(with(Lens::PlumbBob, kBarrel));
  const auto& [k1, k2, p1, p2, k3] = kBarrel;
  for (int i = 0; i < 100; ++i) {
    const std::complex<double> z(random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5));
    const std::complex<double> P(p2, p1);
    const double n = std::norm(z);
    const auto seen =
        z * (1 + n * k1 + n * n * k2 + n * n * n * k3) + 2 * n * P + z * z * std::conj(P);
    const Pixel p = camera.to_pixel({z.real(), z.imag()});
    EXPECT_NEAR(p.u, 320.5 + 610 * seen.real(), 1e-10);
    EXPECT_NEAR(p.v, 241.25 + 605 * seen.imag(), 1e-10);
  }
}

// Values of cv::projectPoints and cv::fisheye::projectPoints (OpenCV 4.6) for the same camera.
TEST(Camera, AgreesWithOpenCv) {
  const auto expect = [](const Camera& camera, const ImagePoint& m, double u, double v) {
    const Pixel p = camera.to_pixel(m);
    EXPECT_NEAR(p.u, u, 1e-9);
    EXPECT_NEAR(p.v, v, 1e-9);
  };
  expect(Camera(with(Lens::PlumbBob, kBarrel)), {0.3, -0.2}, 496.00018298, 125.22200374);
  expect(Camera(with(Lens::PlumbBob, kBarrel)), {-0.45, 0.35}, 69.18622390625, 435.103164140625);
  expect(Camera(with(Lens::KannalaBrandt, kFisheye)), {0.3, -0.2}, 495.529393963251,
         125.520182133588);
  expect(Camera(with(Lens::KannalaBrandt, kFisheye)), {-0.45, 0.35}, 72.8635296033285,
         432.277404759545);
}

// An ideal equidistant fisheye: the angle off axis is the radius in the image.
TEST(Camera, KannalaBrandtWithoutCoefficientsIsEquidistant) {
  const Camera camera(with(Lens::KannalaBrandt, {}));
  for (const double angle : {0.0, 1e-9, 0.3, 1.0, 1.5}) {
    EXPECT_NEAR(camera.to_pixel({std::tan(angle), 0}).u, 320.5 + 610 * angle, 1e-9);
    EXPECT_NEAR(std::atan(camera.to_image_point({320.5, 241.25 + 605 * angle}).y), angle, 1e-12);
  }
}

TEST(Camera, JacobianIsTheDifferenceQuotient) {
  test::Random random("camera jacobian");
  for (const Camera& camera : cameras()) {
    for (int i = 0; i < 50; ++i) {
      const ImagePoint m{random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4)};
      constexpr double h = 1e-6;
      const Pixel r = camera.to_pixel({m.x + h, m.y});
      const Pixel l = camera.to_pixel({m.x - h, m.y});
      const Pixel d = camera.to_pixel({m.x, m.y + h});
      const Pixel u = camera.to_pixel({m.x, m.y - h});
      Eigen::Matrix2d quotient;
      quotient << r.u - l.u, d.u - u.u, r.v - l.v, d.v - u.v;
      quotient /= 2 * h;
      // Rounding of a pixel coordinate, 1e-13, over 2 h.
      EXPECT_LT((camera.pixel_jacobian(m) - quotient).norm(), 1e-6);
    }
    const Eigen::Matrix2d at_axis = camera.pixel_jacobian({0, 0});
    EXPECT_NEAR(at_axis(0, 0), 610, 1e-9);
    EXPECT_NEAR(at_axis(1, 1), 605, 1e-9);
  }
}

// k1 = -0.5: the image of a radius r (1 - r^2 / 2) has its maximum at r = sqrt(2/3), where it is
// 0.5443; no point is seen farther out, and points farther out are not seen.
TEST(Camera, BeyondTheFoldThereIsNothing) {
  const Camera camera(with(Lens::PlumbBob, {-0.5, 0, 0, 0, 0}));
  const double fold = std::sqrt(2.0 / 3);
  const double rim = fold * (1 - fold * fold / 2);
  EXPECT_TRUE(is_finite(camera.to_pixel({0.999 * fold, 0})));
  EXPECT_FALSE(is_finite(camera.to_pixel({1.001 * fold, 0})));
  EXPECT_NEAR(camera.to_image_point({320.5 + 610 * 0.99 * rim, 241.25}).x, 0.74889, 1e-5);
  for (const double beyond : {1.001, 1.1, 2.0, 100.0}) {
    EXPECT_FALSE(is_finite(camera.to_image_point({320.5 + 610 * beyond * rim, 241.25})));
    EXPECT_FALSE(is_finite(camera.to_image_point({320.5, 241.25 - 605 * beyond * rim})));
  }
}

// A model that folds and rises again has points with three pre-images: only the first is real.
TEST(Camera, InverseStaysOnTheFirstBranch) {
  const Camera camera(
      with(Lens::PlumbBob, {-0.5, 0.08, 0, 0, 0}));  // folds at 0.931, rises at 1.70
  test::Random random("first branch");
  for (int i = 0; i < 300; ++i) {
    const double angle = random.uniform(-M_PI, M_PI);
    const double r = random.uniform(0, 0.925);
    const ImagePoint m{r * std::cos(angle), r * std::sin(angle)};
    const ImagePoint back = camera.to_image_point(camera.to_pixel(m));
    EXPECT_LT(std::hypot(back.x - m.x, back.y - m.y), 1e-9) << r;
  }
  EXPECT_FALSE(is_finite(camera.to_image_point({320.5 + 610 * 2.0, 241.25})));
  EXPECT_FALSE(is_finite(camera.to_pixel({2.5, 0})));
}

// The same with the sixth power alone against the second: folds at 0.848, rises at 1.50.
TEST(Camera, RangeCountsTheThirdRadialTerm) {
  const Camera camera(with(Lens::PlumbBob, {-0.5, 0, 1e-3, 1e-3, 0.03}));
  for (const double r : {0.5, 0.8, 0.83, 0.845}) {
    const ImagePoint back = camera.to_image_point(camera.to_pixel({-0.6 * r, 0.8 * r}));
    EXPECT_NEAR(std::hypot(back.x, back.y), r, 1e-9);
  }
  EXPECT_FALSE(is_finite(camera.to_pixel({2.0, 0})));
}

// A pincushion that folds far out maps points near its fold farther out than the fold itself.
TEST(Camera, InverseFindsPointsThatAppearBeyondTheFoldRadius) {
  const Camera camera(with(Lens::PlumbBob, {0.6, -0.25, 0, 0, 0}));
  for (double r = 0.1; r < 1.3; r += 0.05) {
    const ImagePoint back = camera.to_image_point(camera.to_pixel({0.6 * r, 0.8 * r}));
    EXPECT_NEAR(std::hypot(back.x, back.y), r, 1e-9);
  }
}

TEST(Camera, FisheyeFoldsToo) {
  const Camera camera(with(Lens::KannalaBrandt, {-0.3, 0, 0, 0, 0}));  // slope 0 at 1.054 rad
  const double fold = std::sqrt(1 / 0.9);
  const double rim = fold * (1 - 0.3 * fold * fold);
  EXPECT_NEAR(std::atan(camera.to_image_point({320.5 + 610 * 0.99 * rim, 241.25}).x), 0.96681,
              1e-5);
  EXPECT_FALSE(is_finite(camera.to_image_point({320.5 + 610 * 1.01 * rim, 241.25})));
  EXPECT_TRUE(is_finite(camera.to_pixel({std::tan(0.999 * fold), 0})));
  EXPECT_FALSE(is_finite(camera.to_pixel({std::tan(1.001 * fold), 0})));
  const Camera ideal(with(Lens::KannalaBrandt, {}));
  EXPECT_FALSE(is_finite(ideal.to_image_point({320.5 + 610 * 1.58, 241.25})));  // behind
}

TEST(Camera, VispRadialFoldsToo) {
  const Camera camera(with(Lens::VispRadial, {-0.2, -0.1}));
  EXPECT_TRUE(is_finite(camera.to_pixel({1.29, 0})));  // sqrt(1 / 0.6) = 1.291
  EXPECT_FALSE(is_finite(camera.to_pixel({1.30, 0})));
  EXPECT_TRUE(is_finite(camera.to_image_point({320.5 + 610 * 1.82, 241.25})));  // 1.826
  EXPECT_FALSE(is_finite(camera.to_image_point({320.5 + 610 * 1.83, 241.25})));
}

TEST(Camera, NowhereStaysNowhere) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const Camera& camera : cameras()) {
    for (const double bad : {kNan, inf, -inf}) {
      EXPECT_FALSE(is_finite(camera.to_pixel({bad, 0})));
      EXPECT_FALSE(is_finite(camera.to_pixel({0, bad})));
      EXPECT_FALSE(is_finite(camera.to_image_point({bad, 100})));
      EXPECT_FALSE(is_finite(camera.to_image_point({100, bad})));
    }
  }
}

TEST(Camera, RejectsWhatNoCameraHas) {
  const auto rejects = [](auto change) {
    CameraParameters p = with(Lens::PlumbBob, kBarrel);
    change(p);
    EXPECT_THROW(Camera{p}, std::invalid_argument);
  };
  EXPECT_NO_THROW(Camera(with(Lens::PlumbBob, kBarrel)));
  rejects([](CameraParameters& p) { p.px = 0; });
  rejects([](CameraParameters& p) { p.py = -600; });
  rejects([](CameraParameters& p) { p.px = kNan; });
  rejects([](CameraParameters& p) { p.py = std::numeric_limits<double>::infinity(); });
  rejects([](CameraParameters& p) { p.u0 = kNan; });
  rejects([](CameraParameters& p) { p.v0 = kNan; });
  rejects([](CameraParameters& p) { p.width = -1; });
  rejects([](CameraParameters& p) { p.height = -1; });
  rejects([](CameraParameters& p) { p.distortion[3] = kNan; });
}

}  // namespace
}  // namespace kestrel
