#include "kestrel/io/summary.hpp"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

Summary example() {
  Summary summary;
  summary.add("task", "comic \"quoted\" θ");
  summary.begin_section("Tracking");
  summary.add("frames", 80);
  summary.add("mean corner error", 1.0 / 3, "px");
  summary.add("found", 98.75, "%");
  summary.begin_section("Flight");
  summary.add("mean speed", 0.1, "m/s");
  summary.add("arrived", true);
  summary.add("time to arrive", std::nan(""), "s");
  return summary;
}

TEST(Summary, ComesBackFromJson) {
  const auto root = nlohmann::json::parse(json(example()));
  EXPECT_EQ(root.at("task"), "comic \"quoted\" θ");
  EXPECT_EQ(root.at("tracking").at("frames"), 80);
  EXPECT_EQ(root.at("tracking").at("mean_corner_error_px").get<double>(), 1.0 / 3);
  EXPECT_EQ(root.at("tracking").at("found_percent"), 98.75);
  EXPECT_EQ(root.at("flight").at("mean_speed_m_s"), 0.1);
  EXPECT_EQ(root.at("flight").at("arrived"), true);
  EXPECT_TRUE(root.at("flight").at("time_to_arrive_s").is_null());
}

TEST(Summary, KeepsTheOrder) {
  const std::string text = json(example());
  EXPECT_LT(text.find("frames"), text.find("mean_corner_error_px"));
  EXPECT_LT(text.find("tracking"), text.find("flight"));
}

TEST(Summary, RefusesTwoValuesOfOneName) {
  Summary summary;
  summary.add("Mean error", 1.0, "px");
  summary.add("mean  error", 2.0, "px");
  EXPECT_THROW(json(summary), std::invalid_argument);
  Summary mixed;
  mixed.add("flight", 1.0);
  mixed.begin_section("Flight");
  mixed.add("speed", 2.0);
  EXPECT_THROW(json(mixed), std::invalid_argument);
}

TEST(Summary, SurvivesTextThatIsNoUtf8) {
  Summary summary;
  summary.add("file", "a\xff.png");
  EXPECT_TRUE(nlohmann::json::accept(json(summary)));
}

TEST(TextTable, AlignsDecimalPoints) {
  Summary summary;
  summary.add("a", 80);
  summary.add("longer", 1.25, "px");
  summary.add("ö", 0.5, "s");
  EXPECT_EQ(text_table(summary),
            "  a       80\n"
            "  longer   1.25 px\n"
            "  ö        0.5 s\n");
}

TEST(TextTable, HeadsSections) {
  EXPECT_THAT(text_table(example()), ::testing::HasSubstr("\n\nTracking\n  frames"));
  EXPECT_THAT(text_table(example()), ::testing::HasSubstr("n/a s\n"));
  EXPECT_EQ(text_table({}), "");
}

TEST(WriteSummary, WritesTheJson) {
  const test::TempFolder folder;
  write_summary(folder / "summary.json", example());
  std::ifstream file(folder / "summary.json");
  EXPECT_EQ(nlohmann::json::parse(file), nlohmann::json::parse(json(example())));
  EXPECT_THROW(write_summary("/dev/full", example()), std::runtime_error);
}

}  // namespace
}  // namespace kestrel
