#include "kestrel/vision/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kestrel/geometry/straight_view.hpp"
#include "kestrel/vision/paper_track.hpp"
#include "kestrel/vision/straight_template.hpp"
#include "kestrel/vision/target_search.hpp"
#include "kestrel/vision/window.hpp"

#include "search/keypoint_window.hpp"
#include "search/places.hpp"
#include "search/seen_motion.hpp"

namespace kestrel {
namespace {

/// Time that passed; none between stamps that are out of order or not finite.
double elapsed_s(double from_s, double to_s) {
  const double elapsed = to_s - from_s;
  return elapsed > 0 && std::isfinite(elapsed) ? elapsed : 0;
}

Homography placed(const PixelBox& box) {
  Homography H;
  H.H(0, 2) = box.u;
  H.H(1, 2) = box.v;
  return H;
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

  /// Keypoints in the window, and where that fails, as far as the budget goes, in the whole frame.
  Sighting detect(const Frame& frame, const TrackState& state, Track& t) {
    const auto motion = motion_at(frame.stamp_s, state, options);
    const auto expected = expectation(motion, model);
    const double budget = options.detect.max_px_per_frame;
    const PixelBox first = keypoint_window(frame, state, motion, model.box(), options.window);
    const bool fits = area_px2(first) <= budget;
    Sighting seen;
    if (fits) {
      seen = search->detect(frame, first, expected);
      if (seen.is_accepted() || options.window != WindowPolicy::Kalman ||
          area_px2(first) >= area_px2(whole(frame))) {
        return seen;
      }
    }
    const double left = fits ? budget - area_px2(first) : budget;
    if (left < area_px2(whole(frame)) && fits && left < budget / 2) return seen;
    t.next.sweep = state.sweep + 1;
    return search->detect(frame, strip(frame, left, state.sweep), expected);
  }

  Sighting look(const Frame& frame, const TrackState& state, Track& t) {
    Sighting seen;
    if (options.method == TrackMethod::Hybrid && state.last_seen) {
      const auto expected = expectation(motion_at(frame.stamp_s, state, options), model);
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
    if (options.lens) t.straight_from_template = seen.at->straight_from_template;
    t.confidence = seen.at->agreement.shown();
    t.corner_covariance = seen.at->corner_covariance;
    const auto corners = outline(*t.image_from_template, model.width(), model.height());
    t.next.motion = seen_motion(motion_at(frame.stamp_s, state, options), corners,
                                t.corner_covariance, frame.stamp_s, options.motion);
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
    const auto motion = motion_at(frame.stamp_s, state, options);
    const auto expected = expectation(motion, model);
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
    t.others = std::move(seen.others);
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

Homography Tracker::learned_place() const {
  const Template& model = parts_->model;
  const auto& lens = parts_->options.lens;
  if (!lens) return placed(model.box());
  const Homography straight = straight_place(model.box(), *lens);
  return bent_view(straight, model.width(), model.height(), *lens).value_or(straight);
}

TrackState Tracker::start(int image_width, int image_height) const {
  TrackState state;
  state.window = first_window(parts_->model.box(), image_width, image_height);
  state.last_seen = learned_place();
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
