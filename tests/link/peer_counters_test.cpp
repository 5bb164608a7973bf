#include "kestrel/link/peer_counters.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(PeerCounters, NameEachReasonApart) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kRefusedReasons; ++i) names.insert(name(Refused(i)));
  EXPECT_EQ(names.size(), kRefusedReasons);
  EXPECT_EQ(name(Refused::TooManySources), std::string("too many sources"));  // the last one
}

TEST(PeerCounters, SpeakOfDamageAsTheCodecDoes) {
  for (const auto refusal : {mavlink::Refusal::BadMagic, mavlink::Refusal::Truncated,
                             mavlink::Refusal::BadCrc, mavlink::Refusal::UnknownIncompatFlag}) {
    EXPECT_EQ(std::string(name(refused_for(refusal))), mavlink::name(refusal));
  }
}

TEST(PeerCounters, RefuseEverySignatureButTheGenuine) {
  for (std::size_t i = 0; i < mavlink::kVerdicts; ++i) {
    const auto verdict = mavlink::Verdict(i);
    EXPECT_EQ(!refused_for(verdict), verdict == mavlink::Verdict::Genuine);
  }
}

TEST(PeerCounters, SumTheReasons) {
  PeerCounters counters;
  for (std::size_t i = 0; i < kRefusedReasons; ++i) counters.refused[i] = i + 1;
  EXPECT_EQ(counters.refused_in_all(), kRefusedReasons * (kRefusedReasons + 1) / 2);
  EXPECT_EQ(counters.refused_as(Refused::BadCrc), 3u);
}

TEST(PeerCounters, TellFramesFromWhatWasNone) {
  PeerCounters counters;
  for (std::size_t i = 0; i < kRefusedReasons; ++i) counters.refused[i] = 1;
  EXPECT_EQ(counters.refused_frames(), kRefusedReasons - 5);
}

TEST(PeerCounters, AddUp) {
  PeerCounters a;
  a.chunks = 1;
  a.bytes = 2;
  a.frames = 3;
  a.setpoints = 4;
  a.forwarded = 5;
  a.kept = 6;
  a.delivered = 7;
  a.refused[3] = 8;
  const PeerCounters sum = a + a;
  EXPECT_EQ(sum.chunks, 2u);
  EXPECT_EQ(sum.bytes, 4u);
  EXPECT_EQ(sum.frames, 6u);
  EXPECT_EQ(sum.setpoints, 8u);
  EXPECT_EQ(sum.forwarded, 10u);
  EXPECT_EQ(sum.kept, 12u);
  EXPECT_EQ(sum.delivered, 14u);
  EXPECT_EQ(sum.refused[3], 16u);
}

}  // namespace
}  // namespace kestrel
