#include <fmt/format.h>

#include "kestrel/eval/bench_table.hpp"

#include "bench_entry.hpp"

namespace kestrel {
namespace {

using MethodEntry = Entry<MethodScore>;

MethodEntry count(const std::string& name, int MethodScore::*number) {
  return {{name, 0}, [number](const MethodScore& m) { return std::int64_t(m.*number); }};
}

std::vector<MethodEntry> method_entries() {
  using M = MethodScore;
  const std::vector<MethodEntry> sequences = {
      {{"method"}, [](const M& m) { return m.method; }},
      count("sequences", &M::sequences),
      count("refused", &M::refused),
      count("failed", &M::failed),
      count("labelled", &M::labelled),
      {{"coverage_percent", 1},
       [](const M& m) -> SummaryValue { return m.judged > 0 ? 100 * m.coverage : kNone; }}};
  const auto shares = share_entries<M>([](const M& m) { return m.judged > 0 ? &m : nullptr; });
  const std::vector<MethodEntry> errors = {
      {{"median_px", 3}, [](const M& m) { return m.median_px.value_or(kNone); }},
      count("wrong_10px", &M::wrong),
      count("wrong_20px", &M::far_wrong),
      count("found_unlabelled", &M::found_unlabelled)};
  return joined(joined(sequences, shares), errors);
}

/// "324x450", rounded.
std::string window(const BenchScore& s) {
  return s.frames == 0 ? std::string(name(s.end))
                       : fmt::format("{:.0f}x{:.0f}", s.window_width_px, s.window_height_px);
}

template <class Get>
Entry<BenchScore> of_frames(const std::string& name, int digits, Get get) {
  return {{name, digits}, [get](const BenchScore& s) -> SummaryValue {
            return s.frames > 0 ? double(get(s)) : kNone;
          }};
}

template <class Get>
Entry<BenchScore> of_judged(const std::string& name, int digits, Get get) {
  return {{name, digits}, [get](const BenchScore& s) -> SummaryValue {
            return s.is_judged ? double(get(s.metrics)) : kNone;
          }};
}

}  // namespace

Table method_table(const std::vector<MethodScore>& methods) {
  return table_of(method_entries(), methods);
}

Table method_time_table(const std::vector<MethodScore>& methods) {
  std::vector<MethodEntry> entries = method_entries();
  for (const auto& [name, value] :
       {std::pair("mean", &Spread::mean), std::pair("median", &Spread::median),
        std::pair("p95", &Spread::p95), std::pair("max", &Spread::max)})
    entries.push_back(time_entry<MethodScore>(name, value));
  return table_of(entries, methods);
}

Table paper_table(const std::vector<BenchScore>& scores) {
  using S = BenchScore;
  using M = TrackMetrics;
  return table_of<S>(
      {{{"sequence"}, [](const S& s) { return s.sequence; }},
       {{"method"}, [](const S& s) { return s.method; }},
       {{"window_px"}, [](const S& s) { return window(s); }},
       of_frames("SIFT", 1, [](const S& s) { return s.keypoints; }),
       of_frames("matched", 1, [](const S& s) { return s.matches; }),
       {{"correct_percent", 1},
        [](const S& s) -> SummaryValue {
          return s.end == BenchEnd::Failed ? kNone : 100 * s.correct();
        }},
       of_judged("wrong_percent", 1,
                 [](const M& m) { return m.labelled > 0 ? 100.0 * m.wrong / m.labelled : kNone; }),
       of_judged("median_px", 2, [](const M& m) { return m.median_px.value_or(kNone); }),
       time_entry<S>("mean", &Spread::mean),
       time_entry<S>("median", &Spread::median),
       time_entry<S>("p95", &Spread::p95),
       time_entry<S>("max", &Spread::max)},
      scores);
}

std::string summary_json(const std::vector<BenchScore>& scores,
                         const std::vector<MethodScore>& methods) {
  return fmt::format("{{\n\"methods\": {},\n\"runs\": {}\n}}\n", json(method_table(methods), 2),
                     json(run_table(scores), 2));
}

}  // namespace kestrel
