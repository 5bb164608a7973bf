#include "bench_sections.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "kestrel/eval/bench_pictures.hpp"
#include "kestrel/eval/bench_table.hpp"

#include "bench_figures.hpp"

namespace kestrel {
namespace {

/// Every score of every run, one sequence after the other.
std::vector<BenchScore> all_scores(const std::vector<SequencePart>& parts) {
  std::vector<BenchScore> scores;
  for (const SequencePart& part : parts) {
    scores.insert(scores.end(), part.scores.begin(), part.scores.end());
  }
  return scores;
}

ReportTable captioned(const std::string& caption, const Table& table) {
  ReportTable out = readable(table);
  out.caption = caption;
  return out;
}

/// True when the column says nothing in any row: no text, or none of what may be counted there.
bool is_silent(const Table& table, std::size_t column) {
  const std::string& name = table.columns[column].name;
  const bool is_rare = name == "refused" || name == "failed" || name == "found_unlabelled";
  return std::all_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
    return row[column] == SummaryValue(std::string()) ||
           (is_rare && row[column] == SummaryValue(std::int64_t(0)));
  });
}

/// The table without these columns, and without those that say nothing.
Table without(Table table, const std::vector<std::string>& columns) {
  for (std::size_t i = table.columns.size(); i-- > 0;) {
    const bool is_named =
        std::find(columns.begin(), columns.end(), table.columns[i].name) != columns.end();
    if (!is_named && !is_silent(table, i)) continue;
    const auto at = std::ptrdiff_t(i);
    table.columns.erase(table.columns.begin() + at);
    for (auto& row : table.rows) row.erase(row.begin() + at);
  }
  return table;
}

}  // namespace

ReportSection methods_section(const std::vector<MethodScore>& methods,
                              const std::vector<SequencePart>& parts) {
  ReportSection section;
  section.title = "Methods, best first";
  section.text =
      "Shares are means over the sequences, each sequence alike; a refused template counts as "
      "nothing found. Ordered by the area under the precision curve from 0 to 10 px.";
  if (methods.size() > kMostCurves) {
    section.text += fmt::format(" The plots show the first {}.", kMostCurves);
  }
  section.tables = {readable(without(method_time_table(methods), {}))};
  section.figures = {precision_plot(methods, parts), times_plot(methods, parts)};
  return section;
}

ReportSection runs_section(const std::vector<SequencePart>& parts) {
  const std::vector<std::string> elsewhere{
      "end",         "reason",          "settings",         "skipped",
      "found",       "window_width_px", "window_height_px", "mean_keypoints",
      "mean_matches"};
  const std::vector<BenchScore> scores = all_scores(parts);
  ReportSection section;
  section.title = "Runs, hardest sequence first";
  section.text =
      "Correct: within 5 px of the labels, or found where there are none. Wrong: found, but more "
      "than 10 px off. Both are shares of the labelled frames.";
  section.tables = {
      captioned("Table I of the paper, and the spread of the times", paper_table(scores)),
      captioned("Scores against the labels", without(run_table(scores), elsewhere))};
  return section;
}

ReportSection sequence_section(const SequencePart& part, const std::vector<MethodScore>& methods) {
  constexpr int kPictures = 3;
  ReportSection section;
  section.title = part.sequence->name;
  const std::size_t frames = part.runs.empty() ? 0 : part.runs.front().frames.size();
  section.text = fmt::format("{} frames, {} labelled.", frames, part.sequence->truth.size());
  if (!part.sequence->truth.empty()) section.figures.push_back(error_plot(part, methods));
  section.figures.push_back(time_plot(part, methods));
  const auto pictures = worst_pictures(*part.sequence, part.runs, kPictures);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    for (ReportPicture picture : pictures[i]) {
      picture.caption = part.runs[i].method + ", " + picture.caption;
      section.pictures.push_back(std::move(picture));
    }
  }
  if (!section.pictures.empty()) {
    section.text +=
        " Worst frames of each method below: reported outline white, true corners red, searched "
        "window black.";
  }
  return section;
}

}  // namespace kestrel
