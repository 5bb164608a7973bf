#include "kestrel/vision/learned_features.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include "kestrel/vision/window.hpp"

#include "sift/exact_math.hpp"

namespace kestrel {
namespace {

constexpr int kTilts = 8;
constexpr double kCompression = 0.62;
constexpr double kPi = 3.141592653589793;

/// Compression along a direction hides detail that a camera could not see: as much is blurred away
/// first (Yu & Morel 2011, section 3: 0.8 px for each px that falls away).
constexpr double kBlurPerPx = 0.8;

Eigen::Matrix2d tilted(double direction_rad) {
  const sift::Direction along = sift::direction(direction_rad);
  Eigen::Matrix2d R;
  R << along.cosine, -along.sine, along.sine, along.cosine;
  return R * Eigen::Vector2d(kCompression, 1).asDiagonal() * R.transpose();
}

/// A view and how it lies: view px = A (image px) + offset.
struct View {
  cv::Mat gray;
  Eigen::Matrix2d A;
  Eigen::Vector2d offset;
};

cv::Matx23d affine(const View& view) {
  return {view.A(0, 0), view.A(0, 1), view.offset.x(), view.A(1, 0), view.A(1, 1), view.offset.y()};
}

/// Blurred along the direction of compression only, in the image: a line of taps 1/4 px apart would
/// do as well; the Gaussian of the covariance k^2 (A^-1 A^-T - 1) is that blur.
cv::Mat blurred(const cv::Mat& gray, const Eigen::Matrix2d& A) {
  const Eigen::Matrix2d inverse = A.inverse();
  const Eigen::Matrix2d C =
      kBlurPerPx * kBlurPerPx * (inverse * inverse.transpose() - Eigen::Matrix2d::Identity());
  constexpr int kRadius = 4;
  // The covariance has one direction only; a little of the other makes it a density on the pixels.
  const Eigen::Matrix2d precision = (C + 0.05 * Eigen::Matrix2d::Identity()).inverse();
  cv::Mat kernel(2 * kRadius + 1, 2 * kRadius + 1, CV_32F);
  double sum = 0;
  for (int r = -kRadius; r <= kRadius; ++r) {
    for (int c = -kRadius; c <= kRadius; ++c) {
      const Eigen::Vector2d d(c, r);
      const double weight = sift::exponential(std::max(-0.5 * d.dot(precision * d), -600.0));
      kernel.at<float>(r + kRadius, c + kRadius) = float(weight);
      sum += weight;
    }
  }
  kernel /= sum;
  cv::Mat result;
  cv::filter2D(gray, result, CV_8U, kernel);
  return result;
}

/// The part `shown` of an image through the affine map A.
View seen(const cv::Mat& gray, const PixelBox& shown, const Eigen::Matrix2d& A) {
  Eigen::Matrix<double, 2, 4> corners;
  const double right = shown.u + shown.width - 1;
  const double bottom = shown.v + shown.height - 1;
  corners << shown.u, right, right, shown.u, shown.v, shown.v, bottom, bottom;
  const Eigen::Matrix<double, 2, 4> moved = A * corners;
  const Eigen::Vector2d low = moved.rowwise().minCoeff();
  const Eigen::Vector2d size = moved.rowwise().maxCoeff() - low;
  View view{{}, A, -low};
  cv::warpAffine(blurred(gray, A), view.gray, affine(view),
                 {int(std::ceil(size.x())) + 1, int(std::ceil(size.y())) + 1}, cv::INTER_LINEAR,
                 cv::BORDER_REPLICATE);
  return view;
}

Eigen::Matrix2d rotation(double angle_rad) {
  const sift::Direction along = sift::direction(angle_rad);
  Eigen::Matrix2d R;
  R << along.cosine, -along.sine, along.sine, along.cosine;
  return R;
}

/// A keypoint of a view in template coordinates.
LearnedFeature learned(const SiftPoint& point, const View& view, const PixelBox& box, int number) {
  const Eigen::Vector2d at =
      view.A.inverse() * (Eigen::Vector2d(double(point.u), double(point.v)) - view.offset);
  LearnedFeature result;
  result.in_template = {at.x() - box.u, at.y() - box.v};
  result.from_template =
      (rotation(double(point.angle_rad)).transpose() * view.A / double(point.scale_px))
          .cast<float>();
  result.scale_px = float(double(point.scale_px) / std::sqrt(view.A.determinant()));
  result.view = number;
  return result;
}

bool is_inside(const Pixel& in_template, const PixelBox& box) {
  return in_template.u >= 0 && in_template.v >= 0 && in_template.u <= box.width - 1 &&
         in_template.v <= box.height - 1;
}

/// Adds the `most` strongest keypoints of a view that lie in the box.
void add(LearnedFeatures& features, const SiftPoints& points, const View& view, const PixelBox& box,
         int number, std::size_t most) {
  std::vector<std::size_t> order;
  std::vector<LearnedFeature> all;
  for (const SiftPoint& point : points.at) all.push_back(learned(point, view, box, number));
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_inside(all[i].in_template, box)) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&points](std::size_t a, std::size_t b) {
    return points.at[a].response > points.at[b].response;
  });
  if (order.size() > most) order.resize(most);
  for (const std::size_t i : order) {
    features.at.push_back(all[i]);
    features.descriptors.push_back(points.descriptors[i]);
  }
}

void check(const cv::Mat& gray, const PixelBox& box) {
  if (gray.empty() || gray.type() != CV_8UC1)
    throw std::invalid_argument("template: the image is not 8-bit grey");
  const bool inside = box.u >= 0 && box.v >= 0 && box.width >= 1 && box.height >= 1 &&
                      box.u + box.width <= gray.cols && box.v + box.height <= gray.rows;
  if (!inside) throw std::invalid_argument("template: the rectangle is not inside the image");
}

}  // namespace

std::vector<Eigen::Matrix2d> template_views() {
  std::vector<Eigen::Matrix2d> views{2 * Eigen::Matrix2d::Identity()};
  for (int k = 0; k < kTilts; ++k) views.push_back(tilted(k * kPi / kTilts));
  return views;
}

LearnedFeatures learn_features(const cv::Mat& gray, const PixelBox& box,
                               const FastSiftOptions& sift) {
  check(gray, box);
  const std::size_t third = kMaxLearnedFeatures / 3;
  const PixelBox shown = clipped(first_window(box, gray.cols, gray.rows), gray.cols, gray.rows);
  FastSiftOptions options = sift;
  options.max_keypoints = kMaxSiftPoints;
  options.is_doubled = true;
  LearnedFeatures features;
  // The detector enlarges the first view itself, with pixel centres where they belong.
  const View whole{gray, Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero()};
  add(features, FastSift(options).detect(gray, shown), whole, box, 0, third);
  options.is_doubled = false;
  FastSift detector(options);
  const std::vector<Eigen::Matrix2d> views = template_views();
  for (std::size_t k = 1; k < views.size(); ++k) {
    const View view = seen(gray, shown, views[k]);
    const SiftPoints& points =
        detector.detect(view.gray, {0, 0, double(view.gray.cols), double(view.gray.rows)});
    add(features, points, view, box, int(k), 2 * third / kTilts);
  }
  return features;
}

}  // namespace kestrel
