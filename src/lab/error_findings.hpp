#pragma once

#include <vector>

#include "kestrel/io/run_log.hpp"
#include "kestrel/lab/finding.hpp"

/// What the course of a run's error tells. The rows are those in which the law had an answer.
namespace kestrel {

using LogRows = std::vector<const LogRow*>;

/// 0 for none.
double median_of(std::vector<double> values);

/// Where the error went, and how fast.
Finding error_course(const LogRows& rows, double gain_per_s);

/// The swings of the target in the image, if there are any.
void look_at_swing(const LogRows& rows, double gain_per_s, std::vector<Finding>& findings);

/// Whether the law stands still with an error left.
void look_for_minimum(const LogRows& rows, double gain_per_s, std::vector<Finding>& findings);

}  // namespace kestrel
