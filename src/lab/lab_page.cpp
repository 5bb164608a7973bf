#include "kestrel/lab/lab_page.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kestrel/io/markup.hpp"
#include "kestrel/io/svg_plot.hpp"
#include "kestrel/lab/lab_figures.hpp"
#include "kestrel/lab/page_data.hpp"

#include "page_parts.hpp"
#include "page_tables.hpp"

namespace kestrel {
namespace {

constexpr std::size_t kRows = 120;  // of a trace: what a screen can show

/// A part of the page: the end of its address, its heading, what is in it.
struct Part {
  std::string id;
  std::string title;
  std::string body;
};

/// Where a picture has its style element, and how long that is.
std::pair<std::size_t, std::size_t> style_in(const std::string& figure) {
  constexpr std::string_view kEnd = "</style>";
  const std::size_t begin = figure.find("<style>");
  const std::size_t end = figure.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos) return {figure.size(), 0};
  return {begin, end + kEnd.size() - begin};
}

/// The style of every picture: once in the page, for hundreds of the same make it slow to open.
std::string picture_style() {
  const std::string any = svg_plot({});
  const auto [begin, length] = style_in(any);
  return any.substr(begin, length);
}

std::string plots(const std::vector<std::string>& figures) {
  std::string out = "<div class=\"plots\">\n";
  for (std::string figure : figures) {
    if (figure.empty()) continue;
    const auto [begin, length] = style_in(figure);
    out += "<figure class=\"card\">\n" + figure.erase(begin, length) + "</figure>\n";
  }
  return out + "</div>\n";
}

std::string remarks(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return "";
  std::string items;
  for (const std::string& sentence : sentences) items += "<li>" + escaped(sentence) + "</li>\n";
  return "<section class=\"warn\" aria-label=\"Remarks\">\n<h2>Look at this first</h2>\n<ul>\n" +
         items + "</ul>\n</section>\n";
}

std::string paragraph(const std::string& words) {
  return "<p class=\"soft\">" + escaped(words) + "</p>\n";
}

Part outcomes(const LabReport& report) {
  return {"outcomes", "How the runs ended",
          paragraph("A number is the step from which the error stays below the threshold "
                    "(helicopter: the seconds to settle); a word is how the run ended instead.") +
              outcome_tables(report)};
}

/// Still pictures of each scenario and modifier, folded away by the script.
Part stills(const LabReport& report) {
  std::string body;
  LabNames seen;
  for (const LabRun& run : report.runs) {
    const std::string title =
        run.modifier.empty() ? run.scenario : run.scenario + ", " + run.modifier;
    if (seen.place(title) >= 0) continue;
    seen.add(title);
    body += "<details class=\"still\" open=\"\"><summary>" + escaped(title) + "</summary>\n" +
            plots(scenario_figures(report, run.scenario, run.modifier)) + "</details>\n";
  }
  return {"scenarios", "Every scenario", body};
}

Part basins(const LabReport& report) {
  return {"basins", "Basins of attraction",
          paragraph("From how many of the same random starts each law reached the goal.") +
              plots({basin_figure(report.basins)})};
}

Part maps(const LabReport& report) {
  std::vector<std::string> figures;
  figures.reserve(report.maps.size());
  for (const LabMap& map : report.maps) figures.push_back(map_figure(map));
  return {"maps", "Robustness maps", plots(figures)};
}

std::string preformatted(const std::string& text) {
  return "<div class=\"card\"><pre tabindex=\"0\">" + escaped(text) + "</pre></div>\n";
}

std::vector<Part> parts_of(const LabReport& report) {
  std::vector<Part> parts;
  const auto add = [&](bool wanted, auto make) {
    if (wanted) parts.push_back(make());
  };
  const std::string retreat = retreat_figure(report);
  add(!report.runs.empty(), [&] { return outcomes(report); });
  add(!retreat.empty(), [&] { return Part{"retreat", "Retreat", plots({retreat})}; });
  add(!report.basins.empty(), [&] { return basins(report); });
  add(!report.maps.empty(), [&] { return maps(report); });
  add(!report.margins.empty(), [&] {
    return Part{"margins", "Margins of gain and delay", margin_table(report.margins)};
  });
  add(!report.orders.empty(), [&] {
    return Part{"order", "Order of accuracy", plots({order_figure(report.orders)})};
  });
  add(!report.runs.empty(), [&] { return stills(report); });
  add(!report.sheets.empty(), [&] {
    return Part{"laws-sheets", "The laws", law_sheets(report.sheets)};
  });
  add(!report.commands.empty(), [&] {
    return Part{"again", "To make it again", preformatted(report.commands)};
  });
  add(!report.configuration.empty(), [&] {
    return Part{"configuration", "Configuration", preformatted(report.configuration)};
  });
  return parts;
}

std::string head(const LabReport& report, const std::vector<Part>& parts) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n{2}\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n",
      escaped(report.title), page_style(), picture_style());
  if (!report.what.empty()) out += "<p>" + escaped(report.what) + "</p>\n";
  out += "<nav aria-label=\"Parts of the page\">\n";
  for (const Part& part : parts)
    out += fmt::format("<a href=\"#{}\">{}</a>\n", part.id, escaped(part.title));
  return out + "</nav>\n" + remarks(report.remarks) + "</header>\n<main>\n";
}

std::string section(const Part& part) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", part.id,
                     escaped(part.title), part.body);
}

}  // namespace

std::string lab_page(const LabReport& report) {
  const std::vector<Part> parts = parts_of(report);
  std::string page = head(report, parts);
  for (const Part& part : parts) {
    page += section(part);
    if (part.id == "outcomes") page += page_explorer();
  }
  page +=
      "</main>\n<footer>Made by Kestrel. All numbers of the plots are in the CSV "
      "files.</footer>\n";
  if (!report.runs.empty()) {
    page += "<script type=\"application/json\" id=\"data\">" + page_data(report, kRows) +
            "</script>\n<script>" + std::string(page_script()) + "</script>\n";
  }
  return page + "</body>\n</html>\n";
}

}  // namespace kestrel
