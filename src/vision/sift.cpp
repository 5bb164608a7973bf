#include "kestrel/vision/sift.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "sift/describe.hpp"
#include "sift/exact_math.hpp"
#include "sift/refine.hpp"
#include "sift/strongest.hpp"

namespace kestrel {
namespace {

/// Blur a camera's picture has of itself, px (Lowe 2004, section 3.3).
constexpr double kCameraBlurPx = 0.5;

/// Smallest side of an octave that can hold an extremum.
constexpr int kMinSidePx = 2 * sift::kBorderPx + 1;

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

/// Blur of a level in px of its octave.
double sigma_at(const FastSiftOptions& options, double layer) {
  return options.sigma * sift::power_of_two(layer / options.octave_layers);
}

sift::Ladder ladder_of(const FastSiftOptions& options) {
  sift::Ladder ladder;
  ladder.layers = options.octave_layers;
  ladder.wanted = {options.contrast_threshold * 255 / options.octave_layers,
                   options.edge_threshold};
  const double before = options.is_doubled ? 2 * kCameraBlurPx : kCameraBlurPx;
  ladder.blurs.push_back(sift::gaussian_taps(before, options.sigma));
  for (int i = 1; i < options.octave_layers + 3; ++i)
    ladder.blurs.push_back(sift::gaussian_taps(sigma_at(options, i - 1), sigma_at(options, i)));
  ladder.kernels = &kernels::table(options.simd);
  return ladder;
}

/// An extremum, then one of its keypoints.
struct Found {
  int octave = 0;
  sift::Spot spot;
  float contrast = 0;
  float angle_rad = 0;
  Descriptor descriptor;
};

}  // namespace

void FastSiftOptions::check() const {
  require(octave_layers >= 1 && octave_layers <= 5, "sift.octave_layers: must be 1 to 5");
  require(contrast_threshold >= 0 && contrast_threshold < 1,
          "sift.contrast_threshold: must be at least 0 and below 1");
  require(edge_threshold >= 1 && std::isfinite(edge_threshold),
          "sift.edge_threshold: must be at least 1");
  require(sigma >= 0.8 && sigma <= 3, "sift.sigma: must be 0.8 to 3 px");
  require(max_keypoints >= 1 && max_keypoints <= kMaxSiftPoints,
          "sift.max_keypoints: must be 1 to 8000");
}

struct FastSift::Work {
  explicit Work(const FastSiftOptions& wanted) : options(wanted), ladder(ladder_of(wanted)) {}

  void build(const sift::Picture& picture);
  void place();
  void describe();
  void report(const cv::Point& origin);

  kernels::DescriptorGrid grid = sift::descriptor_grid();
  FastSiftOptions options;
  sift::Ladder ladder;
  std::vector<sift::Octave> octaves;
  int octaves_used = 0;
  std::vector<Found> places;
  std::vector<Found> found;
  sift::Strongest strongest;
  SiftPoints points;
};

void FastSift::Work::build(const sift::Picture& picture) {
  int side = std::min(picture.width(), picture.height());
  for (octaves_used = 0; side >= kMinSidePx; ++octaves_used, side = (side + 1) / 2) {
    const std::size_t i = std::size_t(octaves_used);
    if (i == octaves.size()) octaves.emplace_back();
    if (i == 0) {
      octaves[i].build(picture, ladder);
    } else {
      octaves[i].build(octaves[i - 1], ladder);
    }
  }
}

void FastSift::Work::place() {
  places.clear();
  for (int o = 0; o < octaves_used; ++o) {
    for (const sift::Extremum& e : octaves[std::size_t(o)].extrema()) {
      const double sigma = sigma_at(options, e.at.layer + double(e.dlayer));
      Found place;
      place.octave = o;
      place.spot = {e.at.layer, float(e.at.u) + e.du, float(e.at.v) + e.dv, float(sigma)};
      place.contrast = e.contrast;
      places.push_back(place);
    }
  }
  strongest.keep(places, options.max_keypoints);
}

/// Orientation and description follow each other while the neighbourhood is in the cache.
void FastSift::Work::describe() {
  found.clear();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Found& place = places[i];
    const sift::Octave& octave = octaves[std::size_t(place.octave)];
    if (i + 1 < places.size())
      sift::prefetch(octaves[std::size_t(places[i + 1].octave)], places[i + 1].spot);
    const sift::Peaks peaks = sift::orientations(octave, place.spot, *ladder.kernels);
    for (int k = 0; k < peaks.count; ++k) {
      const float angle = peaks.angle[std::size_t(k)];
      found.push_back({place.octave, place.spot, place.contrast, angle,
                       sift::described(octave, place.spot, angle, grid, *ladder.kernels)});
    }
  }
  strongest.keep(found, options.max_keypoints);
}

void FastSift::Work::report(const cv::Point& origin) {
  points.at.clear();
  points.descriptors.clear();
  for (const Found& f : found) {
    const float pixel = std::ldexp(options.is_doubled ? 0.5F : 1.F, f.octave);
    points.at.push_back({float(origin.x) + f.spot.u * pixel, float(origin.y) + f.spot.v * pixel,
                         f.spot.sigma * pixel, f.angle_rad, f.contrast / 255});
    points.descriptors.push_back(f.descriptor);
  }
}

FastSift::FastSift(const FastSiftOptions& options) {
  options.check();
  work_ = std::make_unique<Work>(options);
}

FastSift::~FastSift() = default;
FastSift::FastSift(FastSift&&) noexcept = default;
FastSift& FastSift::operator=(FastSift&&) noexcept = default;

const SiftPoints& FastSift::detect(const cv::Mat& gray, const PixelBox& window) {
  require(gray.empty() || gray.type() == CV_8UC1, "image: must be 8-bit grey");
  const PixelBox box = clipped(window, gray.cols, gray.rows);
  const cv::Rect crop(int(box.u), int(box.v), int(box.width), int(box.height));
  work_->build({crop.empty() ? cv::Mat() : gray(crop), work_->options.is_doubled});
  work_->place();
  work_->describe();
  work_->report(crop.tl());
  return work_->points;
}

}  // namespace kestrel
