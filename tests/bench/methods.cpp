#include "bench/methods.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "kestrel/vision/track.hpp"

#include "bench/peers.hpp"

namespace kestrel::test {

BenchMethod paper_method() {
  return {"paper", [](const cv::Mat& gray, const PixelBox& box) -> BenchTracker {
            const TrackOptions options;
            const auto model = std::make_shared<Template>(gray, box, options.sift, options.match);
            TrackState state = start_tracking(*model, gray.cols, gray.rows);
            return [model, options, state](const Frame& frame) mutable {
              Track seen = track(*model, frame, state, options);
              state = seen.next;
              return BenchAnswer{seen.image_from_template, seen.window,
                                 seen.keypoints,           seen.matches,
                                 int(seen.inliers.size()), name(seen.miss)};
            };
          }};
}

std::vector<BenchMethod> bench_methods() {
  std::vector<BenchMethod> methods{paper_method()};
  for (const auto& more : {opencv_peers(), visp_peers()}) {
    methods.insert(methods.end(), more.begin(), more.end());
  }
  return methods;
}

std::vector<BenchMethod> bench_methods(const std::vector<std::string>& names) {
  std::vector<BenchMethod> all = bench_methods();
  if (names.empty()) return all;
  std::vector<BenchMethod> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const BenchMethod& method) { return method.name == name; });
    if (found == all.end()) throw std::invalid_argument("method: there is none named " + name);
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace kestrel::test
