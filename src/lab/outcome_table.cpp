#include <map>
#include <utility>

#include "kestrel/lab/lab_report.hpp"

#include "table_rows.hpp"

namespace kestrel {
namespace {

/// Laws down, the keys of runs across.
ReportTable crossed(const std::string& caption,
                    const std::vector<std::pair<std::string, const LabRun*>>& runs) {
  std::vector<std::string> laws;
  std::vector<std::string> columns;
  for (const auto& [column, run] : runs) {
    place(laws, run->law);
    place(columns, column);
  }
  ReportTable table{caption, {"law"}, {}};
  table.head.insert(table.head.end(), columns.begin(), columns.end());
  table.rows.assign(laws.size(), std::vector<std::string>(columns.size() + 1));
  for (std::size_t i = 0; i < laws.size(); ++i) table.rows[i][0] = laws[i];
  for (const auto& [column, run] : runs) {
    table.rows[place(laws, run->law)][place(columns, column) + 1] = outcome(*run);
  }
  return table;
}

}  // namespace

/// The place of a name in a list that grows by new ones.
std::size_t place(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return std::size_t(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

std::vector<const MadeRun*> of_part(const std::vector<MadeRun>& runs, LabPart part) {
  std::vector<const MadeRun*> chosen;
  for (const MadeRun& made : runs) {
    if (made.part == part) chosen.push_back(&made);
  }
  return chosen;
}

std::vector<ReportTable> outcome_tables(const std::vector<MadeRun>& runs) {
  using Named = std::vector<std::pair<std::string, const LabRun*>>;
  std::map<RunKind, Named> plain;
  std::vector<std::string> scenarios;
  std::vector<Named> modified;
  for (const MadeRun* made : of_part(runs, LabPart::Table)) {
    const LabRun& run = made->run;
    if (run.modifier.empty()) {
      plain[run.kind].emplace_back(run.scenario, &run);
      continue;
    }
    const std::size_t at = place(scenarios, run.scenario);
    modified.resize(scenarios.size());
    modified[at].emplace_back(run.modifier, &run);
  }
  std::vector<ReportTable> tables;
  tables.reserve(plain.size() + scenarios.size());
  for (const auto& [kind, named] : plain) {
    tables.push_back(crossed(kind == RunKind::Camera
                                 ? "camera: step from which |e| stays small, or how it ended"
                                 : "helicopter: time it settles at, or how it ended",
                             named));
  }
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    tables.push_back(crossed(scenarios[i] + ", modified", modified[i]));
  }
  return tables;
}

}  // namespace kestrel
