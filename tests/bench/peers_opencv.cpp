#include <memory>
#include <stdexcept>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>

#include "kestrel/vision/window.hpp"

#include "bench/peers.hpp"

namespace kestrel::test {
namespace {

constexpr double kSiftBias_px = 0.25;
constexpr int kMostKeypoints = 2000;
constexpr float kRatio = 0.8F;  // Lowe's
constexpr double kReprojection_px = 3;
constexpr std::size_t kFewestInliers = 8;

enum class Look { Window, WholeFrame };
enum class Search { Flann, BruteForceL2, BruteForceHamming };

/// What one peer is made of.
struct Parts {
  std::string name;
  std::function<cv::Ptr<cv::Feature2D>()> detector;
  double bias_px = 0;  // taken off every keypoint
  Search search = Search::Flann;
  int robust = cv::RANSAC;
  Look look = Look::Window;
};

struct Points {
  std::vector<cv::Point2f> at;
  cv::Mat descriptors;
};

/// Keypoints inside a box, in coordinates of the image.
Points points_in(const cv::Mat& gray, const PixelBox& box, cv::Feature2D& detector,
                 double bias_px) {
  const PixelBox part = clipped(box, gray.cols, gray.rows);
  if (part.width < 16 || part.height < 16) return {};
  const cv::Rect crop(int(part.u), int(part.v), int(part.width), int(part.height));
  std::vector<cv::KeyPoint> found;
  Points points;
  detector.detectAndCompute(gray(crop), cv::noArray(), found, points.descriptors);
  for (const cv::KeyPoint& keypoint : found) {
    points.at.emplace_back(float(keypoint.pt.x - bias_px + crop.x),
                           float(keypoint.pt.y - bias_px + crop.y));
  }
  return points;
}

cv::Ptr<cv::DescriptorMatcher> matcher_over(const cv::Mat& descriptors, Search search) {
  cv::Ptr<cv::DescriptorMatcher> matcher;
  if (search == Search::Flann) matcher = cv::makePtr<cv::FlannBasedMatcher>();
  if (search == Search::BruteForceL2) matcher = cv::BFMatcher::create(cv::NORM_L2);
  if (search == Search::BruteForceHamming) matcher = cv::BFMatcher::create(cv::NORM_HAMMING);
  matcher->add(std::vector<cv::Mat>{descriptors});
  matcher->train();  // once: kept as the trained set, the trees are not built again
  return matcher;
}

class KeypointTracker {
 public:
  KeypointTracker(const Parts& parts, const cv::Mat& gray, const PixelBox& box)
      : parts_(parts), detector_(parts.detector()), box_(box) {
    model_ = points_in(gray, box, *detector_, parts.bias_px);
    if (model_.at.size() < kFewestInliers) throw std::invalid_argument("too few keypoints");
    for (cv::Point2f& p : model_.at) p -= cv::Point2f(float(box.u), float(box.v));
    cv::setRNGSeed(1);
    matcher_ = matcher_over(model_.descriptors, parts.search);
    window_ = parts.look == Look::Window ? first_window(box, gray.cols, gray.rows)
                                         : PixelBox{0, 0, double(gray.cols), double(gray.rows)};
  }

  BenchAnswer track(const Frame& frame) {
    BenchAnswer answer = look(frame.gray);
    if (parts_.look == Look::WholeFrame) return answer;
    const int width = frame.gray.cols;
    const int height = frame.gray.rows;
    window_ = answer.image_from_template
                  ? window_around(outline(*answer.image_from_template, box_.width, box_.height),
                                  width, height)
                  : doubled_window(window_, width, height);
    return answer;
  }

 private:
  std::vector<cv::DMatch> matches(const cv::Mat& descriptors) const {
    std::vector<std::vector<cv::DMatch>> nearest;
    matcher_->knnMatch(descriptors, nearest, 2);
    std::vector<cv::DMatch> kept;
    for (const auto& two : nearest) {
      if (two.size() == 2 && two[0].distance < kRatio * two[1].distance) kept.push_back(two[0]);
    }
    return kept;
  }

  BenchAnswer look(const cv::Mat& gray) const {
    BenchAnswer answer;
    answer.window = window_;
    answer.state = "lost";
    const Points seen = points_in(gray, window_, *detector_, parts_.bias_px);
    answer.keypoints = int(seen.at.size());
    if (seen.at.size() < kFewestInliers) return answer;
    std::vector<cv::Point2f> from;
    std::vector<cv::Point2f> to;
    for (const cv::DMatch& match : matches(seen.descriptors)) {
      from.push_back(model_.at[std::size_t(match.trainIdx)]);
      to.push_back(seen.at[std::size_t(match.queryIdx)]);
    }
    answer.matches = int(from.size());
    if (from.size() < kFewestInliers) return answer;
    cv::Mat inliers;
    const cv::Mat H = cv::findHomography(from, to, parts_.robust, kReprojection_px, inliers);
    answer.inliers = H.empty() ? 0 : cv::countNonZero(inliers);
    if (std::size_t(answer.inliers) < kFewestInliers) return answer;
    Homography found;
    for (int i = 0; i < 9; ++i) found.H(i / 3, i % 3) = H.at<double>(i / 3, i % 3);
    if (!is_plausible(found, box_.width, box_.height)) return answer;
    answer.image_from_template = found;
    answer.state = "found";
    return answer;
  }

  Parts parts_;
  cv::Ptr<cv::Feature2D> detector_;
  PixelBox box_;
  Points model_;
  cv::Ptr<cv::DescriptorMatcher> matcher_;
  PixelBox window_;
};

BenchMethod method(const Parts& parts) {
  return {parts.name, [parts](const cv::Mat& gray, const PixelBox& box) -> BenchTracker {
            cv::setNumThreads(1);
            const auto tracker = std::make_shared<KeypointTracker>(parts, gray, box);
            return [tracker](const Frame& frame) { return tracker->track(frame); };
          }};
}

}  // namespace

std::vector<BenchMethod> opencv_peers() {
  const auto sift = [] { return cv::Ptr<cv::Feature2D>(cv::SIFT::create(kMostKeypoints)); };
  const auto orb = [] { return cv::Ptr<cv::Feature2D>(cv::ORB::create(1000)); };
  const auto akaze = [] { return cv::Ptr<cv::Feature2D>(cv::AKAZE::create()); };
  using S = Search;
  return {
      method({"cv_sift_flann_ransac", sift, kSiftBias_px, S::Flann, cv::RANSAC, Look::Window}),
      method({"cv_sift_flann_full", sift, kSiftBias_px, S::Flann, cv::RANSAC, Look::WholeFrame}),
      method({"cv_sift_bf_magsac", sift, kSiftBias_px, S::BruteForceL2, cv::USAC_MAGSAC,
              Look::Window}),
      method({"cv_orb", orb, 0, S::BruteForceHamming, cv::RANSAC, Look::Window}),
      method({"cv_akaze", akaze, 0, S::BruteForceHamming, cv::RANSAC, Look::Window}),
  };
}

}  // namespace kestrel::test
