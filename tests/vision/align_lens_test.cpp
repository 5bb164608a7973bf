// Templates seen through a lens: places are found in the image of the camera without it.
#include <array>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/geometry/straight_view.hpp"
#include "kestrel/vision/align.hpp"
#include "kestrel/vision/tracker.hpp"

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr int kSide = 120;
constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr Pixel kMiddle{59.5, 59.5};
const CameraParameters kNone{300, 300, 159.5, 119.5, kWidth, kHeight};

Camera with_lens(Lens lens, const std::array<double, 5>& distortion) {
  CameraParameters p = kNone;
  p.lens = lens;
  p.distortion = distortion;
  return Camera(p);
}

/// A webcam's, and a fisheye's: both bend the corners of the image by more than 15 px.
const std::array<Camera, 2> kLenses = {{with_lens(Lens::PlumbBob, {-0.28, 0.08, 5e-4, -4e-4, 0}),
                                        with_lens(Lens::KannalaBrandt, {-0.03, 0.005, 0, 0, 0})}};

const cv::Mat& picture() {
  static const cv::Mat image = [] {
    test::Random random("align lens picture");
    return test::texture(kSide, kSide, random);
  }();
  return image;
}

/// What the camera sees where without its lens it would see this.
cv::Mat through(const Camera& camera, const cv::Mat& straight) {
  const Camera pinhole(kNone);
  cv::Mat map(straight.size(), CV_32FC2);
  for (int v = 0; v < map.rows; ++v) {
    for (int u = 0; u < map.cols; ++u) {
      const Pixel from = pinhole.to_pixel(camera.to_image_point({double(u), double(v)}));
      map.at<cv::Vec2f>(v, u) = {float(from.u), float(from.v)};
    }
  }
  cv::Mat bent;
  cv::remap(straight, bent, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return bent;
}

/// The template over a ground with a texture of its own.
cv::Mat scene(const Homography& H) {
  test::Random random("align lens scene");
  cv::Mat image = test::texture(kWidth, kHeight, random);
  const cv::Mat white(picture().size(), CV_8UC1, cv::Scalar(255));
  const cv::Mat covered = test::view(white, H, kWidth, kHeight) > 250;
  test::view(picture(), H, kWidth, kHeight).copyTo(image, covered);
  return image;
}

Homography any_view(test::Random& random) {
  // Beside the middle, where a lens bends one side more than the other.
  const Pixel there{random.uniform(90, 230), random.uniform(80, 160)};
  return test::moved({random.uniform(0.8, 1.2), random.uniform(-3, 3), random.uniform(0, 0.5),
                      random.uniform(0, 6)},
                     kMiddle, there);
}

double error_px(const Homography& found, const Homography& truth) {
  return test::corner_distance(found, truth, kSide, kSide);
}

TEST(AlignThroughALens, FindsTheStraightView) {
  test::Random random("align lens views");
  for (const Camera& camera : kLenses) {
    AlignOptions options;
    options.lens = camera;
    Aligner with(template_blocks(picture(), {}), options);
    Aligner without(template_blocks(picture(), {}), {});
    double worst_fitted_px = 0;
    double worst_px = 0;
    for (int i = 0; i < 15; ++i) {
      const Homography H = any_view(random);
      ImagePyramid pyramid;
      const cv::Mat image = through(camera, scene(H));  // the pyramid looks at it
      pyramid.look(image, {0, 0, kWidth, kHeight}, with.levels(), Simd::Auto);
      const auto bent = bent_view(H, kSide, kSide, camera);
      if (!bent) continue;
      const Homography start =
          test::product(test::translation(random.uniform(-4, 4), random.uniform(-4, 4)), *bent);
      const auto found = with.align(pyramid, start);
      ASSERT_TRUE(found && found->is_accepted) << i;
      // As without a lens (Align.FindsTheViewFromNearby), and a second resampling of the picture.
      worst_px = std::max(worst_px, error_px(found->straight_from_template, H));
      EXPECT_LT(error_px(found->straight_from_template, H), 0.2) << i;
      EXPECT_LT(error_px(found->image_from_template, *bent), 0.5) << i;
      if (const auto fitted = without.align(pyramid, start)) {
        const auto view = straight_view(fitted->image_from_template, kSide, kSide, camera);
        worst_fitted_px = std::max(worst_fitted_px, error_px(view->image_from_template, H));
      }
    }
    std::printf("%.3f px through the lens, %.3f px fitted\n", worst_px, worst_fitted_px);
    EXPECT_GT(worst_fitted_px, 2 * worst_px) << "what a fit of the whole leaves, to compare";
  }
}

TEST(AlignThroughALens, GivesTheSameBitsWithAndWithoutAvx2) {
  test::Random random("align lens bits");
  const Homography H = any_view(random);
  const cv::Mat image = through(kLenses[0], scene(H));
  const auto found = [&](Simd simd) {
    AlignOptions options;
    options.lens = kLenses[0];
    options.simd = simd;
    Aligner with(template_blocks(picture(), {}), options);
    ImagePyramid pyramid;
    pyramid.look(image, {0, 0, kWidth, kHeight}, with.levels(), simd);
    return with.align(pyramid, *bent_view(H, kSide, kSide, kLenses[0])).value();
  };
  EXPECT_EQ(found(Simd::Auto).straight_from_template.H,
            found(Simd::Baseline).straight_from_template.H);
}

/// The whole tracker from its first frame: keypoints, then pixels.
TEST(TrackerThroughALens, FindsTheStraightView) {
  test::Random random("tracker lens");
  for (const Camera& camera : kLenses) {
    TrackOptions options;
    options.lens = camera;
    Tracker tracker(picture(), {0, 0, kSide, kSide}, options);
    TrackState state = tracker.start(kWidth, kHeight);
    state.last_seen.reset();  // it was not learned where it is now
    const Homography first = any_view(random);
    for (int k = 0; k < 4; ++k) {
      const Homography H = test::product(test::translation(1.5 * k, -k), first);
      const Frame frame{k, k / 30.0, through(camera, scene(H)), std::nullopt};
      const Track seen = tracker.track(frame, state);
      state = seen.next;
      ASSERT_TRUE(seen.found()) << k;
      ASSERT_TRUE(seen.straight_from_template.has_value());
      EXPECT_LT(error_px(*seen.straight_from_template, H), 0.25) << k;
      const auto view = straight_view(seen, kSide, kSide, camera);
      EXPECT_EQ(view->image_from_template.H, seen.straight_from_template->H);
      EXPECT_EQ(view->camera.parameters().lens, Lens::Pinhole);
    }
  }
}

TEST(TrackerThroughALens, WithoutOneFitsAsBefore) {
  Track seen;
  EXPECT_FALSE(straight_view(seen, kSide, kSide, kLenses[0]).has_value());
  seen.image_from_template = test::translation(80, 60);
  const auto fitted = straight_view(*seen.image_from_template, kSide, kSide, kLenses[0]);
  EXPECT_EQ(straight_view(seen, kSide, kSide, kLenses[0])->image_from_template.H,
            fitted->image_from_template.H);
}

}  // namespace
}  // namespace kestrel
