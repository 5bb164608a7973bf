#pragma once

#include "kestrel/io/live_options.hpp"

namespace kestrel::test {

/// Waits that suit a test: a stall after 0.2 s, another attempt after 0.05 s.
inline LiveOptions quick(double open_timeout_s, double give_up_s) {
  LiveOptions options;
  options.open_timeout_s = open_timeout_s;
  options.stall_timeout_s = 0.2;
  options.give_up_s = give_up_s;
  options.retry_s = 0.05;
  return options;
}

}  // namespace kestrel::test
