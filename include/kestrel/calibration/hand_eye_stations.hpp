#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// A moment: how the vehicle stood, and what its camera saw.
struct HandEyeStation {
  double stamp_s = 0;
  Attitude attitude;                              // of Body against NED
  std::optional<Eigen::Vector3d> position_ned_m;  // of the body's reference point
  TargetPose camera_from_target;
};

/// Which moments count.
struct StationOptions {
  double smallest_turn_rad = 0.035;  // 2 degrees: attitudes nearer to one that is kept add little
  int most = 40;                     // of them, spread over the recording

  /// Throws std::invalid_argument that names the first option out of its range.
  void check() const;
};

/// The moments of a CSV file with a header, one row each: `stamp_s`; `roll_rad`, `pitch_rad`,
/// `yaw_rad`, or each in `_deg`; the target in the camera, `pose_tx_m`, `pose_ty_m`, `pose_tz_m`
/// and `pose_tux_rad`, `pose_tuy_rad`, `pose_tuz_rad` (theta u); where it is known the position,
/// `north_m`, `east_m`, `down_m`. These are the columns of a run's run.csv; others are passed over,
/// and so are rows without attitude or pose, or whose pose had a rival (`has_rival` 1). Throws
/// FileError for columns that are missing or given twofold, a field that is no number, and a file
/// without one row that counts.
std::vector<HandEyeStation> load_stations(const std::filesystem::path& file);

/// Of many moments those that tell most: in their order, each whose attitude is turned by at least
/// smallest_turn_rad against all kept before; of these at most `most`, evenly.
std::vector<HandEyeStation> chosen_stations(const std::vector<HandEyeStation>& all,
                                            const StationOptions& options = {});

/// The attitude as the rotation world_from_body.
Eigen::Matrix3d rotation_of(const Attitude& attitude);

}  // namespace kestrel
