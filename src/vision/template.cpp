#include "kestrel/vision/template.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kestrel/vision/blur.hpp"
#include "kestrel/vision/window.hpp"

namespace kestrel {
namespace {

constexpr int kMinSidePx = 16;

bool is_whole(double number) { return std::floor(number) == number; }

std::string text(const PixelBox& box) {
  const auto number = [](double x) {
    return is_whole(x) ? std::to_string(std::int64_t(x)) : std::to_string(x);
  };
  return number(box.u) + "," + number(box.v) + "," + number(box.width) + "," + number(box.height);
}

PixelBox checked(const cv::Mat& gray, const PixelBox& box) {
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("template: the image is not 8-bit grey; convert it first");
  }
  const std::string size = std::to_string(gray.cols) + "x" + std::to_string(gray.rows);
  const bool inside =
      box.u >= 0 && box.v >= 0 && box.u + box.width <= gray.cols && box.v + box.height <= gray.rows;
  if (!inside) {  // also when a number is not finite
    throw std::invalid_argument("template: rectangle " + text(box) + " is not inside the " + size +
                                " image; give x,y,width,height within it");
  }
  if (!(box.width >= kMinSidePx && box.height >= kMinSidePx)) {
    throw std::invalid_argument("template: rectangle " + text(box) +
                                " is too small; give at least 16x16 px");
  }
  if (!is_whole(box.u) || !is_whole(box.v) || !is_whole(box.width) || !is_whole(box.height)) {
    throw std::invalid_argument("template: rectangle " + text(box) +
                                " is not on whole pixels; round its numbers");
  }
  return box;
}

cv::Mat cut(const cv::Mat& gray, const PixelBox& box) {
  return gray(cv::Rect(int(box.u), int(box.v), int(box.width), int(box.height))).clone();
}

bool is_inside(const Pixel& p, const PixelBox& box) {
  return p.u >= box.u && p.v >= box.v && p.u <= box.u + box.width - 1 &&
         p.v <= box.v + box.height - 1;
}

/// Keypoints inside the box, in template coordinates, described as the first search window will
/// show them: a descriptor near the rectangle's edge reaches over it.
Keypoints learned(const cv::Mat& gray, const PixelBox& box, const SiftOptions& sift) {
  sift.check();
  const Keypoints seen = detect_keypoints(gray, first_window(box, gray.cols, gray.rows), sift);
  Keypoints kept;
  for (std::size_t i = 0; i < seen.at.size(); ++i) {
    if (!is_inside(seen.at[i], box)) continue;
    kept.at.push_back({seen.at[i].u - box.u, seen.at[i].v - box.v});
    kept.descriptors.push_back(seen.descriptors.row(int(i)));
  }
  return kept;
}

/// Keypoints at one place with several orientations count once: texture is places.
std::size_t places(const Keypoints& keypoints) {
  std::vector<std::pair<double, double>> at;
  for (const Pixel& p : keypoints.at) at.emplace_back(p.u, p.v);
  std::sort(at.begin(), at.end());
  return std::size_t(std::unique(at.begin(), at.end()) - at.begin());
}

Keypoints enough(Keypoints keypoints) {
  const std::size_t found = places(keypoints);
  if (found < std::size_t(Template::kMinKeypoints)) {
    throw std::invalid_argument("template: too little texture (" + std::to_string(found) +
                                " keypoints, " + std::to_string(Template::kMinKeypoints) +
                                " needed); choose a larger or more textured rectangle");
  }
  return keypoints;
}

/// Blocks enough that as many as the agreement asks for can be alike.
TemplateBlocks enough(TemplateBlocks blocks, int needed) {
  const int found = blocks.levels.empty() ? 0 : int(blocks.levels.front().blocks.size());
  if (found < needed) {
    throw std::invalid_argument("template: too little texture (" + std::to_string(found) +
                                " textured blocks of 8x8 px, " + std::to_string(needed) +
                                " needed); choose a larger or more textured rectangle");
  }
  return blocks;
}

}  // namespace

Template::Template(const cv::Mat& gray, const PixelBox& box, const TrackOptions& options)
    : box_(checked(gray, box)), picture_(cut(gray, box)) {
  options.check();
  if (options.method == TrackMethod::Paper) {
    keypoints_ = enough(learned(gray, box, options.sift));
    matcher_.emplace(keypoints_.descriptors, options.match);
    return;
  }
  blocks_ = enough(template_blocks(picture_, options.blocks), options.align.agreement.min_alike);
  if (options.method == TrackMethod::Hybrid) blurred_ = blurred_blocks(gray, box, blocks_);
  FastSiftOptions sift = options.detect.sift;
  sift.simd = options.simd;
  features_ = learn_features(gray, box, sift);
}

}  // namespace kestrel
