#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kestrel/lab/camera_experiment.hpp"
#include "kestrel/lab/helicopter_experiment.hpp"
#include "kestrel/lab/lab_plan.hpp"

namespace kestrel {

/// The plan of a YAML file (tasks/compare.md has every key), starts drawn or read. Throws FileError
/// with the line for any mistake, and std::invalid_argument as LabPlan::check.
LabPlan load_plan(const std::filesystem::path& file);

/// The effective plan as such a file, every default written out; the starts of a basin are read
/// from starts_file(basin), relative to the file.
std::string plan_text(const LabPlan& plan);

/// "starts/NAME.csv".
std::filesystem::path starts_file(const PlannedBasin& basin);

/// Starts as CSV: tx_m, ty_m, tz_m, tux_rad, tuy_rad, tuz_rad (c*Mc), a line each, exactly.
std::string starts_csv(const std::vector<StartPose>& starts);

/// The starts of such a file. Throws FileError with the line.
std::vector<StartPose> load_starts(const std::filesystem::path& file);

/// Everything in a plan that decides a run, as text: equal texts, equal runs by one program.
std::string text_of(const CameraExperiment& experiment);
std::string text_of(const HelicopterExperiment& experiment);

}  // namespace kestrel
