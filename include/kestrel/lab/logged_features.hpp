#pragma once

#include <optional>
#include <vector>

#include "kestrel/io/run_log.hpp"
#include "kestrel/loop/task.hpp"
#include "kestrel/servo/feature.hpp"

namespace kestrel {

/// The features of the target's corners in a row of a run log, in the camera that measured them
/// (tilted as it was), in the order of desired_features: what decide() was given in that frame. The
/// image points are those of the logged error (of the logged pose when the law had an error of its
/// own), the depths those of the logged pose. Empty when the row has no pose or no answer of the
/// law.
std::vector<Feature> logged_features(const LogRow& row, const Task& task);

/// The same as the levelled camera sees them; as they are when the row has no attitude.
std::vector<Feature> logged_levelled_features(const LogRow& row, const Task& task);

/// The mount of the camera on the levelled helicopter: its axes as in the body, its place as the
/// tilt has moved it.
Mount levelled_mount(const LogRow& row, const Task& task);

}  // namespace kestrel
