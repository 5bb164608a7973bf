#include "kestrel/lab/run_end.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(RunEnd, NamesReadBack) {
  for (int i = 0; i <= int(RunEnd::HeadingOnly); ++i) {
    EXPECT_EQ(run_end_named(name(RunEnd(i))), RunEnd(i));
  }
  EXPECT_FALSE(run_end_named("unknown"));
  EXPECT_FALSE(run_end_named(""));
}

}  // namespace
}  // namespace kestrel
