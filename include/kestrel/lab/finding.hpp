#pragma once

#include <string>
#include <vector>

namespace kestrel {

/// How much a finding matters.
enum class Weight {
  Fine,   // "fine": looked at, and as it should be
  Doubt,  // "doubt": may be the cause, or may become one
  Fault,  // "fault": explains a run that does not converge
};

/// One thing that was looked at in a task or a run.
struct Finding {
  Weight weight = Weight::Fine;
  std::string topic;   // "gain", "sign", "depth", ...: for programs
  std::string what;    // a sentence with its numbers
  std::string remedy;  // what to do; empty for Fine
};

/// The word in quotes above.
const char* name(Weight weight);

/// Faults first, then doubts, each in the order they were found.
std::vector<Finding> by_weight(std::vector<Finding> findings);

}  // namespace kestrel
