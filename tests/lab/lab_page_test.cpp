#include "kestrel/lab/lab_page.hpp"

#include <algorithm>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/made_up_report.hpp"
#include "support/markup_check.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

LabReport full() {
  LabReport report = test::made_up_report();
  report.remarks = {"one run & another"};
  report.basins = {{"cur", 3, 4, 0.2, 0.99}};
  LabMap map;
  map.title = "kz x noise";
  map.law = "cur";
  map.x = {1};
  map.y = {0};
  map.cells.assign(1, std::vector<LabMap::Cell>(1));
  report.maps = {map};
  report.margins = {{"S0", "des", 59.99, std::nullopt}};
  report.orders = {{"mean", 2.994}};
  report.sheets = {{"cur", "L(s, Z)^+ e", "Z < of each point", "C&H 2006", "always", "retreat"}};
  report.commands = "kestrel compare a.yaml > b";
  report.configuration = "laws: [all]";
  return report;
}

TEST(LabPage, SaysAllItIsGiven) {
  const std::string page = lab_page(full());
  for (const char* words : {"Some &lt;laws&gt; &amp; their runs.", "one run &amp; another", "3/4",
                            "kz x noise", "<td class=\"n\">59.99</td>", ">2.994<",
                            "Z &lt; of each point", "kestrel compare a.yaml &gt; b", "laws: [all]",
                            "href=\"#S3_rz90/kz2\">collision</a>", "href=\"#S2_rz45\">42</a>"})
    EXPECT_THAT(page, HasSubstr(words));
}

TEST(LabPage, NeedsNothingFromElsewhere) {
  std::string page = lab_page(full());
  // The name of the SVG language is no address that is fetched.
  page = std::regex_replace(page, std::regex("xmlns=\"http://www.w3.org/2000/svg\""), "");
  for (const char* sign :
       {"http:", "https:", "<link", "@import", "url(", "src=", "fetch(", "eval("})
    EXPECT_THAT(page, Not(HasSubstr(sign)));
}

TEST(LabPage, IsWellFormed) {
  EXPECT_EQ(test::markup_fault(lab_page(full())), "");
  EXPECT_EQ(test::markup_fault(lab_page({})), "");
}

TEST(LabPage, IdentifiersAreUnique) {
  const std::string page = lab_page(full());
  const std::regex id(" id=\"([^\"]+)\"");
  std::vector<std::string> seen;
  for (std::sregex_iterator i(page.begin(), page.end(), id), end; i != end; ++i)
    seen.push_back((*i)[1]);
  EXPECT_GT(seen.size(), 15u);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(LabPage, TheScriptFindsEveryElementItAsksFor) {
  const std::string page = lab_page(full());
  const std::regex ask("at\\(\"([a-z-]+)\"\\)");
  int asked = 0;
  for (std::sregex_iterator a(page.begin(), page.end(), ask), end; a != end; ++a, ++asked)
    EXPECT_THAT(page, HasSubstr("id=\"" + (*a)[1].str() + "\""));
  EXPECT_GT(asked, 20);
}

TEST(LabPage, PicturesShareOneStyle) {
  const std::string page = lab_page(full());
  const std::regex style("<style");
  // The page's, the pictures', and the one that the script fills.
  EXPECT_EQ(std::distance(std::sregex_iterator(page.begin(), page.end(), style), {}), 3);
  EXPECT_THAT(page, HasSubstr(".kl{fill:none"));
}

TEST(LabPage, EmptyPartsAreLeftOut) {
  const std::string page = lab_page({});
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<section")));
  LabReport one;
  one.runs = {test::made_up_run("S", "cur")};
  EXPECT_THAT(lab_page(one), HasSubstr("<section id=\"explore\""));
  EXPECT_THAT(lab_page(one), Not(HasSubstr("Basins")));
}

TEST(LabPage, OfNineHundredRunsIsSmallEnough) {
  LabReport report;
  for (int s = 0; s < 36; ++s) {
    report.scenes.push_back(test::made_up_scene("S" + std::to_string(s)));
    for (int l = 0; l < 25; ++l)
      report.runs.push_back(
          test::made_up_run("S" + std::to_string(s), "law" + std::to_string(l), "", 30));
  }
  const std::string page = lab_page(report);
  EXPECT_LT(page.size(), 15'000'000u);
  EXPECT_EQ(page, lab_page(report));
}

}  // namespace
}  // namespace kestrel
