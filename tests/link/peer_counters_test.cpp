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
  EXPECT_EQ(name(Refused::CannotSign), std::string("cannot sign"));  // the last one
}

TEST(PeerCounters, SpeakOfDamageAsTheCodecDoes) {
  for (const auto refusal : {mavlink::Refusal::BadMagic, mavlink::Refusal::Truncated,
                             mavlink::Refusal::BadCrc, mavlink::Refusal::UnknownIncompatFlag}) {
    EXPECT_EQ(std::string(name(refused_for(refusal))), mavlink::name(refusal));
  }
}

TEST(PeerCounters, SumTheReasons) {
  PeerCounters counters;
  for (std::size_t i = 0; i < kRefusedReasons; ++i) counters.refused[i] = i + 1;
  EXPECT_EQ(counters.refused_in_all(), kRefusedReasons * (kRefusedReasons + 1) / 2);
  EXPECT_EQ(counters.refused_as(Refused::BadCrc), 3u);
}

}  // namespace
}  // namespace kestrel
