#include "kestrel/vision/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kestrel/vision/paper_track.hpp"
#include "kestrel/vision/target_search.hpp"
#include "kestrel/vision/window.hpp"

namespace kestrel {
namespace {

/// Standard deviations of the prediction that the window for keypoints holds.
constexpr double kGate = 3;

/// A sight farther off the prediction than this many standard deviations is another motion.
constexpr double kSurprise = 5;

/// A window of more than this share of the frame is left for the whole frame at once.
constexpr double kNearlyWhole = 0.6;

/// A deviation below this is not believed: the pixels' own is a hundredth, the plane's flatness and
/// the lens are worse.
constexpr double kLeastVariancePx2 = 0.01;

/// Time that passed; none between stamps that are out of order or not finite.
double elapsed_s(double from_s, double to_s) {
  const double elapsed = to_s - from_s;
  return elapsed > 0 && std::isfinite(elapsed) ? elapsed : 0;
}

PixelBox whole(const Frame& frame) {
  return {0, 0, double(frame.gray.cols), double(frame.gray.rows)};
}

double area(const PixelBox& box) { return box.width * box.height; }

/// The part of the frame whose turn it is: strips of so many pixels that overlap by a third.
PixelBox strip(const Frame& frame, double most_px, std::int64_t turn) {
  const double width = frame.gray.cols;
  const double height = frame.gray.rows;
  const double part = std::max(std::floor(most_px / width), 32.0);
  if (part >= height) return whole(frame);
  const auto count = std::int64_t(std::ceil((height - part) / (part * 2 / 3))) + 1;
  const double top = std::floor((height - part) * double(turn % count) / double(count - 1));
  return {0, top, width, part};
}

Homography placed(const PixelBox& box) {
  Homography H;
  H.H(0, 2) = box.u;
  H.H(1, 2) = box.v;
  return H;
}

Vector8d variances(const CornerCovariance& covariance) {
  return covariance.diagonal().cwiseMax(kLeastVariancePx2);
}

bool is_surprise(const CornerMotion& ahead, const std::array<Pixel, 4>& corners,
                 const Vector8d& noise) {
  const auto expected = ahead.corners();
  for (std::size_t i = 0; i < 4; ++i) {
    const auto k = Eigen::Index(2 * i);
    const double u = ahead.coordinates[2 * i].covariance(0, 0) + noise[k];
    const double v = ahead.coordinates[2 * i + 1].covariance(0, 0) + noise[k + 1];
    if (std::abs(corners[i].u - expected[i].u) > kSurprise * std::sqrt(u)) return true;
    if (std::abs(corners[i].v - expected[i].v) > kSurprise * std::sqrt(v)) return true;
  }
  return false;
}

}  // namespace

struct Tracker::Parts {
  TrackOptions options;
  Template model;
  std::optional<TargetSearch> search;

  Parts(const cv::Mat& gray, const PixelBox& box, const TrackOptions& wanted)
      : options(wanted), model(gray, box, wanted) {
    if (options.method != TrackMethod::Paper) search.emplace(model, options);
  }

  /// The motion at the frame's time, while it can be believed.
  std::optional<CornerMotion> motion_at(const Frame& frame, const TrackState& state) const {
    if (!state.motion) return std::nullopt;
    const double age_s = frame.stamp_s - state.motion->stamp_s;
    if (!(age_s >= 0 && age_s <= options.coast_s)) return std::nullopt;
    return predicted(*state.motion, frame.stamp_s, options.motion);
  }

  std::optional<Expectation> expectation(const std::optional<CornerMotion>& motion) const {
    if (!motion) return std::nullopt;
    const auto H = homography_from_outline(motion->corners(), model.width(), model.height());
    if (!H) return std::nullopt;
    return Expectation{*H, motion->deviation_px()};
  }

  PixelBox window(const Frame& frame, const TrackState& state,
                  const std::optional<CornerMotion>& motion) const {
    if (options.window == WindowPolicy::Doubling) return state.window;
    if (options.window == WindowPolicy::Fixed) {
      const PixelBox first = first_window(model.box(), frame.gray.cols, frame.gray.rows);
      const Pixel at = centre(state.window);
      return {at.u - (first.width - 1) / 2, at.v - (first.height - 1) / 2, first.width,
              first.height};
    }
    if (!motion) return state.last_seen ? whole(frame) : state.window;
    const PixelBox box = gate(*motion, kGate);
    const double by = std::max(box.width, box.height) / 4;  // what a keypoint reaches over
    const PixelBox wide{box.u - by, box.v - by, box.width + 2 * by, box.height + 2 * by};
    const PixelBox part = clipped(wide, frame.gray.cols, frame.gray.rows);
    return area(part) > kNearlyWhole * area(whole(frame)) ? whole(frame) : part;
  }

  /// Keypoints in the window, and where that fails, as far as the budget goes, in the whole frame.
  Sighting detect(const Frame& frame, const TrackState& state, Track& t) {
    const auto motion = motion_at(frame, state);
    const auto expected = expectation(motion);
    const double budget = options.detect.max_px_per_frame;
    const PixelBox first = window(frame, state, motion);
    const bool fits = area(first) <= budget;
    Sighting seen;
    if (fits) {
      seen = search->detect(frame, first, expected);
      if (seen.is_accepted() || options.window != WindowPolicy::Kalman ||
          area(first) >= area(whole(frame))) {
        return seen;
      }
    }
    const double left = fits ? budget - area(first) : budget;
    if (left < area(whole(frame)) && fits && left < budget / 2) return seen;
    t.next.sweep = state.sweep + 1;
    return search->detect(frame, strip(frame, left, state.sweep), expected);
  }

  Sighting look(const Frame& frame, const TrackState& state, Track& t) {
    Sighting seen;
    if (options.method == TrackMethod::Hybrid && state.last_seen) {
      const auto expected = expectation(motion_at(frame, state));
      seen = search->follow(frame, *state.last_seen, expected);
      const bool weak = seen.is_accepted() && search->is_weak(*seen.at);
      t.next.weak_frames = weak ? state.weak_frames + 1 : 0;
      if (seen.is_accepted() && t.next.weak_frames < options.weak_frames) return seen;
      t.next.weak_frames = 0;
    }
    Sighting detected = detect(frame, state, t);
    if (!detected.is_accepted()) {
      if (seen.is_accepted()) return seen;
      return detected;
    }
    if (seen.is_accepted() && seen.at->agreement.shown() >= detected.at->agreement.shown()) {
      return seen;
    }
    return detected;
  }

  void found(const Frame& frame, const TrackState& state, Track& t, const Sighting& seen) const {
    t.status = TrackStatus::Found;
    t.stage = seen.stage;
    t.image_from_template = seen.at->image_from_template;
    t.confidence = seen.at->agreement.shown();
    t.corner_covariance = seen.at->corner_covariance;
    const auto corners = outline(*t.image_from_template, model.width(), model.height());
    const Vector8d noise = variances(t.corner_covariance);
    const auto ahead = motion_at(frame, state);
    t.next.motion = ahead && !is_surprise(*ahead, corners, noise)
                        ? corrected(*ahead, corners, noise)
                        : first_motion(corners, noise, frame.stamp_s, options.motion);
    t.next.last_seen = t.image_from_template;
    t.next.last_confidence = t.confidence;
    t.next.window = window_around(corners, frame.gray.cols, frame.gray.rows);
    t.next.sweep = 0;
  }

  void missed(const Frame& frame, const TrackState& state, Track& t) const {
    if (has_image(frame) && options.window != WindowPolicy::Fixed) {
      t.next.window = doubled_window(t.window, frame.gray.cols, frame.gray.rows);
    }
    if (state.motion) t.age_s = elapsed_s(state.motion->stamp_s, frame.stamp_s);
    const auto motion = motion_at(frame, state);
    const auto expected = expectation(motion);
    if (!expected) return;
    t.status = TrackStatus::Coasting;
    t.predicted = expected->image_from_template;
    t.confidence = state.last_confidence * std::max(1 - t.age_s / options.coast_s, 0.0);
    for (std::size_t i = 0; i < 8; ++i) {
      t.corner_covariance(Eigen::Index(i), Eigen::Index(i)) =
          motion->coordinates[i].covariance(0, 0);
    }
  }

  Track track(const Frame& frame, const TrackState& state) {
    Track t;
    t.next = state;
    if (!has_image(frame)) {
      t.miss = Miss::NoImage;
      missed(frame, state, t);
      return t;
    }
    Sighting seen = look(frame, state, t);
    t.miss = seen.miss;
    t.window = seen.window;
    t.keypoints = seen.keypoints;
    t.matches = seen.matches;
    if (seen.at) t.agreement = seen.at->agreement;
    if (!seen.is_accepted()) {
      missed(frame, state, t);
      return t;
    }
    found(frame, state, t, seen);
    t.inliers = std::move(seen.inliers);
    return t;
  }
};

Tracker::Tracker(const cv::Mat& gray, const PixelBox& box, const TrackOptions& options)
    : parts_(std::make_unique<Parts>(gray, box, options)) {}

Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

const Template& Tracker::model() const { return parts_->model; }
const TrackOptions& Tracker::options() const { return parts_->options; }

TrackState Tracker::start(int image_width, int image_height) const {
  TrackState state;
  state.window = first_window(parts_->model.box(), image_width, image_height);
  state.last_seen = placed(parts_->model.box());
  return state;
}

Track Tracker::track(const Frame& frame, const TrackState& state) {
  const Parts& p = *parts_;
  if (p.options.method == TrackMethod::Paper) {
    return paper_track(p.model, frame, state, p.options);
  }
  return parts_->track(frame, state);
}

}  // namespace kestrel
