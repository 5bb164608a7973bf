#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "kestrel/sim/helicopter.hpp"
#include "kestrel/vehicle/failsafe.hpp"
#include "kestrel/vehicle/limits.hpp"

namespace kestrel {

/// What is sent while the target is not seen, or the law refuses.
enum class LossReaction {
  Failsafe,  // "failsafe": hold, decay, hover (vehicle/failsafe)
  Hold,      // "hold": the last command for ever
  Hover,     // "hover": zeros at once, as fast as the limits of acceleration allow
};

/// "failsafe", "hold", "hover".
const char* name(LossReaction reaction);

/// A time in which the target is not seen: images taken in [from_s, from_s + for_s).
struct TargetLoss {
  double from_s = 0;
  double for_s = 0;
};

/// The modifiers of a helicopter run: what the law is told wrongly, late or coarsely, and what is
/// done with its answer.
struct HelicopterConditions {
  /// A constant gain in place of the law's own, for the heading hold too.
  std::optional<double> gain_per_s{};
  double duration_s = 40;     // rounded to frames of 1/30 s
  int period_frames = 1;      // p: a command is computed in frames k with k mod p = 0 ...
  int delay_frames = 0;       // ... from the image of frame max(0, k - d)
  bool predicted = false;     // features are moved over the latency with the known motion
  bool feed_forward = false;  // the target's velocity is known and added to the command
  double depth_factor = 1;    // kz: depths and translations told to the law, over the true ones
  double noise_px = 0;        // standard deviation of each pixel coordinate
  std::uint64_t seed = 42;    // of the noise
  double roll_bias_rad = 0;   // of the attitude told to the law, minus the true one
  double pitch_bias_rad = 0;
  double yaw_bias_rad = 0;
  std::optional<CommandLimits> limits = CommandLimits{};
  std::optional<TargetLoss> loss{};
  LossReaction reaction = LossReaction::Failsafe;
  LossOptions failsafe{};
  HelicopterOptions plant{};

  /// Throws std::invalid_argument that names the first one out of range.
  void check() const;
};

/// The conditions changed as a modifier's name says; words joined by "_": kz2 (depth factor), p28
/// (period, frames), d28 (delay, frames), pred (predicted), ff (feed-forward), l2 (gain, 1/s), n1
/// (noise, px), t80 (duration, s), roll2 pitch2 yaw2 (bias, deg), free (no limits), loss2 (not seen
/// from 2 s on), hold, hover (reaction), seed0.93 (p28 d28 t80, what the paper's vehicle had). The
/// empty name changes nothing. Throws std::invalid_argument that names a word it does not know or
/// a value out of range.
HelicopterConditions modified(const HelicopterConditions& conditions, const std::string& modifier);

}  // namespace kestrel
