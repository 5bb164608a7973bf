#include "kestrel/geometry/straight_view.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kWidth_px = 240;
constexpr double kHeight_px = 180;

const CameraParameters kNone{600, 600, 319.5, 239.5, 640, 480};

CameraParameters with_lens(Lens lens, const std::array<double, 5>& distortion) {
  CameraParameters p = kNone;
  p.lens = lens;
  p.distortion = distortion;
  return p;
}

const std::array<Camera, 3> kLenses = {
    {Camera(with_lens(Lens::PlumbBob, {-0.28, 0.08, 5e-4, -4e-4, 0})),
     Camera(with_lens(Lens::KannalaBrandt, {-0.03, 0.005, 0, 0, 0})),
     Camera(with_lens(Lens::VispRadial, {-0.1, 0.1, 0, 0, 0}))}};

/// A template of about its own size somewhere in the image, a little tilted.
Homography any_view(test::Random& random) {
  Homography view;
  const double turn = random.uniform(-0.4, 0.4);
  const double scale = random.uniform(0.8, 1.2);
  view.H << scale * std::cos(turn), -scale * std::sin(turn), random.uniform(120, 220),
      scale * std::sin(turn), scale * std::cos(turn), random.uniform(80, 130),
      random.uniform(-2e-4, 2e-4), random.uniform(-2e-4, 2e-4), 1;
  return view;
}

Pixel bent(const Pixel& straight, const Camera& lens) {
  return lens.to_pixel(Camera(kNone).to_image_point(straight));
}

/// The homography that a tracker finds, which looks at the whole template; the lens in between.
Homography tracked(const Homography& straight, const Camera& lens) {
  std::vector<PixelPair> pairs;
  for (double v = 2; v < kHeight_px; v += 8)
    for (double u = 2; u < kWidth_px; u += 8)
      pairs.push_back({{u, v}, bent(straight * Pixel{u, v}, lens)});
  return fit_homography(pairs).value();
}

double worst_corner_px(const Homography& a, const Homography& b) {
  double worst = 0;
  for (const Pixel& corner : template_corners(kWidth_px, kHeight_px))
    worst = std::max(worst, distance(a * corner, b * corner));
  return worst;
}

TEST(StraightView, IsTheSameToTheBitWithoutALens) {
  test::Random random("no lens");
  const Homography view = any_view(random);
  const auto straight = straight_view(view, kWidth_px, kHeight_px, Camera(kNone));
  ASSERT_TRUE(straight.has_value());
  EXPECT_EQ(straight->image_from_template.H, view.H);
  EXPECT_EQ(straight->camera.parameters().lens, Lens::Pinhole);
}

TEST(StraightView, IsWhatThePinholeWouldHaveSeen) {
  test::Random random("lenses");
  for (const Camera& lens : kLenses) {
    double worst_px = 0;
    double worst_at_corners_px = 0;
    for (int i = 0; i < 20; ++i) {
      const Homography truth = any_view(random);
      const Homography seen = tracked(truth, lens);
      const auto straight = straight_view(seen, kWidth_px, kHeight_px, lens);
      ASSERT_TRUE(straight.has_value());
      worst_px = std::max(worst_px, worst_corner_px(straight->image_from_template, truth));
      for (const Pixel& corner : template_corners(kWidth_px, kHeight_px)) {
        const Pixel there = Camera(kNone).to_pixel(lens.to_image_point(seen * corner));
        worst_at_corners_px = std::max(worst_at_corners_px, distance(there, truth * corner));
      }
    }
    // Removing the lens at the corners alone is off by a pixel or so; what is left here is of
    // second order, and the kdu of ViSP's lens is not quite the inverse of its kud.
    EXPECT_LT(worst_px, 0.33 * worst_at_corners_px);
    EXPECT_GT(worst_at_corners_px, 0.5);
  }
}

TEST(StraightView, OfATemplateThatIsPartlyOutsideTakesWhatIsInside) {
  Homography half;
  half.H << 1, 0, 640 - kWidth_px / 2, 0, 1, 150, 0, 0, 1;
  EXPECT_TRUE(straight_view(half, kWidth_px, kHeight_px, kLenses[0]).has_value());
  Homography outside;
  outside.H << 1, 0, 630, 0, 1, 150, 0, 0, 1;
  EXPECT_FALSE(straight_view(outside, kWidth_px, kHeight_px, kLenses[0]).has_value());
  Homography nonsense;
  nonsense.H.setConstant(std::nan(""));
  EXPECT_FALSE(straight_view(nonsense, kWidth_px, kHeight_px, kLenses[0]).has_value());
}

// What a tracker that looks at the whole template alike would find is the bent view, and back again
// the straight one is what straight_view makes of it: to second order in what no homography fits.
TEST(BentView, IsWhatATrackerFinds) {
  test::Random random("bent view");
  for (const Camera& lens : kLenses) {
    for (int k = 0; k < 20; ++k) {
      const Homography straight = any_view(random);
      const auto bent = bent_view(straight, kWidth_px, kHeight_px, lens);
      ASSERT_TRUE(bent.has_value());
      // Another grid of points on the same template: the fit differs by a part of the few pixels
      // that the lens bends it.
      EXPECT_LT(worst_corner_px(*bent, tracked(straight, lens)), 0.5);
      const auto back = straight_view(*bent, kWidth_px, kHeight_px, lens);
      ASSERT_TRUE(back.has_value());
      EXPECT_LT(worst_corner_px(back->image_from_template, straight), 0.3);
    }
  }
}

TEST(BentView, IsTheSameWithoutALens) {
  test::Random random("bent view without a lens");
  const Homography view = any_view(random);
  EXPECT_EQ(bent_view(view, kWidth_px, kHeight_px, Camera(kNone))->H, view.H);
}

TEST(BentView, IsNoneOfWhatCannotBeSeen) {
  Homography beside;
  beside.H(0, 2) = 5000;
  EXPECT_FALSE(bent_view(beside, kWidth_px, kHeight_px, kLenses[0]).has_value());
}

}  // namespace
}  // namespace kestrel
