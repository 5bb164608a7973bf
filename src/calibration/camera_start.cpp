#include "camera_start.hpp"

#include <cmath>

#include <opencv2/calib3d.hpp>

namespace kestrel {
namespace {

/// The views as OpenCV takes them, and what it answers.
struct OpenCvViews {
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> seen;
};

OpenCvViews opencv_views(const BundleProblem& problem) {
  OpenCvViews out;
  for (const BoardView& view : problem.views) {
    out.on_board.emplace_back();
    out.seen.emplace_back();
    for (const BoardPoint& point : view.points) {
      const Eigen::Vector3d& p = problem.points[std::size_t(point.id)];
      out.on_board.back().emplace_back(float(p.x()), float(p.y()), float(p.z()));
      out.seen.back().emplace_back(float(point.in_image.u), float(point.in_image.v));
    }
  }
  return out;
}

TargetPose pose_of(const cv::Mat& rotation, const cv::Mat& translation) {
  cv::Mat r;
  cv::Mat t;
  rotation.reshape(1, 3).convertTo(r, CV_64F);
  translation.reshape(1, 3).convertTo(t, CV_64F);
  return {rotation_from_vector({r.at<double>(0), r.at<double>(1), r.at<double>(2)}),
          {t.at<double>(0), t.at<double>(1), t.at<double>(2)}};
}

/// Which of OpenCV's five coefficients stay zero.
int flags_of(CameraModel model) {
  int flags = 0;
  if (model != CameraModel::RadialTangential3) flags |= cv::CALIB_FIX_K3;
  if (model == CameraModel::None || model == CameraModel::Radial)
    flags |= cv::CALIB_FIX_K2 | cv::CALIB_ZERO_TANGENT_DIST;
  if (model == CameraModel::None) flags |= cv::CALIB_FIX_K1;
  return flags;
}

/// What OpenCV finds; throws cv::Exception where it gives up.
BundleState opencv_start(const BundleProblem& problem) {
  const OpenCvViews views = opencv_views(problem);
  const cv::Size size(problem.size.width, problem.size.height);
  cv::Mat K = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat lens;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  if (problem.model == CameraModel::KannalaBrandt) {
    cv::fisheye::calibrate(views.on_board, views.seen, size, K, lens, rotations, translations,
                           cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW);
  } else {
    lens = cv::Mat::zeros(5, 1, CV_64F);
    cv::calibrateCamera(views.on_board, views.seen, size, K, lens, rotations, translations,
                        flags_of(problem.model));
  }
  CameraParameters camera{K.at<double>(0, 0), K.at<double>(1, 1), K.at<double>(0, 2),
                          K.at<double>(1, 2)};
  for (std::size_t i = 0; i < lens.total() && i < camera.distortion.size(); ++i)
    camera.distortion[i] = lens.at<double>(int(i));
  BundleState start{values_of(problem.model, camera), {}};
  for (std::size_t i = 0; i < rotations.size(); ++i)
    start.poses.push_back(pose_of(rotations[i], translations[i]));
  return start;
}

/// A fisheye of this focal length without further bending; empty when a view has no pose under it.
std::optional<BundleState> guess(const BundleProblem& problem, double focal_px) {
  BundleState start{{focal_px, focal_px, (problem.size.width - 1) / 2.0,
                     (problem.size.height - 1) / 2.0, 0, 0, 0, 0},
                    {}};
  const Camera camera(
      camera_with(problem.model, start.values, problem.size.width, problem.size.height));
  for (const BoardView& view : problem.views) {
    const auto pose = board_pose(view, problem.points, camera);
    if (!pose) return std::nullopt;
    start.poses.push_back(*pose);
  }
  return start;
}

}  // namespace

std::vector<BundleState> camera_starts(const BundleProblem& problem) {
  std::vector<BundleState> starts;
  try {
    starts.push_back(opencv_start(problem));
  } catch (const cv::Exception&) {
    // No answer is one, too: the guesses below remain, or none.
  }
  if (problem.model == CameraModel::KannalaBrandt) {
    for (const double degrees_wide : {180.0, 120.0, 80.0, 50.0}) {
      const auto start = guess(problem, problem.size.width / (degrees_wide * M_PI / 180));
      if (start) starts.push_back(*start);
    }
  }
  return starts;
}

}  // namespace kestrel
