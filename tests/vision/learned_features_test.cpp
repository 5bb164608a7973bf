#include "kestrel/vision/learned_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <opencv2/imgproc.hpp>

#include "kestrel/vision/feature_match.hpp"

#include "support/random.hpp"
#include "support/rendered_view.hpp"
#include "support/sift_pictures.hpp"

namespace kestrel {
namespace {

const PixelBox kBox{80, 60, 160, 120};

const LearnedFeatures& learned() {
  static const LearnedFeatures kFeatures = learn_features(test::sift_picture(), kBox, {});
  return kFeatures;
}

TEST(TemplateViews, LeaveNoTiltOfSixtyDegreesFarFromAView) {
  const std::vector<Eigen::Matrix2d> views = template_views();
  ASSERT_EQ(views.size(), 9U);
  EXPECT_TRUE(views[0].isApprox(2 * Eigen::Matrix2d::Identity()));
  for (double axis = 0; axis < M_PI; axis += 0.03) {
    const Eigen::Rotation2Dd R(axis);
    const Eigen::Matrix2d tilt = R.toRotationMatrix() * Eigen::Vector2d(0.5, 1).asDiagonal() *
                                 R.inverse().toRotationMatrix();
    double best = 0;
    for (const Eigen::Matrix2d& view : views) {
      const Eigen::Vector2d s = (tilt * view.inverse()).jacobiSvd().singularValues();
      best = std::max(best, s[1] / s[0]);
    }
    EXPECT_GT(best, 0.72) << axis;
  }
}

TEST(LearnedFeatures, LieInTheTemplateAndAreSharedAmongTheViews) {
  const LearnedFeatures& features = learned();
  ASSERT_EQ(features.at.size(), features.descriptors.size());
  ASSERT_LE(features.at.size(), std::size_t(kMaxLearnedFeatures));
  std::map<int, int> count;
  for (const LearnedFeature& f : features.at) {
    EXPECT_TRUE(f.in_template.u >= 0 && f.in_template.u <= kBox.width - 1);
    EXPECT_TRUE(f.in_template.v >= 0 && f.in_template.v <= kBox.height - 1);
    ++count[f.view];
  }
  ASSERT_EQ(count.size(), 9U);
  EXPECT_LE(count[0], kMaxLearnedFeatures / 3);
  for (int view = 1; view < 9; ++view) {
    EXPECT_GE(count[view], 10);
    EXPECT_LE(count[view], kMaxLearnedFeatures / 12);
  }
}

// A disc of scale 1 in the keypoint's frame has the area of one of scale_px in the template.
TEST(LearnedFeatures, MapToTheirOwnFrame) {
  for (const LearnedFeature& f : learned().at)
    EXPECT_NEAR(std::sqrt(f.from_template.determinant()) * f.scale_px, 1, 1e-4);
}

/// Pairs of the template with a picture that shows it through H (template px -> image px).
std::vector<AffinePair> pairs_through(const Homography& image_from_template) {
  const Homography image_from_picture =
      test::product(image_from_template, test::translation(-kBox.u, -kBox.v));
  const cv::Mat image = test::view(test::sift_picture(), image_from_picture, 320, 240);
  FastSift detector({});
  return match_features(learned(), detector.detect(image, test::whole(image)), {});
}

/// How many of the pairs are right: within 3 px, which is what places tell of the far end of a
/// keypoint's reach under a tilt its view does not have.
int right(const std::vector<AffinePair>& pairs, const Homography& H) {
  int count = 0;
  for (const AffinePair& p : pairs) {
    const Eigen::Vector3d x = H.H * Eigen::Vector3d(p.in_template.u, p.in_template.v, 1);
    if (distance({x[0] / x[2], x[1] / x[2]}, p.in_image) < 3) ++count;
  }
  return count;
}

TEST(LearnedFeatures, AreFoundAtAnyTiltUpToSixtyDegrees) {
  for (const double axis : {0.2, 1.3}) {
    for (const double tilt : {0.0, 1.05}) {
      const Homography H = test::moved({1, 0.4, tilt, axis}, {79.5, 59.5}, {159.5, 119.5});
      const auto pairs = pairs_through(H);
      // Four pairs make a homography; three times as many, and most of them right, make it sure.
      EXPECT_GE(right(pairs, H), 12) << tilt << " about " << axis;
      EXPECT_GT(right(pairs, H), 0.5 * double(pairs.size())) << tilt << " about " << axis;
    }
  }
}

// One pair predicts the map of its neighbourhood: here a similarity, the same everywhere. Half of
// the pairs should do so within a quarter: SIFT's scales are a third of an octave apart.
TEST(LearnedFeatures, PredictTheMapOfTheirNeighbourhood) {
  const Homography H = test::moved({1.3, 0.9, 0, 0}, {79.5, 59.5}, {159.5, 119.5});
  const Eigen::Matrix2f A = H.H.topLeftCorner<2, 2>().cast<float>();
  std::vector<float> errors;
  for (const AffinePair& p : pairs_through(H))
    errors.push_back((p.image_from_template * A.inverse() - Eigen::Matrix2f::Identity()).norm());
  ASSERT_GT(errors.size(), 20U);
  std::nth_element(errors.begin(), errors.begin() + long(errors.size() / 2), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.25F);
}

TEST(LearnedFeatures, RefuseWhatIsNotThere) {
  const cv::Mat picture = test::sift_picture();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const PixelBox& box : {PixelBox{-1, 0, 50, 50}, PixelBox{300, 0, 50, 50},
                              PixelBox{0, 0, 0, 0}, PixelBox{nan, 0, 50, 50}})
    EXPECT_THROW(learn_features(picture, box, {}), std::invalid_argument);
  EXPECT_THROW(learn_features(cv::Mat(), kBox, {}), std::invalid_argument);
  EXPECT_THROW(learn_features(cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(0)), kBox, {}),
               std::invalid_argument);
  FastSiftOptions options;
  options.sigma = -1;
  EXPECT_THROW(learn_features(picture, kBox, options), std::invalid_argument);
}

TEST(LearnedFeatures, AreNoneWithoutTexture) {
  EXPECT_TRUE(learn_features(cv::Mat(240, 320, CV_8U, cv::Scalar(90)), kBox, {}).at.empty());
}

}  // namespace
}  // namespace kestrel
