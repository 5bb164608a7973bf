#include "kestrel/vision/straight_template.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace kestrel {
namespace {

/// A rectangle of the normalised plane.
struct Span {
  ImagePoint first;
  ImagePoint last;
};

/// Between where the box's outer corners are; not finite when the lens shows one of them nowhere.
Span span_of(const PixelBox& box, const Camera& camera) {
  const double left = box.u - 0.5;
  const double top = box.v - 0.5;
  const auto at = [&](double u, double v) { return camera.to_image_point({u, v}); };
  const ImagePoint a = at(left, top);
  const ImagePoint b = at(left + box.width, top);
  const ImagePoint c = at(left + box.width, top + box.height);
  const ImagePoint d = at(left, top + box.height);
  return {{(a.x + d.x) / 2, (a.y + b.y) / 2}, {(b.x + c.x) / 2, (c.y + d.y) / 2}};
}

/// For each pixel of the box where it is in the picture; far outside where it is nowhere.
cv::Mat places(const PixelBox& box, const Span& span, const Camera& camera) {
  cv::Mat map(int(box.height), int(box.width), CV_32FC2);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.cols; ++column) {
      const double s = (column + 0.5) / box.width;
      const double t = (row + 0.5) / box.height;
      const Pixel seen = camera.to_pixel({span.first.x + s * (span.last.x - span.first.x),
                                          span.first.y + t * (span.last.y - span.first.y)});
      const bool is_seen = std::isfinite(seen.u) && std::isfinite(seen.v);
      map.at<cv::Vec2f>(row, column) =
          is_seen ? cv::Vec2f(float(seen.u), float(seen.v)) : cv::Vec2f(-1e4F, -1e4F);
    }
  }
  return map;
}

}  // namespace

Homography straight_place(const PixelBox& box, const Camera& camera) {
  Homography place;
  place.H << 1, 0, box.u, 0, 1, box.v, 0, 0, 1;
  if (camera.parameters().lens == Lens::Pinhole) return place;
  const CameraParameters& c = camera.parameters();
  const Span span = span_of(box, camera);
  const double right = c.px * (span.last.x - span.first.x) / box.width;  // px for each of the box
  const double down = c.py * (span.last.y - span.first.y) / box.height;
  Eigen::Matrix3d H;
  H << right, 0, c.u0 + c.px * span.first.x + right / 2,  //
      0, down, c.v0 + c.py * span.first.y + down / 2,     //
      0, 0, 1;
  if (H.allFinite()) place.H = H;
  return place;
}

cv::Mat straight_template(const cv::Mat& gray, const PixelBox& box, const Camera& camera) {
  const cv::Rect whole(0, 0, gray.cols, gray.rows);
  const cv::Rect part(int(box.u), int(box.v), int(box.width), int(box.height));
  const bool is_inside = part.area() > 0 && (part & whole) == part;
  if (camera.parameters().lens == Lens::Pinhole || !is_inside) return gray;
  const Span span = span_of(box, camera);
  const double corners = span.first.x + span.first.y + span.last.x + span.last.y;
  if (!std::isfinite(corners)) return gray;
  cv::Mat straight = gray.clone();
  cv::Mat inner = straight(part);
  cv::remap(gray, inner, places(box, span, camera), cv::noArray(), cv::INTER_CUBIC);
  return straight;
}

}  // namespace kestrel
