#include "kestrel/link/real_time.hpp"

#include <sched.h>

namespace kestrel {

bool run_in_real_time(int priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  return ::sched_setscheduler(0, SCHED_RR, &wanted) == 0;
}

}  // namespace kestrel
