#include "kestrel/io/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "overlay_status.hpp"

namespace kestrel {
namespace {

const cv::Scalar kWhite(255, 255, 255);
const cv::Scalar kBlack(0, 0, 0);
const cv::Scalar kGrey(170, 170, 170);
const cv::Scalar kGreen(60, 220, 40);
const cv::Scalar kRed(40, 40, 235);
constexpr int kShift = 4;  // OpenCV draws at 1/16 px

cv::Point fixed_point(const Pixel& p) {
  return {int(std::lround(p.u * (1 << kShift))), int(std::lround(p.v * (1 << kShift)))};
}

bool is_near(const Pixel& p, const cv::Mat& picture) {
  constexpr double kMargin = 64;  // more than any mark's size
  return p.u > -kMargin && p.v > -kMargin && p.u < picture.cols + kMargin &&
         p.v < picture.rows + kMargin;
}

struct Segment {
  Pixel from;
  Pixel to;
};

// The part of a segment near the picture (Liang & Barsky 1984): OpenCV's drawing walks along what
// is outside, for seconds when an end is far away, and its fixed-point numbers overflow.
std::optional<Segment> near_part(const Pixel& a, const Pixel& b, const cv::Mat& picture) {
  const double direction[] = {b.u - a.u, b.v - a.v};
  const double start[] = {a.u, a.v};
  const double size[] = {double(picture.cols), double(picture.rows)};
  constexpr double kMargin = 16;
  double first = 0;
  double last = 1;
  for (int i = 0; i < 2; ++i) {
    const double low = (-kMargin - start[i]) / direction[i];
    const double high = (size[i] + kMargin - start[i]) / direction[i];
    const bool is_inside = start[i] >= -kMargin && start[i] <= size[i] + kMargin;
    if (direction[i] == 0 && is_inside) continue;
    if (!std::isfinite(low) || !std::isfinite(high)) return std::nullopt;
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  if (!(first <= last)) return std::nullopt;
  const auto at = [&](double t) { return Pixel{a.u + t * direction[0], a.v + t * direction[1]}; };
  const Segment part{at(first), at(last)};
  if (!is_near(part.from, picture) || !is_near(part.to, picture)) return std::nullopt;
  return part;
}

void draw_line(cv::Mat& picture, const Pixel& from, const Pixel& to, const cv::Scalar& colour,
               int thickness) {
  if (const auto part = near_part(from, to, picture))
    cv::line(picture, fixed_point(part->from), fixed_point(part->to), colour, thickness,
             cv::LINE_AA, kShift);
}

void draw_circle(cv::Mat& picture, const Pixel& centre, int radius, const cv::Scalar& colour,
                 int thickness) {
  if (is_near(centre, picture))
    cv::circle(picture, fixed_point(centre), radius << kShift, colour, thickness, cv::LINE_AA,
               kShift);
}

// A number that looks random but is always the same for one template keypoint (FNV-1a of its
// place), so that its colour and whether it is drawn do not flicker.
std::uint64_t identity(const Pixel& in_template) {
  unsigned char bytes[2 * sizeof(double)];
  std::memcpy(bytes, &in_template.u, sizeof(double));
  std::memcpy(bytes + sizeof(double), &in_template.v, sizeof(double));
  std::uint64_t hash = 14695981039346656037ull;
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
  return hash ^ hash >> 29;
}

// Bright and far from grey; twelve hues, two brightnesses.
cv::Scalar colour_of(const Pixel& in_template) {
  const std::uint64_t id = identity(in_template);
  const double hue = double(id % 12) / 2;  // in sixths of the circle
  const double value = id / 12 % 2 == 0 ? 255 : 205;
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hue, 6.);
    return value * (1 - 0.9 * std::clamp(std::min(k, 4 - k), 0., 1.));
  };
  return {channel(1), channel(3), channel(5)};
}

std::vector<PixelPair> chosen(std::vector<PixelPair> pairs, int max_lines) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const PixelPair& a, const PixelPair& b) {
    return identity(a.in_template) < identity(b.in_template);
  });
  pairs.resize(std::min(pairs.size(), std::size_t(std::max(max_lines, 0))));
  return pairs;
}

cv::Mat canvas(const Frame& frame, int status_height) {
  const bool is_grey = !frame.gray.empty() && frame.gray.type() == CV_8UC1;
  const cv::Size size = frame.gray.empty() ? cv::Size(320, 240) : frame.gray.size();
  cv::Mat picture(size.height + status_height, size.width, CV_8UC3, cv::Scalar(96, 96, 96));
  if (is_grey) cv::cvtColor(frame.gray, picture.rowRange(0, size.height), cv::COLOR_GRAY2BGR);
  return picture;
}

// How much smaller the template is drawn: 1 unless it is more than half as wide or high as the
// frame.
double corner_scale(const cv::Mat& model, const cv::Size& size) {
  return std::min({1., 0.5 * size.width / model.cols, 0.5 * size.height / model.rows});
}

void draw_template(cv::Mat& picture, const cv::Mat& model, double scale) {
  cv::Mat small = model;
  if (scale < 1)
    cv::resize(model, small,
               cv::Size(std::max(1, int(scale * model.cols)), std::max(1, int(scale * model.rows))),
               0, 0, cv::INTER_AREA);
  cv::rectangle(picture, cv::Point(-1, -1), cv::Point(small.cols, small.rows), kWhite, 1);
  const cv::Rect place(0, 0, std::min(small.cols, picture.cols),
                       std::min(small.rows, picture.rows));
  cv::cvtColor(small(place), picture(place), cv::COLOR_GRAY2BGR);
}

void draw_matches(cv::Mat& picture, const std::vector<PixelPair>& pairs, double scale) {
  for (const PixelPair& pair : pairs) {
    // Pixel centres are whole numbers: the template's edge at -0.5 stays where it is.
    const Pixel from{scale * (pair.in_template.u + 0.5) - 0.5,
                     scale * (pair.in_template.v + 0.5) - 0.5};
    const cv::Scalar colour = colour_of(pair.in_template);
    draw_line(picture, from, pair.in_image, colour, 1);
    draw_circle(picture, from, 2, colour, cv::FILLED);
    draw_circle(picture, pair.in_image, 2, colour, cv::FILLED);
  }
}

// Black, with a light edge on both sides: it is seen on dark images too.
void draw_window(cv::Mat& picture, const PixelBox& window) {
  constexpr double kFurthest = 30000;  // OpenCV's fixed-point numbers
  for (const double number : {window.u, window.v, window.width, window.height})
    if (!(std::abs(number) < kFurthest)) return;
  if (!(window.width >= 1) || !(window.height >= 1)) return;
  const cv::Rect box(int(std::lround(window.u)), int(std::lround(window.v)),
                     int(std::lround(window.width)), int(std::lround(window.height)));
  const auto grown = [&](int by) {
    return cv::Rect(box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by);
  };
  const cv::Scalar light(190, 190, 190);
  cv::rectangle(picture, grown(1), light, 1);
  if (box.width > 4 && box.height > 4) {
    cv::rectangle(picture, grown(-2), light, 1);
    cv::rectangle(picture, grown(-1), kBlack, 1);
  }
  cv::rectangle(picture, box, kBlack, 1);
}

void draw_outline(cv::Mat& picture, const std::array<Pixel, 4>& corners, const cv::Scalar& colour,
                  int thickness) {
  for (std::size_t i = 0; i < 4; ++i)
    draw_line(picture, corners[i], corners[(i + 1) % 4], colour, thickness);
}

void draw_corners(cv::Mat& picture, const std::array<Pixel, 4>& corners, const cv::Scalar& colour) {
  for (const Pixel& corner : corners) {
    draw_line(picture, {corner.u - 6, corner.v}, {corner.u + 6, corner.v}, colour, 1);
    draw_line(picture, {corner.u, corner.v - 6}, {corner.u, corner.v + 6}, colour, 1);
    draw_circle(picture, corner, 4, colour, 1);
  }
}

}  // namespace

cv::Mat overlay(const Frame& frame, const cv::Mat& template_picture, const Track& track,
                const OverlayOptions& options) {
  const int width = frame.gray.empty() ? 320 : frame.gray.cols;
  const StatusText status =
      fitted(status_line(frame, track, options.sent), longest_status(options.sent), width);
  cv::Mat whole = canvas(frame, status.height());
  cv::Mat picture = whole.rowRange(0, whole.rows - status.height());
  draw_window(picture, track.window);
  const bool has_model = !template_picture.empty() && template_picture.type() == CV_8UC1;
  const double scale = has_model ? corner_scale(template_picture, picture.size()) : 1;
  if (has_model) draw_template(picture, template_picture, scale);
  if (track.found()) {
    draw_matches(picture, chosen(track.inliers, options.max_lines), scale);
    if (has_model) {
      const auto corners =
          outline(*track.image_from_template, template_picture.cols, template_picture.rows);
      draw_outline(picture, corners, kWhite, 2);
      if (options.goal_corners) draw_corners(picture, corners, kGreen);
    }
  }
  if (track.predicted && has_model) {
    draw_outline(picture, outline(*track.predicted, template_picture.cols, template_picture.rows),
                 kGrey, 1);
  }
  if (options.goal_corners) draw_corners(picture, *options.goal_corners, kRed);
  draw(status, whole.rowRange(picture.rows, whole.rows));
  return whole;
}

}  // namespace kestrel
