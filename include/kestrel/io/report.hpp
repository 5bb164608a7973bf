#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/io/summary.hpp"

namespace kestrel {

/// A picture of the contact sheet, kept as the file that the page will hold.
struct ReportPicture {
  std::string caption;
  std::vector<unsigned char> jpeg;  // a picture without bytes is left out
  int width_px = 0;
  int height_px = 0;
};

/// An 8-bit BGR or grey picture as a page shows it: at most 800 px wide. Without bytes when the
/// picture is empty.
ReportPicture report_picture(const std::string& caption, const cv::Mat& picture);

/// Rows of words and numbers below a head; what reads as a number stands to the right.
struct ReportTable {
  std::string caption;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// A part of a report: a heading, a sentence, tables, pictures as svg_plot and svg_strip make
/// them, and a contact sheet.
struct ReportSection {
  std::string title;
  std::string text;
  std::vector<std::string> figures;  // SVG documents
  std::vector<ReportTable> tables{};
  std::vector<ReportPicture> pictures{};
};

/// A file of the run folder.
struct ReportFile {
  std::string name;  // relative to the report
  std::string what;
};

/// What a report page says, in the order it says it.
struct Report {
  std::string title;
  std::string what;  // one paragraph
  std::vector<std::string> warnings;
  Summary summary;
  std::string video;  // file name relative to the report; empty: none
  std::vector<ReportPicture> pictures;
  std::vector<ReportSection> sections;
  std::vector<ReportFile> files;
  std::string configuration;  // the effective one, as text
};

/// The report as one HTML page that needs no network and no other file but the video: pictures and
/// plots are inside; light or dark as the reader prefers; prints. Empty parts are left out.
std::string report_html(const Report& report);

/// The files of a folder (not of the folders in it), sorted by name, with sizes; names in
/// `descriptions` get their words, names that are not there are left out.
std::vector<ReportFile> files_of(const std::filesystem::path& folder,
                                 const std::vector<ReportFile>& descriptions);

}  // namespace kestrel
