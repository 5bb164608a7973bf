#include "kestrel/vision/track.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(Track, NamesEveryMissDifferently) {
  std::set<std::string> names;
  for (const Miss miss :
       {Miss::None, Miss::NoImage, Miss::FewKeypoints, Miss::FewMatches, Miss::NoConsensus,
        Miss::BadOutline, Miss::Undetermined, Miss::NotAlike, Miss::Ambiguous}) {
    names.insert(name(miss));
  }
  EXPECT_EQ(names.size(), 9U);
  EXPECT_EQ(names.count("unknown"), 0U);
  EXPECT_STREQ(name(Miss::None), "found");
}

TEST(Track, NamesEveryStatusAndStageDifferently) {
  std::set<std::string> names;
  for (const TrackStatus status : {TrackStatus::Found, TrackStatus::Coasting, TrackStatus::Lost}) {
    names.insert(name(status));
  }
  for (const TrackStage stage :
       {TrackStage::None, TrackStage::Aligned, TrackStage::Searched, TrackStage::Detected}) {
    names.insert(name(stage));
  }
  EXPECT_EQ(names.size(), 7U);
  EXPECT_EQ(names.count("unknown"), 0U);
  EXPECT_STREQ(name(TrackStatus::Found), "found");
}

TEST(Track, SaysNothingBeforeAnythingWasSeen) {
  const Track blank;
  EXPECT_FALSE(blank.found());
  EXPECT_EQ(blank.status, TrackStatus::Lost);
  EXPECT_EQ(blank.stage, TrackStage::None);
  EXPECT_EQ(blank.confidence, 0);
  EXPECT_FALSE(blank.next.motion || blank.next.last_seen);
}

}  // namespace
}  // namespace kestrel
