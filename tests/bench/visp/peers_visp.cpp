#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <visp3/core/vpImage.h>
#include <visp3/core/vpImageConvert.h>
#include <visp3/tt/vpTemplateTrackerSSDESM.h>
#include <visp3/tt/vpTemplateTrackerSSDInverseCompositional.h>
#include <visp3/tt/vpTemplateTrackerWarpHomography.h>
#include <visp3/tt/vpTemplateTrackerWarpHomographySL3.h>
#include <visp3/vision/vpHomography.h>
#include <visp3/vision/vpKeyPoint.h>

#include <Eigen/LU>

#include "bench/peers.hpp"

/// ViSP's trackers share their work among OpenMP's threads; this is how many (GNU's libgomp).
extern "C" void omp_set_num_threads(int);

namespace kestrel::test {
namespace {

constexpr double kSiftBias_px = 0.25;  // vpKeyPoint's SIFT is cv::SIFT
constexpr double kFocal_px = 600;      // any: RANSAC wants points of order one

vpImage<unsigned char> visp_image(const cv::Mat& gray) {
  vpImage<unsigned char> image;
  vpImageConvert::convert(gray, image);
  return image;
}

/// template px -> image px.
Homography from_visp(const vpHomography& image_from_first, const PixelBox& box) {
  Eigen::Matrix3d H;
  for (unsigned int i = 0; i < 9; ++i) H(i / 3, i % 3) = image_from_first[i / 3][i % 3];
  Eigen::Matrix3d first_from_template = Eigen::Matrix3d::Identity();
  first_from_template(0, 2) = box.u;
  first_from_template(1, 2) = box.v;
  return {H * first_from_template};
}

class VispKeypointTracker {
 public:
  VispKeypointTracker(const cv::Mat& gray, const PixelBox& box)
      : keypoint_("SIFT", "SIFT", "FlannBased"), box_(box) {
    keypoint_.setFilterMatchingType(vpKeyPoint::ratioDistanceThreshold);
    keypoint_.setMatchingRatioThreshold(0.8);
    const vpRect rect(box.u, box.v, box.width, box.height);
    if (keypoint_.buildReference(visp_image(gray), rect) < 8) {
      throw std::invalid_argument("too few keypoints");
    }
  }

  BenchAnswer track(const Frame& frame) {
    BenchAnswer answer;
    answer.window = {0, 0, double(frame.gray.cols), double(frame.gray.rows)};
    answer.state = "lost";
    try {
      look(frame.gray, answer);
    } catch (const std::exception&) {
      answer.state = "exception";  // vpHomography::ransac found nothing
    }
    return answer;
  }

 private:
  void look(const cv::Mat& gray, BenchAnswer& answer) {
    answer.matches = int(keypoint_.matchPoint(visp_image(gray)));
    if (answer.matches < 8) return;
    std::array<std::vector<double>, 4> points;
    for (unsigned int i = 0; i < unsigned(answer.matches); ++i) {
      vpImagePoint from;
      vpImagePoint to;
      keypoint_.getMatchedPoints(i, from, to);
      points[0].push_back((from.get_u() - kSiftBias_px - 320) / kFocal_px);
      points[1].push_back((from.get_v() - kSiftBias_px - 240) / kFocal_px);
      points[2].push_back((to.get_u() - kSiftBias_px - 320) / kFocal_px);
      points[3].push_back((to.get_v() - kSiftBias_px - 240) / kFocal_px);
    }
    vpHomography H;
    std::vector<bool> inliers;
    double residual = 0;
    if (!vpHomography::ransac(points[0], points[1], points[2], points[3], H, inliers, residual,
                              unsigned(answer.matches / 4), 2 / kFocal_px, true)) {
      return;
    }
    answer.inliers = int(std::count(inliers.begin(), inliers.end(), true));
    Eigen::Matrix3d K;
    K << kFocal_px, 0, 320, 0, kFocal_px, 240, 0, 0, 1;
    Homography found = from_visp(H, {});
    found.H = K * found.H * K.inverse();
    found.H = found.H * from_visp(vpHomography(), box_).H;
    if (answer.inliers < 8 || !is_plausible(found, box_.width, box_.height)) return;
    answer.image_from_template = found;
    answer.state = "found";
  }

  vpKeyPoint keypoint_;
  PixelBox box_;
};

/// Warp and tracker of ViSP, set up as its tutorial of template tracking does.
template <class Tracker, class Warp>
class VispTemplateTracker {
 public:
  VispTemplateTracker(const cv::Mat& gray, const PixelBox& box) : tracker_(&warp_), box_(box) {
    omp_set_num_threads(1);
    tracker_.setSampling(2, 2);
    tracker_.setLambda(0.001);
    tracker_.setIterationMax(200);
    tracker_.setPyramidal(2, 0);
    const double right = box.u + box.width - 1;
    const double below = box.v + box.height - 1;
    const vpImagePoint a(box.v, box.u);
    const vpImagePoint b(box.v, right);
    const vpImagePoint c(below, right);
    const vpImagePoint d(below, box.u);
    tracker_.initFromPoints(visp_image(gray), {a, b, c, a, c, d});
  }

  BenchAnswer track(const Frame& frame) {
    BenchAnswer answer;
    answer.window = {0, 0, double(frame.gray.cols), double(frame.gray.rows)};
    answer.state = "stopped";
    if (has_stopped_) return answer;
    try {
      tracker_.track(visp_image(frame.gray));
    } catch (const std::exception&) {
      has_stopped_ = true;
      return answer;
    }
    answer.image_from_template = from_visp(homography(), box_);
    answer.state = "found";
    return answer;
  }

 private:
  vpHomography homography() {
    if constexpr (std::is_same_v<Warp, vpTemplateTrackerWarpHomography>) {
      return warp_.getHomography(tracker_.getp());
    } else {
      warp_.computeCoeff(tracker_.getp());
      return warp_.getHomography();
    }
  }

  Warp warp_;
  Tracker tracker_;
  PixelBox box_;
  bool has_stopped_ = false;
};

template <class Tracker>
BenchMethod method(const std::string& name) {
  return {name, [](const cv::Mat& gray, const PixelBox& box) -> BenchTracker {
            const auto tracker = std::make_shared<Tracker>(gray, box);
            return [tracker](const Frame& frame) { return tracker->track(frame); };
          }};
}

}  // namespace

std::vector<BenchMethod> visp_peers() {
  using InverseCompositional = VispTemplateTracker<vpTemplateTrackerSSDInverseCompositional,
                                                   vpTemplateTrackerWarpHomography>;
  using Esm = VispTemplateTracker<vpTemplateTrackerSSDESM, vpTemplateTrackerWarpHomographySL3>;
  return {method<VispKeypointTracker>("visp_keypoint"),
          method<InverseCompositional>("visp_template_ssd_ic"), method<Esm>("visp_template_esm")};
}

}  // namespace kestrel::test
