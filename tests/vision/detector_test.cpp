#include "kestrel/vision/detector.hpp"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/planted_target.hpp"

namespace kestrel {
namespace {

const PixelBox kEverywhere{0, 0, test::kGroundWidth, test::kGroundHeight};

const Template& model() {
  static const Template learned(test::planted(test::learned_place()), test::kLearnedAt, {});
  return learned;
}

bool same(const Detection& a, const Detection& b) {
  if (a.keypoints != b.keypoints || a.pairs.size() != b.pairs.size() ||
      a.hypotheses.size() != b.hypotheses.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.hypotheses.size(); ++i) {
    if (a.hypotheses[i].image_from_template.H != b.hypotheses[i].image_from_template.H ||
        a.hypotheses[i].inliers != b.hypotheses[i].inliers) {
      return false;
    }
  }
  return true;
}

TEST(Detector, FindsViewsOfTheTemplate) {
  Detector detector(model(), {});
  for (const test::Motion& motion :
       {test::Motion{0.6, 0, 0, 0}, test::Motion{1, M_PI / 3, 0, 0}, test::Motion{1.6, -2, 0, 0},
        test::Motion{1, 0, 0.9, 0}, test::Motion{1.1, 1, 0.9, 1}}) {
    const Homography truth = test::placed_at({210, 150}, motion);
    const Detection seen = detector.detect(test::planted(truth), kEverywhere);
    ASSERT_FALSE(seen.hypotheses.empty()) << motion.scale << " " << motion.tilt;
    const FittedHomography& best = seen.hypotheses.front();
    // Keypoints lie to half a pixel; the corners are extrapolated from a dozen or more of them.
    EXPECT_LT(test::error_px(best.image_from_template, truth), 3)
        << motion.scale << " " << motion.tilt;
    for (const int i : best.inliers) {
      const AffinePair& pair = seen.pairs[std::size_t(i)];
      EXPECT_LT(distance(truth * pair.in_template, pair.in_image), 5);
    }
  }
}

/// A corner of the target, 96x76 px, learned on the ground and shown elsewhere at half its size:
/// 48x38 px hold few structures of the usual size that do not reach over the rectangle.
TEST(Detector, FindsASmallTemplateAtHalfItsSize) {
  constexpr int kWidth = 96;
  constexpr int kHeight = 76;
  const PixelBox box{test::kLearnedAt.u, test::kLearnedAt.v, kWidth, kHeight};
  const Template small(test::planted(test::learned_place()), box, {});
  Detector detector(small, {});
  for (int turn = 0; turn < 4; ++turn) {
    const Homography truth = test::placed_at({210, 150}, {0.5, 0.2 + turn * M_PI / 2, 0, 0});
    const Detection seen = detector.detect(test::planted(truth), kEverywhere);
    ASSERT_FALSE(seen.hypotheses.empty()) << turn;
    const auto at = outline(seen.hypotheses.front().image_from_template, kWidth, kHeight);
    const auto to = outline(truth, kWidth, kHeight);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(distance(at[i], to[i]), 4) << turn;
  }
}

/// Small structures are four times as many; a larger template, or a wish, leaves them out.
TEST(Detector, SearchesFinerForASmallTemplateOnly) {
  const cv::Mat image = test::planted(test::learned_place());
  const auto keypoints = [&](double height_px, const TrackOptions& options) {
    const PixelBox box{test::kLearnedAt.u, test::kLearnedAt.v, 140, height_px};
    const Template learned(image, box, options);
    return Detector(learned, options).detect(image, kEverywhere).keypoints;
  };
  TrackOptions usual;
  usual.detect.sift.contrast_threshold = 0.02;
  TrackOptions coarse = usual;
  coarse.detect.sift.sigma = 2.4;
  TrackOptions enlarged = usual;
  enlarged.detect.sift.is_doubled = true;
  const int many = keypoints(126, usual);
  EXPECT_GT(many, 1.3 * keypoints(128, usual));
  EXPECT_EQ(many, keypoints(126, coarse));  // whatever the usual size is
  EXPECT_EQ(keypoints(126, enlarged), keypoints(128, enlarged));
}

/// A second look is for what is seen with a shorter side below 128 px after a look for the usual
/// structures: where nothing is expected, that may be half of what was learned.
TEST(Detector, HasASecondLookForWhatMayBeSeenSmall) {
  cv::Mat image(test::kGroundHeight, test::kGroundWidth, CV_8UC1, cv::Scalar(90));
  const cv::Rect corner(10, 10, 60, 60);
  test::ground()(corner).copyTo(image(corner));  // little to learn
  const auto detector = [&](double height_px, const TrackOptions& options) {
    return Detector(Template(image, {10, 10, height_px + 2, height_px}, options), options);
  };
  TrackOptions enlarged;
  enlarged.detect.sift.is_doubled = true;
  TrackOptions by_opencv;
  by_opencv.detect.source = SiftSource::OpenCv;
  EXPECT_FALSE(detector(126, {}).has_second_look({}));  // the first was for small ones
  EXPECT_TRUE(detector(128, {}).has_second_look({}));
  EXPECT_TRUE(detector(254, {}).has_second_look({}));
  EXPECT_FALSE(detector(256, {}).has_second_look({}));
  EXPECT_FALSE(detector(200, enlarged).has_second_look({}));
  EXPECT_FALSE(detector(200, by_opencv).has_second_look({}));
  const Detector large = detector(200, {});
  const auto seen_at = [](double scale) { return test::placed_at({200, 150}, {scale, 0.4, 0, 0}); };
  EXPECT_FALSE(large.has_second_look(seen_at(0.65)));
  EXPECT_TRUE(large.has_second_look(seen_at(0.63)));
}

/// Small structures are as many more as the inverse square of their size, and are found wherever
/// the usual ones are searched for first.
TEST(Detector, SeesMoreInASecondLook) {
  Detector detector(model(), {});
  const cv::Mat image = test::planted(test::placed_at({210, 150}, {0.5, 1, 0, 0}));
  const Detection first = detector.detect(image, kEverywhere);
  const Detection second = detector.detect(image, kEverywhere, Structures::Small);
  ASSERT_FALSE(first.hypotheses.empty() || second.hypotheses.empty());
  EXPECT_GT(second.hypotheses.front().inliers.size(), 2 * first.hypotheses.front().inliers.size());
  EXPECT_TRUE(same(first, detector.detect(image, kEverywhere)));  // one does not touch the other
}

TEST(Detector, LooksOnlyInTheWindow) {
  Detector detector(model(), {});
  const PixelBox window{20, 30, 150, 120};
  const Detection seen = detector.detect(test::planted(test::learned_place()), window);
  ASSERT_FALSE(seen.pairs.empty());
  EXPECT_LT(seen.keypoints,
            detector.detect(test::planted(test::learned_place()), kEverywhere).keypoints);
  for (const AffinePair& pair : seen.pairs) {
    EXPECT_GE(pair.in_image.u, 20);
    EXPECT_LT(pair.in_image.u, 170);
    EXPECT_GE(pair.in_image.v, 30);
    EXPECT_LT(pair.in_image.v, 150);
  }
}

TEST(Detector, SeesNothingInNothing) {
  Detector detector(model(), {});
  const cv::Mat flat(test::kGroundHeight, test::kGroundWidth, CV_8UC1, cv::Scalar(90));
  for (const Detection& seen :
       {detector.detect(flat, kEverywhere), detector.detect({}, kEverywhere),
        detector.detect(test::ground(), PixelBox{}),
        detector.detect(test::ground(), PixelBox{999, 0, 50, 50})}) {
    EXPECT_EQ(seen.keypoints, 0);
    EXPECT_TRUE(seen.pairs.empty());
    EXPECT_TRUE(seen.hypotheses.empty());
  }
}

TEST(Detector, RemembersNothing) {
  Detector used(model(), {});
  Detector fresh(model(), {});
  used.detect(test::ground(), kEverywhere);
  const cv::Mat image = test::planted(test::placed_at({230, 160}, {0.8, 1, 0.4, 0}));
  const Detection first = used.detect(image, kEverywhere);
  EXPECT_FALSE(first.hypotheses.empty());
  EXPECT_TRUE(same(first, fresh.detect(image, kEverywhere)));
  EXPECT_TRUE(same(first, used.detect(image, kEverywhere)));
}

TEST(Detector, GivesTheSameBitsWithAndWithoutAvx2) {
  TrackOptions plain;
  plain.simd = Simd::Baseline;
  Detector fast(model(), {});
  Detector slow(model(), plain);
  const cv::Mat image = test::planted(test::placed_at({230, 160}, {0.8, 1, 0.4, 0}));
  EXPECT_TRUE(same(fast.detect(image, kEverywhere), slow.detect(image, kEverywhere)));
}

}  // namespace
}  // namespace kestrel
