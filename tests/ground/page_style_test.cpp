// The colours of the page against the contrast that WCAG 2.1 asks for (AA: 4.5 for text, success
// criterion 1.4.3; 3 for what is no text, 1.4.11), and that nothing in it needs an inline style.
#include <cmath>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/io/text_file.hpp"

namespace kestrel {
namespace {

std::string part(const std::string& file) {
  return read_text(std::filesystem::path(KESTREL_SOURCE_DIR "/src/ground/page") / file);
}

/// The colours of :root by their names; "white" and "black" besides.
std::map<std::string, std::string> colours() {
  std::map<std::string, std::string> all{{"white", "ffffff"}, {"black", "000000"}};
  const std::string css = part("ground.css");
  const std::regex colour("--([a-z0-9-]+):#([0-9a-f]{6})");
  for (std::sregex_iterator it(css.begin(), css.end(), colour), end; it != end; ++it) {
    all[(*it)[1]] = (*it)[2];
  }
  return all;
}

/// Relative luminance (WCAG 2.1, "relative luminance"): sRGB made linear, then weighted.
double luminance(const std::string& hex) {
  const double weights[] = {0.2126, 0.7152, 0.0722};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double c = std::stoi(hex.substr(std::size_t(2 * i), 2), nullptr, 16) / 255.0;
    sum += weights[i] * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}

double contrast(const std::string& a, const std::string& b) {
  const double x = luminance(a);
  const double y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(PageStyle, ContrastIsWhatWcagSays) {
  EXPECT_NEAR(contrast("000000", "ffffff"), 21, 1e-9);
  EXPECT_NEAR(contrast("777777", "ffffff"), 4.48, 0.01) << "WebAIM's example of just not enough";
}

TEST(PageStyle, TextHasTheContrastOfAa) {
  const auto all = colours();
  const std::vector<std::pair<std::string, std::string>> pairs{
      {"ink", "page"},   {"ink", "card"},  {"soft", "page"},  {"soft", "card"},
      {"ink", "button"}, {"ok-ink", "ok"}, {"so-ink", "so"},  {"bad-ink", "bad"},
      {"white", "stop"}, {"white", "go"},  {"white", "hold"}, {"page", "accent"},
      {"ink", "line"}};
  for (const auto& [ink, ground] : pairs) {
    EXPECT_GE(contrast(all.at(ink), all.at(ground)), 4.5) << ink << " on " << ground;
  }
}

TEST(PageStyle, WhatIsNoTextHasThree) {
  const auto all = colours();
  for (const char* mark :
       {"accent", "frame", "bad-line", "c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7"}) {
    EXPECT_GE(contrast(all.at(mark), all.at("card")), 3) << mark;
  }
}

TEST(PageStyle, NothingNeedsAnInlineStyleOrScript) {
  const std::string html = part("ground.html");
  EXPECT_FALSE(std::regex_search(html, std::regex("\\sstyle\\s*=")));
  EXPECT_FALSE(std::regex_search(html, std::regex("\\son[a-z]+\\s*=")));
  EXPECT_FALSE(std::regex_search(html, std::regex("https?://")));
  for (const char* file : {"sticks.js", "settings.js", "views.js", "page.js", "commands.js"}) {
    EXPECT_FALSE(
        std::regex_search(part(file), std::regex("setAttribute\\(\"style|innerHTML|eval\\(")))
        << file;
  }
}

}  // namespace
}  // namespace kestrel
