#include "kestrel/io/report.hpp"

#include <algorithm>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/image_codec.hpp"
#include "kestrel/io/markup.hpp"

#include "report_style.hpp"

namespace kestrel {
namespace {

std::string warnings(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return "";
  std::string items;
  for (const std::string& sentence : sentences) items += "<li>" + escaped(sentence) + "</li>\n";
  return "<section class=\"warn\" aria-label=\"Warnings\">\n<h2>Look at this first</h2>\n<ul>\n" +
         items + "</ul>\n</section>\n";
}

std::string summary_row(const SummaryItem& item) {
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td><td class=\"u\">{}</td></tr>\n",
      escaped(item.name), escaped(shown(item.value)), escaped(item.unit));
}

std::string summary_tables(const Summary& summary) {
  const auto& items = summary.items();
  std::string out;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool begins = i == 0 || items[i].section != items[i - 1].section;
    const bool ends = i + 1 == items.size() || items[i + 1].section != items[i].section;
    if (begins) out += "<table>\n";
    if (begins && !items[i].section.empty())
      out += "<caption>" + escaped(items[i].section) + "</caption>\n";
    out += summary_row(items[i]);
    if (ends) out += "</table>\n";
  }
  return out.empty() ? "" : "<div class=\"card tables\">\n" + out + "</div>\n";
}

std::string video(const std::string& name) {
  if (name.empty()) return "";
  const std::string url = escaped(relative_url(name));
  const std::string link = fmt::format("<a href=\"{}\">{}</a>", url, escaped(name));
  const std::string suffix = name.substr(std::min(name.rfind('.'), name.size()));
  if (suffix != ".mp4" && suffix != ".webm")  // browsers play no Motion JPEG
    return "<p class=\"card\">Annotated video: " + link + "</p>\n";
  return fmt::format(
      "<figure class=\"card\"><video controls muted preload=\"metadata\" src=\"{}\" "
      "aria-label=\"Annotated video of the run\"></video>\n"
      "<figcaption>Annotated video: {}</figcaption></figure>\n",
      url, link);
}

/// The pictures of a contact sheet; empty when there are none.
std::string sheet(const std::vector<ReportPicture>& pictures) {
  std::string out;
  for (const ReportPicture& picture : pictures) {
    if (picture.jpeg.empty()) continue;
    out += fmt::format(
        "<figure class=\"card\"><img alt=\"Annotated picture: {0}\" width=\"{1}\" height=\"{2}\" "
        "src=\"data:image/jpeg;base64,{3}\">\n<figcaption>{0}</figcaption></figure>\n",
        escaped(picture.caption), picture.width_px, picture.height_px, base64(picture.jpeg));
  }
  return out.empty() ? "" : "<div class=\"sheet\">\n" + out + "</div>\n";
}

std::string picture_section(const std::vector<ReportPicture>& pictures) {
  const std::string all = sheet(pictures);
  return all.empty() ? "" : "<section>\n<h2>Pictures</h2>\n" + all + "</section>\n";
}

std::string table_row(const std::vector<std::string>& cells) {
  std::string out = "<tr>";
  for (const std::string& cell : cells) {
    const std::string text = escaped(cell);
    out += csv_number(cell) ? "<td class=\"n\">" + text + "</td>" : "<td>" + text + "</td>";
  }
  return out + "</tr>\n";
}

/// Whether a column holds a number anywhere: then its head stands to the right too.
bool has_number(const ReportTable& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
    return column < row.size() && csv_number(row[column]);
  });
}

std::string table(const ReportTable& table) {
  std::string head;
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    head += fmt::format("<th scope=\"col\"{}>{}</th>", has_number(table, i) ? " class=\"n\"" : "",
                        escaped(table.head[i]));
  }
  std::string rows;
  for (const auto& row : table.rows) rows += table_row(row);
  const std::string caption =
      table.caption.empty() ? "" : "<caption>" + escaped(table.caption) + "</caption>\n";
  return "<div class=\"card wide\" tabindex=\"0\"><table>\n" + caption + "<thead><tr>" + head +
         "</tr></thead>\n<tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string section(const ReportSection& part) {
  std::string out = "<section>\n<h2>" + escaped(part.title) + "</h2>\n";
  if (!part.text.empty()) out += "<p>" + escaped(part.text) + "</p>\n";
  for (const ReportTable& one : part.tables) out += table(one);
  if (!part.figures.empty()) out += "<div class=\"plots\">\n";
  for (const std::string& figure : part.figures)
    out += "<figure class=\"card\">\n" + figure + "</figure>\n";
  if (!part.figures.empty()) out += "</div>\n";
  return out + sheet(part.pictures) + "</section>\n";
}

std::string files(const std::vector<ReportFile>& list) {
  std::string rows;
  for (const ReportFile& file : list)
    rows += fmt::format("<tr><th scope=\"row\"><a href=\"{}\">{}</a></th><td>{}</td></tr>\n",
                        escaped(relative_url(file.name)), escaped(file.name), escaped(file.what));
  return rows.empty() ? ""
                      : "<section>\n<h2>Files</h2>\n<div class=\"card\"><table>\n" + rows +
                            "</table></div>\n</section>\n";
}

std::string configuration(const std::string& text) {
  return text.empty()
             ? ""
             : "<section>\n<h2>Configuration</h2>\n<div class=\"card\"><pre tabindex=\"0\">" +
                   escaped(text) + "</pre></div>\n</section>\n";
}

std::string size_words(std::uintmax_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  const double kilobytes = double(bytes) / 1e3;
  return kilobytes < 1000 ? fmt::format("{:.1f} kB", kilobytes)
                          : fmt::format("{:.1f} MB", kilobytes / 1e3);
}

}  // namespace

ReportPicture report_picture(const std::string& caption, const cv::Mat& picture) {
  constexpr int kWidest = 800;  // keeps the page to a few megabytes
  constexpr int kQuality = 85;
  if (picture.empty()) return {caption, {}};
  cv::Mat small = picture;
  if (picture.cols > kWidest)
    cv::resize(picture, small, {}, double(kWidest) / picture.cols, double(kWidest) / picture.cols,
               cv::INTER_AREA);
  return {caption, encode_jpeg(small, kQuality), small.cols, small.rows};
}

std::string report_html(const Report& report) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n",
      escaped(report.title), kReportStyle);
  if (!report.what.empty()) page += "<p>" + escaped(report.what) + "</p>\n";
  page += warnings(report.warnings) + "</header>\n<main>\n";
  page +=
      "<div class=\"top\">\n" + summary_tables(report.summary) + video(report.video) + "</div>\n";
  page += picture_section(report.pictures);
  for (const ReportSection& part : report.sections) page += section(part);
  page += files(report.files) + configuration(report.configuration);
  return page +
         "</main>\n<footer>Made by Kestrel. All numbers of the plots are in the CSV "
         "files.</footer>\n</body>\n</html>\n";
}

std::vector<ReportFile> files_of(const std::filesystem::path& folder,
                                 const std::vector<ReportFile>& descriptions) {
  std::map<std::string, std::uintmax_t> sizes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::error_code error;
    if (entry.is_regular_file(error) && !error)
      sizes[entry.path().filename().string()] = entry.file_size();
  }
  std::vector<ReportFile> out;
  for (const auto& entry : sizes) {
    const std::string& name = entry.first;  // a binding cannot be captured
    const auto known = std::find_if(descriptions.begin(), descriptions.end(),
                                    [&](const ReportFile& file) { return file.name == name; });
    const std::string words = known == descriptions.end() ? "" : known->what + ", ";
    out.push_back({name, words + size_words(entry.second)});
  }
  return out;
}

}  // namespace kestrel
