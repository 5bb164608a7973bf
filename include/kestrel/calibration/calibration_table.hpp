#pragma once

#include <string>

#include "kestrel/calibration/calibration_job.hpp"
#include "kestrel/io/report.hpp"
#include "kestrel/io/summary.hpp"

namespace kestrel {

/// The calibration as a whole: board, model, views, errors, field of view, the cross-check.
Summary summary_of(const CalibrationResult& result);

/// The camera's numbers with their standard deviations; without rows when there is no camera.
ReportTable parameter_table(const CalibrationResult& result);

/// Each view: its points, errors (px), distance (m) and tilt (degrees).
ReportTable view_table(const CalibrationResult& result);

/// What ViSP found beside what we found with the same model; without rows when it was not asked.
ReportTable visp_table(const CalibrationResult& result);

/// All of that and the objections as lines for a terminal.
std::string calibration_text(const CalibrationResult& result);

/// All of it as JSON, numbers in full; null for what is missing.
std::string calibration_json(const CalibrationResult& result);

}  // namespace kestrel
