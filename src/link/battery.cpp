#include "kestrel/link/battery.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace kestrel {
namespace {

constexpr std::uint16_t kUnknownVoltage = std::numeric_limits<std::uint16_t>::max();

/// The number in steps of an integer of the wire, held within what it can say.
template <class Integer>
Integer steps(double value, double step, double most) {
  return Integer(std::lround(std::clamp(value / step, 0.0, most)));
}

std::string number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

Battery battery_of(const mavlink::SysStatus& status) {
  Battery battery;
  if (status.battery_mv != kUnknownVoltage) battery.voltage_v = status.battery_mv / 1e3;
  if (status.battery_10ma >= 0) battery.current_a = status.battery_10ma / 1e2;
  if (status.battery_percent >= 0 && status.battery_percent <= 100) {
    battery.charge = status.battery_percent / 1e2;
  }
  return battery;
}

mavlink::SysStatus sys_status(const Battery& battery) {
  mavlink::SysStatus status;
  status.battery_mv = kUnknownVoltage;
  status.battery_10ma = -1;
  status.battery_percent = -1;
  if (battery.voltage_v) {
    status.battery_mv = steps<std::uint16_t>(*battery.voltage_v, 1e-3, kUnknownVoltage - 1);
  }
  if (battery.current_a) {
    status.battery_10ma = steps<std::int16_t>(*battery.current_a, 1e-2, 32767);
  }
  if (battery.charge) status.battery_percent = steps<std::int8_t>(*battery.charge, 1e-2, 100);
  return status;
}

bool is_low(const Battery& battery) { return battery.charge && *battery.charge < kLowCharge; }

std::string words(const Battery& battery) {
  std::string all;
  const auto add = [&](const char* format, const std::optional<double>& value) {
    if (value) all += (all.empty() ? "" : ", ") + number(format, *value);
  };
  add("%.1f V", battery.voltage_v);
  add("%.1f A", battery.current_a);
  if (battery.charge) add("%.0f %%", *battery.charge * 100);
  return all.empty() ? "not known" : all;
}

void BatteryOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(endurance_s > 0 && std::isfinite(endurance_s),
          "endurance_s: must be finite and positive (s)");
  require(empty_v > 0 && full_v > empty_v && full_v < 65,
          "full_v, empty_v: must be positive, full above empty, and below 65 (V)");
  require(flying_a >= 0 && flying_a <= 327, "flying_a: must be from 0 to 327 (A)");
  require(idle_a >= 0 && idle_a <= 327, "idle_a: must be from 0 to 327 (A)");
  require(start_charge >= 0 && start_charge <= 1, "start_charge: must be from 0 to 1");
}

Battery drained(const BatteryOptions& options, double flown_s, double current_a) {
  const double charge = std::clamp(options.start_charge - flown_s / options.endurance_s, 0.0, 1.0);
  return {options.empty_v + charge * (options.full_v - options.empty_v), current_a, charge};
}

}  // namespace kestrel
