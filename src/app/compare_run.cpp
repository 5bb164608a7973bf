#include "compare_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "kestrel/eval/table.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/report.hpp"
#include "kestrel/io/svg_plot.hpp"
#include "kestrel/lab/law_replay.hpp"

#include "recorded_run.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

std::vector<Law> laws_of(const CompareArguments& a) {
  if (a.laws.empty()) return all_laws();
  std::vector<Law> laws;
  for (const std::string& name : a.laws) laws.push_back(*law_named(name));
  return laws;
}

/// A row for each law and frame.
void write_replays(const fs::path& file, const std::vector<LawReplay>& replays) {
  LineFile out(file);
  out.write(
      "law,frame,time_s,wanted_forward_m_s,wanted_right_m_s,wanted_down_m_s,wanted_yaw_rate_rad_s,"
      "sent_forward_m_s,sent_right_m_s,sent_down_m_s,sent_yaw_rate_rad_s,refusal,condition");
  for (const LawReplay& replay : replays) {
    for (const ReplayedFrame& f : replay.frames) {
      std::string line = fmt::format("{},{},{}", name(replay.law), f.frame, number(f.stamp_s));
      for (int i = 0; i < 4; ++i) {
        line += ',' + (f.wanted ? number(f.wanted->vector()[i]) : std::string());
      }
      for (int i = 0; i < 4; ++i) line += ',' + number(f.sent.vector()[i]);
      line += fmt::format(",{},{}", name(f.refusal), f.wanted ? number(f.condition) : "");
      out.write(line);
    }
  }
}

SummaryValue value_of(const std::optional<double>& value) { return value.value_or(std::nan("")); }

Table table_of(const std::vector<LawReplay>& replays, const LogFile& log) {
  Table table{{{"law", 0},
               {"answered_frames", 0},
               {"median_difference_m_s", 3},
               {"largest_difference_m_s", 3},
               {"median_difference_rad_s", 4},
               {"largest_difference_rad_s", 4}},
              {}};
  for (const LawReplay& replay : replays) {
    const ReplayDifference d = difference(replay, log);
    table.rows.push_back({std::string(name(replay.law)), std::int64_t(d.answered),
                          value_of(d.median_m_s), value_of(d.largest_m_s), value_of(d.median_rad_s),
                          value_of(d.largest_rad_s)});
  }
  return table;
}

/// The fastest translation a law wanted, m/s.
double largest_speed_m_s(const LawReplay& replay) {
  double largest = 0;
  for (const ReplayedFrame& f : replay.frames) {
    if (f.wanted) largest = std::max(largest, f.wanted->vector().head<3>().norm());
  }
  return largest;
}

double largest_speed_m_s(const LogFile& log) {
  double largest = 0;
  for (const LogRow& row : log.rows) {
    if (!row.servo || !row.decision) continue;
    largest = std::max(largest, row.decision->wanted.vector().head<3>().norm());
  }
  return largest;
}

/// What may be seen beside what was flown: a law several times as fast would flatten all others.
struct Drawn {
  std::vector<LawReplay> replays;
  std::string left_out;  // names
};

Drawn drawn(const std::vector<LawReplay>& replays, const LogFile& log) {
  constexpr double kFaster = 3;
  Drawn result;
  for (const LawReplay& replay : replays) {
    if (largest_speed_m_s(replay) <= kFaster * largest_speed_m_s(log)) {
      result.replays.push_back(replay);
    } else {
      result.left_out += (result.left_out.empty() ? "" : ", ") + std::string(name(replay.law));
    }
  }
  return result;
}

/// One velocity, all laws and what was flown.
std::string figure(const std::vector<LawReplay>& replays, const LogFile& log, int axis,
                   const char* label) {
  Plot plot;
  plot.title = fmt::format("wanted: {}", label);
  plot.x_label = "time (s)";
  plot.y_label = label;
  plot.names = Plot::Names::LineEnds;
  plot.height_px = std::max(300., 80 + 13. * double(replays.size()));  // a line for each name
  Series flown{"flown", {}, {}};
  for (const LogRow& row : log.rows) {
    flown.x.push_back(row.stamp_s);
    const bool servoed = row.servo && row.decision;
    flown.y.push_back(servoed ? row.decision->wanted.vector()[axis] : std::nan(""));
  }
  flown.stroke = Stroke::Dashed;
  for (const LawReplay& replay : replays) {
    Series line{name(replay.law), {}, {}};
    for (const ReplayedFrame& f : replay.frames) {
      line.x.push_back(f.stamp_s);
      line.y.push_back(f.wanted ? f.wanted->vector()[axis] : std::nan(""));
    }
    plot.series.push_back(std::move(line));
  }
  plot.series.push_back(std::move(flown));
  return svg_plot(plot);
}

Report page(const std::vector<LawReplay>& replays, const LogFile& log, const Table& table,
            const fs::path& run) {
  Report report;
  report.title = "A recorded run through other laws";
  report.what = fmt::format(
      "What each law would have commanded at each frame of {}, given what was measured there; the "
      "run itself stays as it was flown with its own law (dashed). Before the limits.",
      run.filename().string());
  ReportSection section;
  section.title = "Commands";
  constexpr std::array<const char*, 4> kLabels{"forward (m/s)", "right (m/s)", "down (m/s)",
                                               "yaw rate (rad/s)"};
  const Drawn shown_laws = drawn(replays, log);
  for (int axis = 0; axis < 4; ++axis) {
    section.figures.push_back(figure(shown_laws.replays, log, axis, kLabels[std::size_t(axis)]));
  }
  if (!shown_laws.left_out.empty()) {
    section.text =
        "Not drawn, since they wanted more than three times the speed of what was flown: " +
        shown_laws.left_out + '.';
  }
  ReportTable shown = readable(table);
  shown.caption = "Difference from the law that flew, over the frames in which both answered";
  section.tables.push_back(std::move(shown));
  report.sections.push_back(std::move(section));
  return report;
}

}  // namespace

int compare_run(const CompareArguments& a) {
  const RecordedRun run = load_run(a.plan, a.task);
  std::vector<LawReplay> replays;
  for (const Law law : laws_of(a)) {
    replays.push_back(replayed(run.log, run.experiment.task, law));
  }
  const fs::path folder = a.output.empty() ? a.plan / "laws" : a.output;
  fs::create_directories(folder);
  write_replays(folder / "replay.csv", replays);
  const Table table = table_of(replays, run.log);
  write_text(folder / "replay.json", json(table, 2) + "\n");
  write_text(folder / "index.html", report_html(page(replays, run.log, table, a.plan)));
  fmt::print("{}", a.printed == Printed::Json ? json(table, 2) + "\n" : aligned(readable(table)));
  fmt::print(stderr, "comparison: {}\n", folder.string());
  return 0;
}

}  // namespace kestrel::app
