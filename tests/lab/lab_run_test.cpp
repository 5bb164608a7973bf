#include "kestrel/lab/lab_run.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(RunTrace, GivesAColumnByItsName) {
  const RunTrace trace{{"step", "time_s"}, {{0, 0.}, {1, .5}}};
  EXPECT_EQ(trace.column("time_s"), (std::vector<double>{0, .5}));
  EXPECT_TRUE(trace.column("x0").empty());
}

}  // namespace
}  // namespace kestrel
