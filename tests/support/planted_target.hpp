#pragma once

#include <opencv2/core.hpp>

#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/track_options.hpp"
#include "kestrel/vision/tracker.hpp"

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel::test {

// A textured target of 160x128 px on a ground with a texture of its own, 400x300 px: at half its
// size it still holds the keypoints that a detection needs.
constexpr int kTargetWidth = 160;
constexpr int kTargetHeight = 128;
constexpr int kGroundWidth = 400;
constexpr int kGroundHeight = 300;
constexpr Pixel kTargetCentre{79.5, 63.5};
constexpr PixelBox kLearnedAt{120, 86, kTargetWidth, kTargetHeight};

inline const cv::Mat& target_picture() {
  static const cv::Mat picture = [] {
    Random random("planted target");
    return texture(kTargetWidth, kTargetHeight, random);
  }();
  return picture;
}

/// The ground without the target.
inline cv::Mat ground() {
  static const cv::Mat image = [] {
    Random random("ground of the planted target");
    return texture(kGroundWidth, kGroundHeight, random);
  }();
  return image.clone();
}

inline void plant(cv::Mat& image, const Homography& image_from_target) {
  const cv::Mat full(kTargetHeight, kTargetWidth, CV_8UC1, cv::Scalar(255));
  const cv::Mat seen = view(target_picture(), image_from_target, image.cols, image.rows);
  const cv::Mat mask = view(full, image_from_target, image.cols, image.rows) > 254;
  seen.copyTo(image, mask);
}

/// Noise of 2 grey levels, about 128.
inline const cv::Mat& noise_of_ground() {
  static const cv::Mat noise = [] {
    cv::Mat image(kGroundHeight, kGroundWidth, CV_8UC1, cv::Scalar(128));
    Random random("noise over the planted target");
    add_noise(image, 2, random);
    return image;
  }();
  return noise;
}

/// The target on its ground, with the same noise every time.
inline cv::Mat planted(const Homography& image_from_target) {
  cv::Mat image = ground();
  plant(image, image_from_target);
  cv::addWeighted(image, 1, noise_of_ground(), 1, -128, image);
  return image;
}

/// The target turned, scaled and tilted about its centre, which is at this place.
inline Homography placed_at(const Pixel& centre, const Motion& motion = {}) {
  return moved(motion, kTargetCentre, centre);
}

inline Homography learned_place() { return translation(kLearnedAt.u, kLearnedAt.v); }

inline Tracker tracker_of(const TrackOptions& options) {
  return {planted(learned_place()), kLearnedAt, options};
}

inline TrackOptions options_of(TrackMethod method) {
  TrackOptions options;
  options.method = method;
  return options;
}

/// One tracker for each of the two methods: what it saw before must not matter.
inline Tracker& shared_tracker(TrackMethod method) {
  static Tracker detect = tracker_of(options_of(TrackMethod::Detect));
  static Tracker hybrid = tracker_of(options_of(TrackMethod::Hybrid));
  return method == TrackMethod::Detect ? detect : hybrid;
}

inline Frame frame_of(const cv::Mat& gray, double stamp_s) {
  Frame frame;
  frame.stamp_s = stamp_s;
  frame.gray = gray;
  return frame;
}

inline double error_px(const Homography& seen, const Homography& truth) {
  return corner_distance(seen, truth, kTargetWidth, kTargetHeight);
}

/// The same answer, bit for bit, as far as the next frame or a user can tell.
inline bool same(const Track& a, const Track& b) {
  const auto equal = [](const std::optional<Homography>& x, const std::optional<Homography>& y) {
    return x.has_value() == y.has_value() && (!x || x->H == y->H);
  };
  return equal(a.image_from_template, b.image_from_template) && equal(a.predicted, b.predicted) &&
         equal(a.next.last_seen, b.next.last_seen) && a.status == b.status && a.stage == b.stage &&
         a.miss == b.miss && a.age_s == b.age_s && a.confidence == b.confidence &&
         a.corner_covariance == b.corner_covariance && a.keypoints == b.keypoints &&
         a.matches == b.matches && a.inliers.size() == b.inliers.size() &&
         a.next.window.u == b.next.window.u && a.next.window.width == b.next.window.width &&
         a.next.sweep == b.next.sweep && a.next.weak_frames == b.next.weak_frames;
}

}  // namespace kestrel::test
