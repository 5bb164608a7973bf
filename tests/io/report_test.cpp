#include "kestrel/io/report.hpp"

#include <fstream>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "kestrel/io/run_figures.hpp"

#include "support/log_rows.hpp"
#include "support/markup_check.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Report example() {
  Report report;
  report.title = "Servo: comic <80 frames> & more";
  report.what = "One run of the chain.";
  report.warnings = {"frame 12 (I0012.png) cannot be decoded & was passed over"};
  report.summary.begin_section("Tracking");
  report.summary.add("found", 98.75, "%");
  report.video = "overlay.mp4";
  report.pictures = {report_picture("frame 0", cv::Mat(48, 64, CV_8UC3, cv::Scalar(10, 200, 30))),
                     report_picture("nothing", cv::Mat()),
                     report_picture("frame 9", cv::Mat(600, 1600, CV_8UC1, cv::Scalar(77)))};
  report.sections = simulate_sections(test::made_up_flight(), {});
  report.files = {{"log.csv", "one row a frame"}, {"a b&c.txt", "odd"}};
  report.configuration = "servo:\n  gain_per_s: 0.5  # <here>\n";
  return report;
}

std::vector<unsigned char> decoded(const std::string& base64) {
  std::vector<unsigned char> bytes;
  unsigned group = 0;
  int bits = 0;
  for (const char c : base64) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (c == '=') break;
    group = group << 6 | unsigned(digits.find(c));
    if ((bits += 6) >= 8) bytes.push_back(static_cast<unsigned char>(group >> (bits -= 8)));
  }
  return bytes;
}

TEST(ReportHtml, NeedsNothingFromElsewhere) {
  std::string page = report_html(example());
  // The name of the SVG language is no address that is fetched.
  page = std::regex_replace(page, std::regex("xmlns=\"http://www.w3.org/2000/svg\""), "");
  for (const char* sign : {"http:", "https:", "<script", "<link", "@import", "url(", "src=\"//"})
    EXPECT_THAT(page, Not(HasSubstr(sign)));
}

TEST(ReportHtml, IsWellFormed) {
  EXPECT_EQ(test::markup_fault(report_html(example())), "");
  EXPECT_EQ(test::markup_fault(report_html({})), "");
}

TEST(ReportHtml, SaysAllItIsGiven) {
  const std::string page = report_html(example());
  for (const char* words :
       {"<title>Servo: comic &lt;80 frames&gt; &amp; more</title>", "One run of the chain.",
        "cannot be decoded &amp; was passed over", "98.75", "src=\"./overlay.mp4\"",
        "href=\"./a%20b%26c.txt\"", "gain_per_s: 0.5  # &lt;here&gt;", "Visual features error"})
    EXPECT_THAT(page, HasSubstr(words));
}

TEST(ReportHtml, EveryPictureHasItsWords) {
  const std::string page = report_html(example());
  const std::regex picture(
      "<img alt=\"[^\"]+\" width=\"(\\d+)\" height=\"(\\d+)\" "
      "src=\"data:image/jpeg;base64,([^\"]+)\"");
  std::vector<cv::Size> sizes;
  for (std::sregex_iterator p(page.begin(), page.end(), picture), end; p != end; ++p) {
    const cv::Mat image = cv::imdecode(decoded((*p)[3]), cv::IMREAD_UNCHANGED);
    sizes.push_back(image.size());
    EXPECT_EQ(image.cols, std::stoi((*p)[1]));
    EXPECT_EQ(image.rows, std::stoi((*p)[2]));
  }
  EXPECT_EQ(sizes, (std::vector<cv::Size>{{64, 48}, {800, 300}}));
  for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1))
    EXPECT_NE(page.substr(at, 200).find("aria-label="), std::string::npos);
}

TEST(ReportHtml, ASectionHoldsTablesAndPictures) {
  Report report;
  ReportSection section{"Part", "", {}};
  section.tables = {{"Of <two>", {"name", "px"}, {{"a & b", "1.5"}, {"c", ""}}}};
  section.pictures = {report_picture("frame 3", cv::Mat(8, 8, CV_8UC1, cv::Scalar(1)))};
  report.sections = {section};
  const std::string page = report_html(report);
  EXPECT_EQ(test::markup_fault(page), "");
  for (const char* words :
       {"<caption>Of &lt;two&gt;</caption>", "<th scope=\"col\" class=\"n\">px</th>",
        "<th scope=\"col\">name</th>", "<td>a &amp; b</td>", "<td class=\"n\">1.5</td>",
        "alt=\"Annotated picture: frame 3\""})
    EXPECT_THAT(page, HasSubstr(words));
  EXPECT_LT(page.find("frame 3"), page.find("</section>"));
}

TEST(ReportHtml, LinksAVideoThatBrowsersDoNotPlay) {
  Report report;
  report.video = "overlay.avi";
  EXPECT_THAT(report_html(report), Not(HasSubstr("<video")));
  EXPECT_THAT(report_html(report), HasSubstr("href=\"./overlay.avi\""));
}

TEST(FilesOf, ListsWhatIsThere) {
  const test::TempFolder folder;
  std::ofstream(folder / "log.csv") << "12345";
  std::ofstream(folder / "notes.txt") << std::string(2500, 'x');
  std::filesystem::create_directory(folder / "frames");
  const auto files = files_of(folder.path(), {{"log.csv", "one row a frame"}, {"gone.csv", "no"}});
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "log.csv");
  EXPECT_EQ(files[0].what, "one row a frame, 5 B");
  EXPECT_EQ(files[1].what, "2.5 kB");
}

}  // namespace
}  // namespace kestrel
