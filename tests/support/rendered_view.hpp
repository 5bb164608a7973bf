#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/geometry/homography.hpp"

#include "support/random.hpp"

namespace kestrel::test {

/// Grey pattern without repetition, of structures about 5, 11 and 23 px wide: enough keypoints at
/// every scale, and nothing finer than a view of half the size can show.
inline cv::Mat texture(int width, int height, Random& random) {
  cv::Mat sum(height, width, CV_32F, cv::Scalar(128));
  for (const int cell : {5, 11, 23}) {
    cv::Mat coarse(height / cell + 2, width / cell + 2, CV_32F);
    for (int i = 0; i < int(coarse.total()); ++i) coarse.at<float>(i) = float(random.normal());
    cv::Mat fine;
    cv::resize(coarse, fine, {coarse.cols * cell, coarse.rows * cell}, 0, 0, cv::INTER_CUBIC);
    sum += 40 * fine(cv::Rect(0, 0, width, height));
  }
  cv::Mat gray;
  sum.convertTo(gray, CV_8U);
  return gray;
}

/// What a camera sees of a texture on a grey ground.
inline cv::Mat view(const cv::Mat& seen, const Homography& image_from_texture, int width,
                    int height) {
  cv::Matx33d H;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) H(r, c) = image_from_texture.H(r, c);
  }
  cv::Mat image;
  cv::warpPerspective(seen, image, H, {width, height}, cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                      cv::Scalar(128));
  return image;
}

inline void add_noise(cv::Mat& gray, double sigma, Random& random) {
  for (int i = 0; i < int(gray.total()); ++i) {
    gray.data[i] = cv::saturate_cast<uchar>(gray.data[i] + sigma * random.normal());
  }
}

inline Homography translation(double u, double v) {
  Homography result;
  result.H << 1, 0, u, 0, 1, v, 0, 0, 1;
  return result;
}

/// First b, then a.
inline Homography product(const Homography& a, const Homography& b) {
  return {(a.H * b.H) / (a.H * b.H)(2, 2)};
}

/// How a plane turns before a camera: angles in rad, angle clockwise on the screen, tilt about an
/// axis of the plane.
struct Motion {
  double scale = 1;
  double angle = 0;
  double tilt = 0;
  double tilt_axis = 0;
};

/// Moves the plane with the point `from` to `to`, as a camera of focal length `range` px sees it.
inline Homography moved(const Motion& motion, const Pixel& from, const Pixel& to,
                        double range = 600) {
  const auto turn = [](double a) {
    Eigen::Matrix3d R;
    R << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
    return R;
  };
  Eigen::Matrix3d tilt;  // the plane turned about its x axis: y shortens, depth grows along y
  tilt << 1, 0, 0, 0, std::cos(motion.tilt), 0, 0, std::sin(motion.tilt) / range, 1;
  Eigen::Matrix3d size = Eigen::Matrix3d::Identity();
  size(0, 0) = size(1, 1) = motion.scale;
  const Eigen::Matrix3d about =
      turn(motion.angle) * size * turn(motion.tilt_axis) * tilt * turn(-motion.tilt_axis);
  return product(translation(to.u, to.v),
                 product(Homography{about}, translation(-from.u, -from.v)));
}

/// Mean distance of the template's corners under two homographies, px.
inline double corner_distance(const Homography& a, const Homography& b, double width,
                              double height) {
  const auto p = outline(a, width, height);
  const auto q = outline(b, width, height);
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += distance(p[i], q[i]);
  return sum / 4;
}

}  // namespace kestrel::test
