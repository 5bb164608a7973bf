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
  answer.state = name(track.miss);
  return answer;
}

BenchTracker learn(const cv::Mat& gray, const PixelBox& box, const TrackOptions& options) {
  // A std::function must be copyable, a template is not: its copies share one, which none changes.
  const auto model = std::make_shared<const Template>(gray, box, options.sift, options.match);
  TrackState state = start_tracking(*model, gray.cols, gray.rows);
  return [model, state, options](const Frame& frame) mutable {
    const Track seen = track(*model, frame, state, options);
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
