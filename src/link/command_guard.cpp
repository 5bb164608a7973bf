#include "kestrel/link/command_guard.hpp"

#include <algorithm>
#include <cmath>

#include "kestrel/link/setpoint.hpp"
#include "kestrel/vehicle/limits.hpp"

namespace kestrel {
namespace {

bool is_sound(float value) {
  const int kind = std::fpclassify(value);
  return kind == FP_NORMAL || kind == FP_ZERO;
}

double float_not_above(double limit) {
  const auto nearest = float(limit);
  return double(double(nearest) > limit ? std::nextafter(nearest, 0.0F) : nearest);
}

std::optional<Refused> refused_arrival(Arrival arrival) {
  if (arrival == Arrival::Duplicate) return Refused::Duplicate;
  if (arrival == Arrival::Late) return Refused::Late;
  return std::nullopt;
}

}  // namespace

std::optional<Refused> refused_content(const mavlink::SetPositionTarget& s) {
  const float values[] = {s.x_m,     s.y_m,     s.z_m,     s.vx_m_s,  s.vy_m_s,        s.vz_m_s,
                          s.ax_m_s2, s.ay_m_s2, s.az_m_s2, s.yaw_rad, s.yaw_rate_rad_s};
  if (!std::all_of(std::begin(values), std::end(values), is_sound)) return Refused::NotFinite;
  if (!velocity_of(s)) return Refused::Unsupported;
  return std::nullopt;
}

VelocityCommand float_limits(const VelocityCommand& limits) {
  return {float_not_above(limits.forward_m_s), float_not_above(limits.right_m_s),
          float_not_above(limits.down_m_s), float_not_above(limits.yaw_rate_rad_s)};
}

CommandGuard::CommandGuard(const CommandGuardOptions& options) : options_(options) {
  options_.speed = float_limits(options_.speed);
}

std::variant<GuardedSetpoint, Refused> CommandGuard::check(
    const SourceId& source, const mavlink::SetPositionTarget& setpoint, Arrival arrival,
    double now_s) {
  if (const auto reason = refused_content(setpoint)) return *reason;
  if (const auto reason = refused_arrival(arrival)) return *reason;
  Source* const from = heard(source, setpoint.time_boot_ms, now_s);
  if (from == nullptr) return Refused::TooManySources;
  if (const auto reason = refused(*from, setpoint.time_boot_ms, now_s)) return *reason;
  from->clock.learn(setpoint.time_boot_ms, now_s);
  from->captured_ms = setpoint.time_boot_ms;
  const double age_s = std::max(0.0, from->clock.age_s(setpoint.time_boot_ms, now_s));
  return GuardedSetpoint{saturated(*velocity_of(setpoint), options_.speed), now_s - age_s};
}

std::optional<Refused> CommandGuard::refused(Source& source, std::uint32_t time_boot_ms,
                                             double now_s) const {
  const double age_s = source.clock.age_s(time_boot_ms, now_s);
  if (age_s < -options_.time_to_live_s) {
    return is_confirmed_leap(source, time_boot_ms, now_s) ? std::nullopt
                                                          : std::optional(Refused::FromTheFuture);
  }
  source.leapt.reset();
  if (age_s > options_.time_to_live_s) return Refused::Stale;
  if (stamp_difference_s(time_boot_ms, source.captured_ms) < 0) return Refused::Late;
  return std::nullopt;
}

/// One stamp of the future may be damage; two that agree are a clock.
bool CommandGuard::is_confirmed_leap(Source& source, std::uint32_t time_boot_ms,
                                     double now_s) const {
  const bool agrees =
      source.leapt && std::abs(source.leapt->age_s(time_boot_ms, now_s)) <= options_.time_to_live_s;
  if (agrees) {
    source.clock = *source.leapt;
    source.leapt.reset();
    return true;
  }
  source.leapt.emplace();
  source.leapt->learn(time_boot_ms, now_s);
  return false;
}

CommandGuard::Source* CommandGuard::heard(const SourceId& id, std::uint32_t time_boot_ms,
                                          double now_s) {
  const auto is_silent = [&](const Source& each) {
    return now_s - each.heard_s > options_.forget_s;
  };
  const Source fresh{id, {}, {}, time_boot_ms, now_s};
  const auto found = std::find_if(sources_.begin(), sources_.end(),
                                  [&](const Source& each) { return each.id == id; });
  if (found != sources_.end()) {
    if (is_silent(*found)) *found = fresh;
    found->heard_s = now_s;
    return &*found;
  }
  const auto is_of_peer = [&](const Source& each) { return each.id.peer == id.peer; };
  const auto count = [&] { return std::count_if(sources_.begin(), sources_.end(), is_of_peer); };
  if (std::size_t(count()) >= kSourcesPerPeer) {
    const auto leaves = [&](const Source& each) { return is_of_peer(each) && is_silent(each); };
    sources_.erase(std::remove_if(sources_.begin(), sources_.end(), leaves), sources_.end());
  }
  if (std::size_t(count()) >= kSourcesPerPeer) return nullptr;
  return &sources_.emplace_back(fresh);
}

void CommandGuard::forget(PeerId peer) {
  sources_.erase(std::remove_if(sources_.begin(), sources_.end(),
                                [&](const Source& each) { return each.id.peer == peer; }),
                 sources_.end());
}

}  // namespace kestrel
