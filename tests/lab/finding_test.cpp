#include "kestrel/lab/finding.hpp"

#include <gmock/gmock.h>

namespace kestrel {
namespace {

TEST(Finding, FaultsComeFirstAndKeepTheirOrder) {
  const std::vector<Finding> sorted = by_weight({{Weight::Fine, "a", "", ""},
                                                 {Weight::Fault, "b", "", ""},
                                                 {Weight::Doubt, "c", "", ""},
                                                 {Weight::Fault, "d", "", ""}});
  std::vector<std::string> topics;
  for (const Finding& f : sorted) topics.push_back(f.topic);
  EXPECT_THAT(topics, testing::ElementsAre("b", "d", "c", "a"));
}

TEST(Finding, WeightsHaveWords) {
  EXPECT_STREQ(name(Weight::Fine), "fine");
  EXPECT_STREQ(name(Weight::Doubt), "doubt");
  EXPECT_STREQ(name(Weight::Fault), "fault");
}

}  // namespace
}  // namespace kestrel
