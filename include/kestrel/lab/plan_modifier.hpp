#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kestrel/lab/conditions.hpp"
#include "kestrel/lab/helicopter_conditions.hpp"

namespace kestrel {

/// A key of the conditions and the value it takes; of a key that takes words, the word's number.
using ConditionSetting = std::pair<std::string, double>;

/// A change of the conditions, on some scenarios and for some laws.
struct PlannedModifier {
  std::string name;
  std::string words;                       // as modified() reads them, applied first; may be empty
  std::vector<ConditionSetting> settings;  // applied after the words, in order
  std::vector<std::string> scenarios;      // empty: on all
  std::vector<std::string> laws;           // empty: for all
};

/// Whether the modifier is for this law on this scenario.
bool applies(const PlannedModifier& modifier, const std::string& scenario, const std::string& law);

/// The keys of conditions that a setting may take: gain_per_s, rate_hz, steps, depth_factor,
/// focal_factor, principal_u_px, principal_v_px, noise_px, seed, delay_frames, limit_linear_m_s,
/// limit_angular_deg_s.
const std::vector<std::string>& condition_keys();

/// Those of a helicopter's: gain_per_s, duration_s, period_frames, delay_frames, predicted,
/// feed_forward, depth_factor, noise_px, seed, roll_bias_deg, pitch_bias_deg, yaw_bias_deg, limited
/// (with those of CommandLimits where there are none yet), limit_forward_m_s ... limit_yaw_deg_s,
/// acceleration_forward_m_s2 ... acceleration_yaw_deg_s2, loss_from_s (to the end), loss_for_s,
/// reaction, hold_s, decay_s, hover_after_s, and of the plant tau_v_s, tau_a_s, tau_z_s, tau_r_s,
/// max_tilt_deg. In the order in which they are to be applied.
const std::vector<std::string>& helicopter_condition_keys();

/// The conditions with one key changed. Throws std::invalid_argument for a key that is none, a
/// fraction where a whole number is wanted, and a value out of range.
Conditions with_setting(const Conditions& conditions, const ConditionSetting& setting);
HelicopterConditions with_setting(const HelicopterConditions& conditions,
                                  const ConditionSetting& setting);

/// The conditions as the modifier leaves them. Throws as with_setting and modified().
Conditions with_modifier(const Conditions& conditions, const PlannedModifier& modifier);
HelicopterConditions with_modifier(const HelicopterConditions& conditions,
                                   const PlannedModifier& modifier);

}  // namespace kestrel
