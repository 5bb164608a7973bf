// stress_table: every method on every class of rendered sequences, a line each.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>

#include "bench/guarded.hpp"
#include "bench/methods.hpp"
#include "bench/stress.hpp"
#include "bench/stress_score.hpp"
#include "bench/stress_texture.hpp"

namespace kestrel::test {
namespace {

struct Arguments {
  std::string set = "dev";
  std::int64_t frames = 150;
  std::uint64_t seed = 1;
  std::vector<std::string> classes;
  std::vector<std::string> textures;
  std::vector<std::string> methods;
  std::string csv;
};

Arguments arguments(int argc, char** argv) {
  Arguments a;
  CLI::App app("Trackers on rendered sequences with exact truth");
  app.add_option("--set", a.set, "dev or held-out")->check(CLI::IsMember({"dev", "held-out"}));
  app.add_option("--frames", a.frames, "of each sequence")->check(CLI::PositiveNumber);
  app.add_option("--seed", a.seed, "of the motions");
  app.add_option("--class", a.classes, "only these");
  app.add_option("--texture", a.textures, "only these, of either set");
  app.add_option("--method", a.methods, "only these");
  app.add_option("--csv", a.csv, "a line for each method, class and texture");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));  // NOLINT(concurrency-mt-unsafe)
  }
  if (a.classes.empty()) a.classes = stress_classes();
  if (a.textures.empty()) {
    a.textures = texture_names(a.set == "dev" ? StressSet::Dev : StressSet::HeldOut);
  }
  return a;
}

constexpr const char* kHead =
    "method,class,texture,labelled,absent,ok3_percent,ok5_percent,wrong_percent,median_px,p95_px,"
    "median_ms,p95_ms,max_ms";

std::string number(const std::optional<double>& value, const char* format) {
  if (!value) return "";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, *value);
  return text.data();
}

/// The columns after method, class and texture.
std::vector<std::string> columns(const ScoreLine& line) {
  return {std::to_string(line.labelled),    std::to_string(line.absent),
          number(100 * line.ok3, "%.1f"),   number(100 * line.ok5, "%.1f"),
          number(100 * line.wrong, "%.2f"), number(line.median_px, "%.3f"),
          number(line.p95_px, "%.3f"),      number(line.median_ms, "%.3f"),
          number(line.p95_ms, "%.3f"),      number(line.max_ms, "%.3f")};
}

void write_csv(std::ostream& out, const std::string& start, const ScoreLine& line) {
  out << start;
  for (const std::string& column : columns(line)) out << "," << column;
  out << "\n" << std::flush;
}

void print(const std::string& method, const std::string& cls, const ScoreLine& line) {
  std::printf("%-22s %-14s", method.c_str(), cls.c_str());
  for (const std::string& column : columns(line)) std::printf(" %8s", column.c_str());
  std::printf("\n");
  std::fflush(stdout);
}

using Scores = std::map<std::string, std::vector<ScoredFrame>>;  // by method

void append(std::vector<ScoredFrame>& all, const std::vector<ScoredFrame>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// One class on all textures.
Scores scores_of(const std::string& cls, const Arguments& a,
                 const std::vector<BenchMethod>& methods, std::ostream& csv) {
  Scores scores;
  for (const std::string& texture : a.textures) {
    const StressSequence sequence = stress_sequence({cls, texture, a.frames, a.seed});
    const std::vector<cv::Mat> frames = rendered_frames(sequence);
    for (const BenchMethod& method : methods) {
      const std::vector<ScoredFrame> frames_scored = scored(method, sequence, frames);
      std::string start = method.name;
      start.append(",").append(cls).append(",").append(texture);
      write_csv(csv, start, score_line(frames_scored));
      append(scores[method.name], frames_scored);
    }
  }
  return scores;
}

int run(int argc, char** argv) {
  cv::setNumThreads(1);
  const Arguments a = arguments(argc, argv);
  const std::vector<BenchMethod> methods = bench_methods(a.methods);
  std::ofstream csv;
  if (!a.csv.empty()) csv.open(a.csv);
  csv << kHead << "\n";
  std::printf("%-22s %-14s %8s %8s %8s %8s %8s %8s %8s %8s %8s %8s\n", "method", "class", "labels",
              "absent", "ok3 %", "ok5 %", "wrong %", "med px", "p95 px", "med ms", "p95 ms",
              "max ms");
  Scores all;
  for (const std::string& cls : a.classes) {
    const Scores scores = scores_of(cls, a, methods, csv);
    for (const BenchMethod& method : methods) {
      const ScoreLine line = score_line(scores.at(method.name));
      print(method.name, cls, line);
      write_csv(csv, method.name + "," + cls + ",all", line);
      append(all[method.name], scores.at(method.name));
    }
  }
  for (const BenchMethod& method : methods) {
    const ScoreLine line = score_line(all.at(method.name));
    print(method.name, "all", line);
    write_csv(csv, method.name + ",all,all", line);
  }
  return 0;
}

}  // namespace
}  // namespace kestrel::test

int main(int argc, char** argv) { return kestrel::test::guarded(kestrel::test::run, argc, argv); }
