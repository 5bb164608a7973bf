#include "kestrel/servo/law.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(Law, NamesAreUniqueAndReadBack) {
  std::set<std::string> names;
  for (Law law : all_laws()) {
    EXPECT_TRUE(names.insert(name(law)).second) << name(law);
    EXPECT_EQ(law_named(name(law)), law);
  }
  EXPECT_EQ(names.count("unknown"), 0u);
  EXPECT_EQ(all_laws().size(), 25u);
}

TEST(Law, NoOtherNameIsALaw) {
  EXPECT_FALSE(law_named(""));
  EXPECT_FALSE(law_named("CUR"));
  EXPECT_FALSE(law_named("unknown"));
}

}  // namespace
}  // namespace kestrel
