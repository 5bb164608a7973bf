#include "kestrel/lab/finding.hpp"

#include <algorithm>

namespace kestrel {

const char* name(Weight weight) {
  switch (weight) {
    case Weight::Fine:
      return "fine";
    case Weight::Doubt:
      return "doubt";
    case Weight::Fault:
      break;
  }
  return "fault";
}

std::vector<Finding> by_weight(std::vector<Finding> findings) {
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.weight > b.weight; });
  return findings;
}

}  // namespace kestrel
