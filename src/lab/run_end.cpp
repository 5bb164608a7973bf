#include "kestrel/lab/run_end.hpp"

namespace kestrel {

const char* name(RunEnd end) {
  switch (end) {
    case RunEnd::Converged:
      return "converged";
    case RunEnd::LocalMinimum:
      return "local_minimum";
    case RunEnd::Collision:
      return "collision";
    case RunEnd::Diverged:
      return "diverged";
    case RunEnd::OutOfView:
      return "out_of_view";
    case RunEnd::TimedOut:
      return "timed_out";
    case RunEnd::Refused:
      return "refused";
    case RunEnd::PositionOnly:
      return "position_only";
    case RunEnd::HeadingOnly:
      return "heading_only";
  }
  return "unknown";
}

std::optional<RunEnd> run_end_named(std::string_view wanted) {
  for (int i = 0; i <= int(RunEnd::HeadingOnly); ++i) {
    if (name(RunEnd(i)) == wanted) return RunEnd(i);
  }
  return std::nullopt;
}

}  // namespace kestrel
