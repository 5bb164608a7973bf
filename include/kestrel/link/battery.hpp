#pragma once

#include <optional>
#include <string>

#include "kestrel/link/vehicle_messages.hpp"

namespace kestrel {

/// What is known of a vehicle's battery; empty: not known.
struct Battery {
  std::optional<double> voltage_v;
  std::optional<double> current_a;  // out of it
  std::optional<double> charge;     // 0: empty, 1: full
};

/// What SYS_STATUS tells of it (mavlink.io, "common": UINT16_MAX mV, -1 cA and -1 % are not known,
/// and so is what no battery has: a charge beyond 100 %, a current below 0).
Battery battery_of(const mavlink::SysStatus& status);

/// The battery's part of SYS_STATUS; the inverse of battery_of but for its steps of 1 mV, 10 mA and
/// 1 %.
mavlink::SysStatus sys_status(const Battery& battery);

/// Below this share a human is warned.
constexpr double kLowCharge = 0.2;

/// True below kLowCharge; false where the charge is not known.
bool is_low(const Battery& battery);

/// "11.1 V, 24.0 A, 63 %", what is known of it; "not known" when nothing is.
std::string words(const Battery& battery);

/// A stand-in for a battery in a simulated flight: its charge falls evenly with the time flown, and
/// its voltage evenly with its charge. Real ones do neither; what is shown is the way of the
/// numbers, not when a vehicle must land.
struct BatteryOptions {
  double endurance_s = 1200;  // flown from full to empty
  double full_v = 12.6;       // three lithium cells
  double empty_v = 10.5;
  double flying_a = 20;
  double idle_a = 0.5;      // on the ground
  double start_charge = 1;  // 0 to 1

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// The stand-in after so long in the air, s.
Battery drained(const BatteryOptions& options, double flown_s, double current_a);

}  // namespace kestrel
