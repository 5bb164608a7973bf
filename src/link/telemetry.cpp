#include "kestrel/link/telemetry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr double kBelievable_s = 1;  // between the time of a sample and its arrival

Attitude attitude_of(const Eigen::Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
          std::atan2(R(1, 0), R(0, 0))};
}

/// The sample before and the one after a time, as iterators; the first is the end when there is
/// none before, the second when there is none after.
template <class Samples>
auto around(const Samples& samples, double stamp_s) {
  const auto after =
      std::lower_bound(samples.begin(), samples.end(), stamp_s,
                       [](const auto& sample, double stamp) { return sample.stamp_s < stamp; });
  return std::pair(after == samples.begin() ? samples.end() : std::prev(after), after);
}

/// Where a time lies: after the newest sample, at one, or so far (0 to 1) between two.
enum class Place { Nowhere, Beyond, At, Between };

template <class Samples>
Place place(const Samples& samples, double stamp_s, const TelemetryOptions& options) {
  const auto [before, after] = around(samples, stamp_s);
  if (after != samples.end() && after->stamp_s == stamp_s) return Place::At;
  if (before == samples.end()) return Place::Nowhere;
  if (after != samples.end()) {
    return after->stamp_s - before->stamp_s <= options.widest_gap_s ? Place::Between
                                                                    : Place::Nowhere;
  }
  return stamp_s - before->stamp_s <= options.extrapolate_s ? Place::Beyond : Place::Nowhere;
}

}  // namespace

const char* name(Landed landed) {
  constexpr const char* kNames[] = {"unknown", "on the ground", "in the air", "taking off",
                                    "landing"};
  return kNames[std::size_t(landed)];
}

void TelemetryOptions::check() const {
  if (!(history_s > 0 && std::isfinite(history_s))) {
    throw std::invalid_argument("history_s: must be finite and positive (s)");
  }
  if (!(extrapolate_s >= 0 && extrapolate_s <= kBelievable_s)) {
    throw std::invalid_argument("extrapolate_s: must be from 0 to 1 (s)");
  }
  if (!(widest_gap_s > 0 && std::isfinite(widest_gap_s))) {
    throw std::invalid_argument("widest_gap_s: must be finite and positive (s)");
  }
}

Telemetry::Telemetry(const TelemetryOptions& options) : options_(options) { options_.check(); }

void Telemetry::take(const mavlink::Message& message, double now_s,
                     const std::optional<ClockEstimate>& clock) {
  if (const auto* attitude = std::get_if<mavlink::AttitudeReport>(&message)) {
    take_attitude(*attitude, now_s, clock);
  } else if (const auto* position = std::get_if<mavlink::LocalPosition>(&message)) {
    take_position(*position, now_s, clock);
  } else if (const auto* extended = std::get_if<mavlink::ExtendedSysState>(&message)) {
    const bool is_known = extended->landed_state <= std::uint8_t(Landed::Landing);
    landed_ = is_known ? Landed(extended->landed_state) : Landed::Unknown;
  } else if (const auto* heartbeat = std::get_if<mavlink::Heartbeat>(&message)) {
    state_ = VehicleState{*heartbeat, now_s, landed_, down_m_, battery_};
  } else if (const auto* status = std::get_if<mavlink::SysStatus>(&message)) {
    battery_ = battery_of(*status);
  }
  if (state_) state_->landed = landed_;
  if (state_) state_->down_m = down_m_;
  if (state_) state_->battery = battery_;
}

void Telemetry::take_attitude(const mavlink::AttitudeReport& r, double now_s,
                              const std::optional<ClockEstimate>& clock) {
  const AttitudeSample sample{date(r.time_boot_ms, now_s, clock),
                              rotation_from_rpy(r.roll_rad, r.pitch_rad, r.yaw_rad),
                              {r.roll_rate_rad_s, r.pitch_rate_rad_s, r.yaw_rate_rad_s}};
  if (!sample.world_from_body.allFinite() || !sample.rates_rad_s.allFinite()) {
    ++counts_.not_finite;
  } else if (keep(attitudes_, sample)) {
    ++counts_.attitudes;
  }
}

void Telemetry::take_position(const mavlink::LocalPosition& r, double now_s,
                              const std::optional<ClockEstimate>& clock) {
  const MotionSample sample{date(r.time_boot_ms, now_s, clock),
                            {{r.x_m, r.y_m, r.z_m}, {r.vx_m_s, r.vy_m_s, r.vz_m_s}}};
  if (!sample.motion.position_ned_m.allFinite() || !sample.motion.velocity_ned_m_s.allFinite()) {
    ++counts_.not_finite;
  } else if (keep(motions_, sample)) {
    ++counts_.positions;
    down_m_ = sample.motion.position_ned_m.z();
  }
}

double Telemetry::date(std::uint32_t time_boot_ms, double now_s,
                       const std::optional<ClockEstimate>& clock) {
  if (!clock) return now_s;
  constexpr double kTurn_s = 4294967.296;  // 2^32 ms
  const double own_s = clock->to_ours(time_boot_ms / 1000.0);
  const double turns = std::round((now_s - own_s) / kTurn_s);
  const double dated_s = own_s + turns * kTurn_s;
  if (std::abs(now_s - dated_s) <= kBelievable_s) return std::min(dated_s, now_s);
  ++counts_.misdated;
  return now_s;
}

template <class Sample>
bool Telemetry::keep(std::deque<Sample>& samples, const Sample& sample) {
  if (!samples.empty() && sample.stamp_s < samples.back().stamp_s - kBelievable_s) {
    samples.clear();
    ++counts_.restarts;
  }
  if (!samples.empty() && !(sample.stamp_s > samples.back().stamp_s)) {
    ++counts_.out_of_order;
    return false;
  }
  samples.push_back(sample);
  while (samples.size() > kMaxSamples ||
         samples.front().stamp_s < sample.stamp_s - options_.history_s) {
    samples.pop_front();
  }
  return true;
}

std::optional<Attitude> Telemetry::attitude_at(double stamp_s) const {
  const auto [before, after] = around(attitudes_, stamp_s);
  switch (place(attitudes_, stamp_s, options_)) {
    case Place::Nowhere:
      return std::nullopt;
    case Place::At:
      return attitude_of(after->world_from_body);
    case Place::Beyond: {
      const Eigen::Vector3d turn = before->rates_rad_s * (stamp_s - before->stamp_s);
      return attitude_of(before->world_from_body * rotation_from_vector(turn));
    }
    case Place::Between:
      break;
  }
  const double share = (stamp_s - before->stamp_s) / (after->stamp_s - before->stamp_s);
  const Eigen::Vector3d turn =
      rotation_vector(before->world_from_body.transpose() * after->world_from_body);
  return attitude_of(before->world_from_body * rotation_from_vector(share * turn));
}

std::optional<VehicleMotion> Telemetry::motion_at(double stamp_s) const {
  const auto [before, after] = around(motions_, stamp_s);
  switch (place(motions_, stamp_s, options_)) {
    case Place::Nowhere:
      return std::nullopt;
    case Place::At:
      return after->motion;
    case Place::Beyond: {
      VehicleMotion motion = before->motion;
      motion.position_ned_m += motion.velocity_ned_m_s * (stamp_s - before->stamp_s);
      return motion;
    }
    case Place::Between:
      break;
  }
  const double share = (stamp_s - before->stamp_s) / (after->stamp_s - before->stamp_s);
  const VehicleMotion& a = before->motion;
  const VehicleMotion& b = after->motion;
  return VehicleMotion{a.position_ned_m + share * (b.position_ned_m - a.position_ned_m),
                       a.velocity_ned_m_s + share * (b.velocity_ned_m_s - a.velocity_ned_m_s)};
}

}  // namespace kestrel
