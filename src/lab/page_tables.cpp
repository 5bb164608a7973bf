#include "page_tables.hpp"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "kestrel/io/markup.hpp"

namespace kestrel {
namespace {

/// Style of an outcome: reached, did not arrive, or ended badly.
const char* style_of(RunEnd end) {
  switch (end) {
    case RunEnd::Converged:
      return "ok";
    case RunEnd::LocalMinimum:
    case RunEnd::TimedOut:
    case RunEnd::PositionOnly:
    case RunEnd::HeadingOnly:
      return "so";
    default:
      return "bad";
  }
}

/// The address of a scenario and modifier in the page; the script reads it.
std::string address(const std::string& scenario, const std::string& modifier) {
  const std::string path = modifier.empty() ? scenario : scenario + "/" + modifier;
  return "#" + relative_url(path).substr(2);
}

std::string cell(const LabRun* run) {
  if (!run) return "<td></td>";
  return fmt::format("<td class=\"{}\"><a href=\"{}\">{}</a></td>", style_of(run->end),
                     escaped(address(run->scenario, run->modifier)), escaped(outcome(*run)));
}

/// Where a run stands: law, scenario, modifier.
using Grid = std::map<std::pair<std::string, std::pair<std::string, std::string>>, const LabRun*>;

struct Column {
  std::string head;
  std::string scenario;
  std::string modifier;
};

std::string table(const std::string& caption, const std::vector<Column>& columns,
                  const LabNames& laws, const Grid& grid) {
  std::string out = "<div class=\"card wide\" tabindex=\"0\"><table class=\"ends\"><caption>" +
                    escaped(caption) + "</caption>\n<thead><tr><th scope=\"col\">law</th>";
  for (const Column& column : columns) out += "<th scope=\"col\">" + escaped(column.head) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const std::string& law : laws.all()) {
    std::string cells;
    bool is_there = false;
    for (const Column& column : columns) {
      const auto found = grid.find({law, {column.scenario, column.modifier}});
      cells += cell(found == grid.end() ? nullptr : found->second);
      is_there = is_there || found != grid.end();
    }
    if (is_there) out += "<tr><th scope=\"row\">" + escaped(law) + "</th>" + cells + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "–";
}

std::string entry(const char* term, const std::string& words) {
  return words.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, escaped(words));
}

}  // namespace

std::string outcome_tables(const LabReport& report) {
  Grid grid;
  std::map<std::string, LabNames> modifiers;  // of a scenario
  std::vector<Column> plain;
  LabNames seen;
  for (const LabRun& run : report.runs) {
    grid[{run.law, {run.scenario, run.modifier}}] = &run;
    modifiers[run.scenario].add(run.modifier);
    const bool is_new = run.modifier.empty() && seen.place(run.scenario) < 0;
    if (is_new) plain.push_back({run.scenario, run.scenario, ""});
    if (is_new) seen.add(run.scenario);
  }
  const LabNames laws = laws_of(report.runs);
  std::string out;
  if (!plain.empty()) out += table("Every law on every scenario", plain, laws, grid);
  const LabNames scenarios = scenarios_of(report.runs);
  for (const std::string& scenario : scenarios.all()) {
    std::vector<Column> columns;
    for (const std::string& modifier : modifiers[scenario].all())
      columns.push_back({modifier.empty() ? "unmodified" : modifier, scenario, modifier});
    const bool has_modified = columns.size() > 1 || !columns.front().modifier.empty();
    if (has_modified) out += table(scenario + " under each modifier", columns, laws, grid);
  }
  return out;
}

std::string margin_table(const std::vector<LabMargin>& margins) {
  std::string out =
      "<div class=\"card wide\" tabindex=\"0\"><table><thead><tr><th scope=\"col\">law</th>"
      "<th scope=\"col\">scenario</th><th scope=\"col\">largest gain (1/s)</th>"
      "<th scope=\"col\">largest delay (frames)</th></tr></thead>\n<tbody>\n";
  for (const LabMargin& margin : margins)
    out += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{}</td></tr>\n",
        escaped(margin.law), escaped(margin.scenario), number(margin.gain_per_s),
        number(margin.delay_frames));
  return out + "</tbody></table></div>\n";
}

std::string law_sheets(const std::vector<LabSheet>& sheets) {
  std::string out = "<div class=\"sheets\">\n";
  for (const LabSheet& sheet : sheets)
    out += "<article class=\"card\"><h3>" + escaped(sheet.law) + "</h3>\n<dl>\n" +
           entry("formula", sheet.formula) + entry("needs", sheet.needs) +
           entry("use it", sheet.use) + entry("breaks by", sheet.breaks) +
           entry("source", sheet.source) + "</dl></article>\n";
  return out + "</div>\n";
}

}  // namespace kestrel
