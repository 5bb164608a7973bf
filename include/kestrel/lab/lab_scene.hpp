#pragma once

#include <optional>

#include "kestrel/lab/conditions.hpp"
#include "kestrel/lab/helicopter_scenario.hpp"
#include "kestrel/lab/lab_report.hpp"
#include "kestrel/lab/scenario.hpp"
#include "kestrel/vehicle/limits.hpp"

namespace kestrel {

/// What a page draws around the runs of a scenario: target, start and goal in the camera at its
/// goal, and where the goal's image has the points.
LabScene scene_of(const Scenario& scenario, const LabCamera& camera,
                  const std::optional<CameraLimits>& limits = {});

/// The same for a helicopter: its camera's start and goal and the target at time 0, in NED.
LabScene scene_of(const HelicopterScenario& scenario, const LabCamera& camera,
                  const std::optional<CommandLimits>& limits = {});

}  // namespace kestrel
