// Where the rendered frames show their template, measured on the grey levels alone.
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>

#include "bench/stress.hpp"
#include "bench/stress_texture.hpp"

namespace kestrel::test {
namespace {

class StressTruth : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(stress_texture("graffiti").file)) {
      GTEST_SKIP() << "opencv-doc is not installed";
    }
  }
};

Homography truth_homography(const StressSequence& sequence, std::int64_t frame) {
  const PixelBox& box = sequence.sequence.template_px;
  const auto corners = template_corners(box.width, box.height);
  std::vector<PixelPair> pairs;
  for (std::size_t i = 0; i < 4; ++i) {
    pairs.push_back({corners[i], sequence.sequence.truth.at(frame)[i]});
  }
  return fit_homography(pairs).value();
}

/// Bilinear value; NaN outside.
double value_at(const cv::Mat& gray, const Pixel& p) {
  const int i = int(std::floor(p.u));
  const int j = int(std::floor(p.v));
  if (i < 0 || j < 0 || i + 1 >= gray.cols || j + 1 >= gray.rows) return std::nan("");
  const double a = p.u - i;
  const double b = p.v - j;
  const auto grey = [&](int y, int x) { return double(gray.at<uchar>(y, x)); };
  return (1 - b) * ((1 - a) * grey(j, i) + a * grey(j, i + 1)) +
         b * ((1 - a) * grey(j + 1, i) + a * grey(j + 1, i + 1));
}

/// Where the frame truly shows the template, as eight parameters of a homography about the truth
/// say that are fitted to the grey levels (Gauss-Newton on all pixels, gain and bias free): mean
/// distance of the corners from the truth, px.
double dense_error_px(const cv::Mat& learned, const PixelBox& box, const cv::Mat& frame,
                      const Homography& truth) {
  Eigen::Matrix3d H = truth.H / truth.H(2, 2);
  const Eigen::Vector3d scale(box.width, box.height, 1);
  for (int step = 0; step < 6; ++step) {
    Eigen::Matrix<double, 10, 10> A = Eigen::Matrix<double, 10, 10>::Zero();
    Eigen::Matrix<double, 10, 1> b = Eigen::Matrix<double, 10, 1>::Zero();
    for (int y = 3; y < int(box.height) - 3; ++y) {
      for (int x = 3; x < int(box.width) - 3; ++x) {
        const Eigen::Vector3d q = H * Eigen::Vector3d(x, y, 1);
        const Pixel p{q.x() / q.z(), q.y() / q.z()};
        const double grey = value_at(frame, p);
        const double gu = (value_at(frame, {p.u + 0.5, p.v}) - value_at(frame, {p.u - 0.5, p.v}));
        const double gv = (value_at(frame, {p.u, p.v + 0.5}) - value_at(frame, {p.u, p.v - 0.5}));
        if (!std::isfinite(grey + gu + gv)) continue;
        const double T = learned.at<uchar>(int(box.v) + y, int(box.u) + x);
        const double gw = -(gu * p.u + gv * p.v);
        const double xs = x / scale.x();
        const double ys = y / scale.y();
        Eigen::Matrix<double, 10, 1> j;
        j << gu * xs, gu * ys, gu, gv * xs, gv * ys, gv, gw * xs, gw * ys, -T / 128, -1;
        j.head<8>() /= q.z();
        A += j * j.transpose();
        b += j * (T - grey);
      }
    }
    const Eigen::Matrix<double, 10, 1> d = A.ldlt().solve(b);
    Eigen::Matrix3d dH;
    dH << d[0] / scale.x(), d[1] / scale.y(), d[2], d[3] / scale.x(), d[4] / scale.y(), d[5],
        d[6] / scale.x(), d[7] / scale.y(), 0;
    H += dH;
  }
  double sum = 0;
  const auto fitted = outline({H}, box.width, box.height);
  const auto wanted = outline(truth, box.width, box.height);
  for (std::size_t i = 0; i < 4; ++i) sum += distance(fitted[i], wanted[i]) / 4;
  return sum;
}

/// The truth is where the picture is: dense alignment of all pixels, whose own error is below
/// 0.02 px with this many pixels of grey noise 1.5 and its bilinear interpolation.
TEST_F(StressTruth, TruthIsWhereThePictureIs) {
  for (const char* texture : {"graffiti", "board", "aerial"}) {
    const StressSequence sequence = stress_sequence({"nominal", texture, 40, 3});
    const std::vector<cv::Mat> frames = rendered_frames(sequence);
    for (const std::int64_t k : {9, 21, 38}) {
      EXPECT_LT(dense_error_px(frames[0], sequence.sequence.template_px, frames[std::size_t(k)],
                               truth_homography(sequence, k)),
                0.02)
          << texture << " frame " << k;
    }
  }
}

/// Blur moves no centroid: with an open shutter the truth is the mean over the exposure.
TEST_F(StressTruth, TruthOfABlurredFrameIsItsMean) {
  const StressSequence sequence = stress_sequence({"flight", "board", 30, 2});
  const std::vector<cv::Mat> frames = rendered_frames(sequence);
  for (const std::int64_t k : {7, 14, 29}) {
    EXPECT_LT(dense_error_px(frames[0], sequence.sequence.template_px, frames[std::size_t(k)],
                             truth_homography(sequence, k)),
              0.1)
        << k;
  }
}

/// Mean light over each pixel by 9 x 9 rays, through the homography only (none of the renderer's
/// geometry); NaN where a ray leaves the poster.
cv::Mat supersampled(const cv::Mat& poster, const PixelBox& box, const Homography& truth) {
  const Eigen::Matrix3d back = truth.H.inverse();
  cv::Mat light(480, 640, CV_32F);
  for (int v = 0; v < light.rows; ++v) {
    for (int u = 0; u < light.cols; ++u) {
      double grey = 0;
      for (int i = 0; i < 81 && std::isfinite(grey); ++i) {
        const int row = i / 9;
        const Eigen::Vector3d q =
            back * Eigen::Vector3d(u + (i % 9 - 4) / 9., v + (row - 4) / 9., 1);
        grey += value_at(poster, {(q.x() / q.z() + 0.5) / box.width * poster.cols - 0.5,
                                  (q.y() / q.z() + 0.5) / box.height * poster.rows - 0.5}) /
                81;
      }
      light.at<float>(v, u) = float(grey);
    }
  }
  return light;
}

/// How a frame differs from a picture of the same: the shift of least squares (px), and what is
/// left, as a share of the picture's contrast.
struct Difference {
  double shift_px = 0;
  double residual = 0;
  int pixels = 0;
};

Difference difference(const cv::Mat& frame, const cv::Mat& wanted) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double sum = 0;
  double squares = 0;
  double contrast = 0;
  Difference result;
  for (int v = 1; v + 1 < frame.rows; ++v) {
    for (int u = 1; u + 1 < frame.cols; ++u) {
      const auto w = [&](int y, int x) { return double(wanted.at<float>(y, x)); };
      const Eigen::Vector3d g((w(v, u + 1) - w(v, u - 1)) / 2, (w(v + 1, u) - w(v - 1, u)) / 2, 1);
      const double d = frame.at<uchar>(v, u) - w(v, u);
      if (!std::isfinite(g.sum() + d)) continue;
      A += g * g.transpose();
      b += d * g;
      squares += d * d;
      sum += w(v, u);
      contrast += w(v, u) * w(v, u);
      ++result.pixels;
    }
  }
  const Eigen::Vector3d x = A.ldlt().solve(b);
  const double n = result.pixels;
  result.shift_px = x.head<2>().norm();
  result.residual = std::sqrt((squares - x.dot(b)) / (contrast - sum * sum / n));
  return result;
}

/// A frame is the mean light over each pixel, in the right place, also where the view is oblique or
/// small. The renderer's filter is up to 9 % wider than a pixel, and smoother than a square: on a
/// picture as sharp as this circuit board that leaves a tenth of the contrast; taps of the texture
/// without averaging would leave half of it.
TEST_F(StressTruth, FrameIsTheSupersampledPoster) {
  const cv::Mat poster = load_picture(stress_texture("board").file);
  for (const auto& [cls, k] :
       std::vector<std::pair<std::string, int>>{{"tilt", 30}, {"scale", 38}, {"nominal", 17}}) {
    const StressSequence sequence = stress_sequence({cls, "board", k + 1, 1});
    const cv::Mat wanted =
        supersampled(poster, sequence.sequence.template_px, truth_homography(sequence, k));
    const Difference found = difference(rendered_frames(sequence).back(), wanted);
    ASSERT_GT(found.pixels, 3000);
    EXPECT_LT(found.shift_px, 0.02) << cls;
    EXPECT_LT(found.residual, 0.12) << cls;
  }
}

}  // namespace
}  // namespace kestrel::test
