#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/camera_run.hpp"
#include "kestrel/lab/helicopter_run.hpp"
#include "kestrel/lab/start_poses.hpp"

/// The numbers that a plan's file may give, by their keys: what reads them and what writes them go
/// through the same lists.
namespace kestrel {

inline constexpr double kPlanDegree = 3.14159265358979323846 / 180;

/// A number of a struct: unit is what one of the key's unit is in the struct's.
template <class Struct>
struct NumberKey {
  const char* key;
  double Struct::*number;
  double unit = 1;
};

inline const std::vector<NumberKey<LawOptions>>& law_keys() {
  static const std::vector<NumberKey<LawOptions>> keys{
      {"smooth_start_per_s", &LawOptions::smooth_start_per_s},
      {"rank_tolerance", &LawOptions::rank_tolerance},
      {"max_condition", &LawOptions::max_condition},
      {"damping", &LawOptions::damping},
      {"learning_gate", &LawOptions::learning_gate},
      {"forgetting", &LawOptions::forgetting},
      {"initial_covariance", &LawOptions::initial_covariance}};
  return keys;
}

inline const std::vector<NumberKey<LawGain>>& gain_keys() {
  static const std::vector<NumberKey<LawGain>> keys{
      {"gain_at_zero_per_s", &LawGain::at_zero_per_s},
      {"gain_at_infinity_per_s", &LawGain::at_infinity_per_s},
      {"gain_slope_per_s", &LawGain::slope_at_zero_per_s}};
  return keys;
}

inline const std::vector<NumberKey<RunRules>>& rule_keys() {
  static const std::vector<NumberKey<RunRules>> keys{
      {"error_threshold", &RunRules::error_threshold},
      {"still_threshold", &RunRules::still_threshold},
      {"collision_m", &RunRules::collision_m},
      {"diverged_m", &RunRules::diverged_m},
      {"pose_tolerance_share", &RunRules::pose_tolerance_share},
      {"pose_tolerance_deg", &RunRules::pose_tolerance_rad, kPlanDegree},
      {"settled_error", &RunRules::settled_error}};
  return keys;
}

inline const std::vector<NumberKey<HelicopterRules>>& helicopter_rule_keys() {
  static const std::vector<NumberKey<HelicopterRules>> keys{
      {"position_tolerance_m", &HelicopterRules::position_tolerance_m},
      {"heading_tolerance_deg", &HelicopterRules::heading_tolerance_rad, kPlanDegree},
      {"still_threshold", &HelicopterRules::still_threshold},
      {"still_s", &HelicopterRules::still_s},
      {"collision_m", &HelicopterRules::collision_m},
      {"diverged_m", &HelicopterRules::diverged_m}};
  return keys;
}

inline const std::vector<NumberKey<StartBox>>& box_keys() {
  static const std::vector<NumberKey<StartBox>> keys{
      {"largest_tilt_deg", &StartBox::largest_tilt_rad, kPlanDegree},
      {"largest_roll_deg", &StartBox::largest_roll_rad, kPlanDegree},
      {"margin_px", &StartBox::margin_px},
      {"nearest_m", &StartBox::nearest_m}};
  return keys;
}

/// The number that times the unit is this value, to the bit where there is one; a short one first.
double in_unit(double value, double unit);

}  // namespace kestrel
