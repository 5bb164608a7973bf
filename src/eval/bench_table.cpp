#include "kestrel/eval/bench_table.hpp"

#include <algorithm>
#include <sstream>

#include "bench_entry.hpp"

namespace kestrel {
namespace {

using RunEntry = Entry<BenchScore>;

/// A column of the metrics against labels, missing where there are none.
template <class Get>
RunEntry judged(const std::string& name, int digits, Get get) {
  return {{name, digits}, [get](const BenchScore& s) -> SummaryValue {
            if (!s.is_judged) return kNone;
            return SummaryValue(get(s.metrics));
          }};
}

RunEntry count(const std::string& name, int TrackMetrics::*number) {
  return judged(name, 0, [number](const TrackMetrics& m) { return std::int64_t(m.*number); });
}

RunEntry mean(const std::string& name, int digits, double BenchScore::*value) {
  return {{name, digits},
          [value](const BenchScore& s) -> SummaryValue { return s.frames > 0 ? s.*value : kNone; }};
}

double of_labelled(int some, const TrackMetrics& m) {
  return m.labelled > 0 ? 100.0 * some / m.labelled : kNone;
}

std::vector<RunEntry> names() {
  return {{{"sequence"}, [](const BenchScore& s) { return s.sequence; }},
          {{"method"}, [](const BenchScore& s) { return method_name(s.method).method; }},
          {{"settings"}, [](const BenchScore& s) { return method_name(s.method).settings; }}};
}

/// How a run went.
std::vector<RunEntry> run_entries() {
  using M = TrackMetrics;
  return {{{"end"}, [](const BenchScore& s) { return std::string(name(s.end)); }},
          {{"reason"}, [](const BenchScore& s) { return s.reason; }},
          {{"frames"}, [](const BenchScore& s) { return std::int64_t(s.frames); }},
          {{"skipped"}, [](const BenchScore& s) { return std::int64_t(s.skipped); }},
          {{"found"}, [](const BenchScore& s) { return std::int64_t(s.found); }},
          count("labelled", &M::labelled),
          judged("coverage_percent", 1, [](const M& m) { return 100 * m.coverage(); })};
}

/// The errors, and what was looked at.
std::vector<RunEntry> score_entries() {
  using M = TrackMetrics;
  return {
      judged("median_px", 3, [](const M& m) { return m.median_px.value_or(kNone); }),
      judged("p95_px", 3, [](const M& m) { return m.p95_px.value_or(kNone); }),
      judged("max_px", 3, [](const M& m) { return m.max_px.value_or(kNone); }),
      judged("wrong_10px_percent", 2, [](const M& m) { return of_labelled(m.wrong, m); }),
      judged("wrong_20px_percent", 2, [](const M& m) { return of_labelled(m.far_wrong, m); }),
      count("longest_gap_frames", &M::longest_gap),
      judged("recoveries", 0, [](const M& m) { return std::int64_t(m.recovery_frames.size()); }),
      judged("recovery_median_frames", 1,
             [](const M& m) {
               const auto spread = spread_of({m.recovery_frames.begin(), m.recovery_frames.end()});
               return spread ? spread->median : kNone;
             }),
      judged("recovery_max_frames", 0,
             [](const M& m) {
               const auto spread = spread_of({m.recovery_frames.begin(), m.recovery_frames.end()});
               return spread ? spread->max : kNone;
             }),
      judged("ends_lost", 0, [](const M& m) { return m.ends_lost; }),
      count("found_unlabelled", &M::found_unlabelled),
      mean("window_width_px", 1, &BenchScore::window_width_px),
      mean("window_height_px", 1, &BenchScore::window_height_px),
      mean("mean_keypoints", 1, &BenchScore::keypoints),
      mean("mean_matches", 1, &BenchScore::matches),
      mean("mean_inliers", 1, &BenchScore::inliers)};
}

/// The values of the settings by their keys.
std::vector<std::pair<std::string, std::string>> settings_of(const std::string& name) {
  std::istringstream words(method_name(name).settings);
  std::vector<std::pair<std::string, std::string>> settings;
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    if (equals != std::string::npos) {
      settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
  }
  return settings;
}

RunEntry setting_entry(const std::string& key) {
  RunEntry entry;
  entry.column.name = key;
  entry.value = [key](const BenchScore& score) -> SummaryValue {
    for (const auto& [name, value] : settings_of(score.method)) {
      if (name == key) return value;
    }
    return std::string();
  };
  return entry;
}

/// A column for each key that a method was set by.
std::vector<RunEntry> setting_entries(const std::vector<BenchScore>& scores) {
  std::vector<std::string> keys;
  for (const BenchScore& score : scores) {
    for (const auto& setting : settings_of(score.method)) {
      if (std::find(keys.begin(), keys.end(), setting.first) == keys.end()) {
        keys.push_back(setting.first);
      }
    }
  }
  std::vector<RunEntry> entries;
  entries.reserve(keys.size());
  for (const std::string& key : keys) entries.push_back(setting_entry(key));
  return entries;
}

}  // namespace

MethodName method_name(const std::string& name) {
  const auto space = name.find(' ');
  if (space == std::string::npos) return {name, ""};
  return {name.substr(0, space), name.substr(space + 1)};
}

Table run_table(const std::vector<BenchScore>& scores) {
  const auto shares = share_entries<BenchScore>(
      [](const BenchScore& s) { return s.is_judged ? &s.metrics : nullptr; });
  const auto start = joined(joined(names(), setting_entries(scores)), run_entries());
  return table_of(joined(start, joined(shares, score_entries())), scores);
}

Table time_table(const std::vector<BenchScore>& scores) {
  const std::vector<RunEntry> times = {
      {{"learn_ms", 2}, [](const BenchScore& s) { return s.learn_s / kMilli; }},
      time_entry<BenchScore>("mean", &Spread::mean),
      time_entry<BenchScore>("median", &Spread::median),
      time_entry<BenchScore>("p95", &Spread::p95),
      time_entry<BenchScore>("max", &Spread::max)};
  return table_of(joined(names(), times), scores);
}

}  // namespace kestrel
