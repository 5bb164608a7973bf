#include "bench/methods.hpp"

#include <algorithm>
#include <stdexcept>

#include "kestrel/eval/track_method.hpp"

#include "bench/peers.hpp"

namespace kestrel::test {

namespace {

/// One of Kestrel's own methods with its default options.
BenchMethod own(TrackMethod method) {
  TrackOptions options;
  options.method = method;
  return track_method(name(method), options);
}

}  // namespace

std::vector<BenchMethod> bench_methods() {
  std::vector<BenchMethod> methods{own(TrackMethod::Hybrid), own(TrackMethod::Detect),
                                   own(TrackMethod::Paper)};
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
