#include "kestrel/io/match_log.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "kestrel/io/text_file.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

Track matched(int inliers, int others) {
  Track track;
  for (int i = 0; i < inliers; ++i) track.inliers.push_back({{0, 0}, {10.04 + i, 20.26}});
  for (int i = 0; i < others; ++i) track.others.push_back({{0, 0}, {-3.5, 400.0 + i}});
  return track;
}

class Matches : public testing::Test {
 protected:
  const test::TempFolder folder_;
  const std::filesystem::path path_ = folder_ / "matches.csv";
};

TEST_F(Matches, ComeBackToATenthOfAPixel) {
  MatchLog log(path_);
  log.write(7, matched(2, 1));
  log.write(8, matched(0, 0));
  log.write(9, matched(0, 3));
  const auto read = read_matches(path_);
  ASSERT_EQ(read.size(), 2U) << "a frame without matches leaves no line";
  ASSERT_EQ(read.at(7).inliers.size(), 2U);
  EXPECT_NEAR(read.at(7).inliers[1].u, 11.04, 0.05);  // rounded to 0.1
  EXPECT_NEAR(read.at(7).inliers[1].v, 20.26, 0.05);
  ASSERT_EQ(read.at(7).others.size(), 1U);
  EXPECT_EQ(read.at(7).others[0].u, -3.5);
  EXPECT_TRUE(read.at(9).inliers.empty());
  EXPECT_EQ(read.at(9).others.size(), 3U);
}

TEST_F(Matches, OfAFrameAreBounded) {
  MatchLog log(path_);
  log.write(1, matched(3000, 3000));
  const auto read = read_matches(path_);
  EXPECT_EQ(read.at(1).inliers.size(), MatchLog::kMost);
  EXPECT_EQ(read.at(1).others.size(), MatchLog::kMost);
  EXPECT_LT(std::filesystem::file_size(path_), 2 * MatchLog::kMost * 14 + 100);
}

TEST_F(Matches, OfAnOlderRunAreNoneAndOfAKilledOneWhatIsWhole) {
  EXPECT_TRUE(read_matches(folder_ / "none.csv").empty());
  MatchLog log(path_);
  log.write(1, matched(1, 1));
  std::ofstream(path_, std::ios::app) << "2,10.0 20.";
  EXPECT_EQ(read_matches(path_).size(), 1U);
}

TEST_F(Matches, OfNoSuchFileAreRefused) {
  std::ofstream(path_) << "something else\n";
  EXPECT_THROW(read_matches(path_), FileError);
  MatchLog(path_).write(1, matched(1, 0));
  std::ofstream(path_, std::ios::app) << "2,10.0,\n";
  EXPECT_THROW(read_matches(path_), FileError) << "a place has two numbers";
}

}  // namespace
}  // namespace kestrel
