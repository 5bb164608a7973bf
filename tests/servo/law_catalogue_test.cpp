#include "kestrel/servo/law_catalogue.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(LawCatalogue, HasAFullSheetForEveryLaw) {
  for (const Law law : all_laws()) {
    const LawSheet& sheet = law_sheet(law);
    for (const std::string& text :
         {sheet.title, sheet.formula, sheet.needs, sheet.source, sheet.use, sheet.breaks}) {
      EXPECT_GE(text.size(), 7u) << name(law) << ": " << text;
      for (const char c : text) EXPECT_TRUE(c >= ' ' && c <= '~') << name(law) << ": " << text;
      EXPECT_EQ(text.find("  "), std::string::npos) << name(law) << ": " << text;
    }
    EXPECT_NE(sheet.formula.find("lambda"), std::string::npos) << name(law);
    EXPECT_EQ(sheet.use.back(), '.') << name(law);
    EXPECT_EQ(sheet.breaks.back(), '.') << name(law);
  }
}

TEST(LawCatalogue, HasNoSheetTwice) {
  std::set<std::string> titles;
  std::set<std::string> formulas;
  std::set<std::string> uses;
  std::set<std::string> breaks;
  for (const Law law : all_laws()) {
    const LawSheet& sheet = law_sheet(law);
    EXPECT_TRUE(titles.insert(sheet.title).second) << name(law);
    EXPECT_TRUE(formulas.insert(sheet.formula).second) << name(law);
    EXPECT_TRUE(uses.insert(sheet.use).second) << name(law);
    EXPECT_TRUE(breaks.insert(sheet.breaks).second) << name(law);
  }
}

}  // namespace
}  // namespace kestrel
