#include "kestrel/servo/helicopter_variant.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(HelicopterVariant, EveryNameIsItsOwnAndLeadsBack) {
  std::set<std::string> names;
  for (const HelicopterVariant variant : all_helicopter_variants()) {
    names.insert(name(variant));
    EXPECT_EQ(helicopter_variant_named(name(variant)), variant);
  }
  EXPECT_EQ(names, (std::set<std::string>{"vp4", "raw4", "drop6", "vp3_hh", "vp3", "mejias"}));
  EXPECT_EQ(helicopter_variant_named("VP4"), std::nullopt);
  EXPECT_EQ(helicopter_variant_named(""), std::nullopt);
}

}  // namespace
}  // namespace kestrel
