#include "kestrel/link/real_time.hpp"

#include <thread>

#include <gtest/gtest.h>
#include <sched.h>

namespace kestrel {
namespace {

TEST(RealTime, IsGivenToTheThreadThatAsksOrRefused) {
  std::thread([] {
    const bool given = run_in_real_time(5);
    EXPECT_EQ(sched_getscheduler(0) == SCHED_RR, given);
    sched_param is{};
    EXPECT_EQ(sched_getparam(0, &is), 0);
    EXPECT_EQ(is.sched_priority, given ? 5 : 0);
  }).join();
  EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);  // of nobody else
}

TEST(RealTime, HasNoSuchPriority) {
  EXPECT_FALSE(run_in_real_time(0));
  EXPECT_FALSE(run_in_real_time(1000));
}

}  // namespace
}  // namespace kestrel
