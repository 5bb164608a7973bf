// absence_table: how often each method finds a template in frames that do not show it.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>

#include "bench/absence.hpp"
#include "bench/guarded.hpp"
#include "bench/methods.hpp"
#include "bench/stress.hpp"
#include "bench/stress_texture.hpp"

namespace kestrel::test {
namespace {

struct Arguments {
  std::int64_t frames = 4000;
  std::uint64_t seed = 1;
  std::string cls = "nominal";
  std::vector<std::string> textures;
  std::vector<std::string> methods;
  enum class Before { Nothing, Target } before = Before::Nothing;
};

Arguments arguments(int argc, char** argv) {
  Arguments a;
  CLI::App app("Templates searched for in frames that do not show them");
  app.add_option("--frames", a.frames, "for each template")->check(CLI::PositiveNumber);
  app.add_option("--seed", a.seed, "of the frames");
  app.add_option("--class", a.cls,
                 "whose first frame is learned: it says how large the template is");
  app.add_option("--texture", a.textures, "templates; all of the dev set unless named");
  app.add_option("--method", a.methods, "only these");
  app.add_flag_callback(
      "--after-target", [&] { a.before = Arguments::Before::Target; },
      "each frame comes right after one that shows the template where it was learned");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));  // NOLINT(concurrency-mt-unsafe)
  }
  if (a.textures.empty()) a.textures = texture_names(StressSet::Dev);
  return a;
}

/// The template as the rendered sequences show it; then only frames without it.
void print_accepts(const std::string& texture, const Arguments& a) {
  const StressSequence sequence = stress_sequence({a.cls, texture, 1, 1});
  const Frame first = sequence.sequence.open()->next().value();
  const std::vector<BenchMethod> methods = bench_methods(a.methods);
  std::vector<BenchTracker> trackers;
  trackers.reserve(methods.size());
  for (const BenchMethod& method : methods) {
    trackers.push_back(method.learn(first.gray, sequence.sequence.template_px));
  }
  std::vector<int> accepts(methods.size());
  const auto source = absence_frames({texture, a.frames, a.seed});
  for (const std::string& what : source->skipped()) std::cerr << what << "\n";
  while (const auto frame = source->next()) {
    Frame absent = *frame;
    Frame target = first;
    if (a.before == Arguments::Before::Target) {
      target.stamp_s = 2 * frame->stamp_s;  // as far before the frame as the frames are apart
      absent.stamp_s = 2 * frame->stamp_s + 1.0 / 30;
    }
    for (std::size_t i = 0; i < trackers.size(); ++i) {
      if (a.before == Arguments::Before::Target) trackers[i](target);
      accepts[i] += trackers[i](absent).image_from_template ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < methods.size(); ++i) {
    std::printf("%-22s %-12s found %6d of %lld\n", methods[i].name.c_str(), texture.c_str(),
                accepts[i], static_cast<long long>(a.frames));
  }
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  cv::setNumThreads(1);
  const Arguments a = arguments(argc, argv);
  for (const std::string& texture : a.textures) print_accepts(texture, a);
  return 0;
}

}  // namespace
}  // namespace kestrel::test

int main(int argc, char** argv) { return kestrel::test::guarded(kestrel::test::run, argc, argv); }
