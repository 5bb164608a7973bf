#include "kestrel/eval/track_method.hpp"

#include <memory>

namespace kestrel {
namespace {

BenchAnswer answer_of(const Track& track) {
  BenchAnswer answer;
  answer.image_from_template = track.image_from_template;
  answer.window = track.window;
  answer.keypoints = track.keypoints;
  answer.matches = track.matches;
  answer.inliers = int(track.inliers.size());
  answer.state = track.found() ? name(track.status) : name(track.miss);
  return answer;
}

BenchTracker learn(const cv::Mat& gray, const PixelBox& box, const TrackOptions& options) {
  // A std::function must be copyable, a tracker is not: its copies share one, whose answers do not
  // depend on what it was asked before.
  const auto tracker = std::make_shared<Tracker>(gray, box, options);
  TrackState state = tracker->start(gray.cols, gray.rows);
  return [tracker, state](const Frame& frame) mutable {
    const Track seen = tracker->track(frame, state);
    state = seen.next;
    return answer_of(seen);
  };
}

}  // namespace

BenchMethod track_method(const std::string& name, const TrackOptions& options) {
  options.check();
  return {name, [options](const cv::Mat& gray, const PixelBox& box) {
            return learn(gray, box, options);
          }};
}

}  // namespace kestrel
