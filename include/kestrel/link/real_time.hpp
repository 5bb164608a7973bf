#pragma once

namespace kestrel {

/// Asks the kernel to run the calling thread before all ordinary ones (SCHED_RR, sched(7)), with
/// this priority, 1 to 99. False when it does not permit it: that takes root, CAP_SYS_NICE, or an
/// RLIMIT_RTPRIO as high (`ulimit -r`).
bool run_in_real_time(int priority);

}  // namespace kestrel
