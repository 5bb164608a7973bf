#include "kestrel/link/axis_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

double part(const Excursion& d, MotionAxis axis) {
  const std::array<double, 4> parts = {d.forward_m, d.right_m, d.down_m, d.yaw_rad};
  return parts[std::size_t(axis)];
}

std::string number(const char* format, double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// The axis along which it went furthest; Yaw when it was asked to turn.
MotionAxis widest(MotionAxis asked, const Excursion& d) {
  if (asked == MotionAxis::Yaw) return MotionAxis::Yaw;
  MotionAxis most = asked;
  for (const MotionAxis axis : {MotionAxis::Forward, MotionAxis::Right, MotionAxis::Down}) {
    if (std::abs(part(d, axis)) > std::abs(part(d, most))) most = axis;
  }
  return most;
}

}  // namespace

const char* name(MotionAxis axis) {
  constexpr const char* kNames[] = {"forward", "right", "down", "yaw"};
  return kNames[std::size_t(axis)];
}

const char* opposite_name(MotionAxis axis) {
  constexpr const char* kNames[] = {"back", "left", "up", "yaw left"};
  return kNames[std::size_t(axis)];
}

const char* name(AxisVerdict verdict) {
  constexpr const char* kNames[] = {"as commanded", "not moved", "opposite", "other axis"};
  return kNames[std::size_t(verdict)];
}

VelocityCommand along(MotionAxis axis, double rate) {
  Eigen::Vector4d v = Eigen::Vector4d::Zero();
  v[Eigen::Index(axis)] = rate;
  return VelocityCommand::from_vector(v);
}

Excursion excursion(const VehicleMotion& from, double yaw_from_rad, const VehicleMotion& to,
                    double yaw_to_rad) {
  const Eigen::Vector3d way = to.position_ned_m - from.position_ned_m;
  const double c = std::cos(yaw_from_rad);
  const double s = std::sin(yaw_from_rad);
  return {c * way.x() + s * way.y(), -s * way.x() + c * way.y(), way.z(),
          wrap_angle(yaw_to_rad - yaw_from_rad)};
}

AxisVerdict judge(MotionAxis axis, double rate, double seconds, const Excursion& done) {
  const double half = std::abs(rate * seconds) / 2;
  const MotionAxis most = widest(axis, done);
  if (!(std::abs(part(done, most)) >= half)) return AxisVerdict::NotMoved;
  if (most != axis) return AxisVerdict::OtherAxis;
  return part(done, axis) * rate > 0 ? AxisVerdict::AsCommanded : AxisVerdict::Opposite;
}

std::string words(MotionAxis axis, double rate, double seconds, const Excursion& done) {
  const auto named = [](MotionAxis which, double signed_part) {
    return std::string(signed_part < 0 ? opposite_name(which) : name(which));
  };
  const bool turn = axis == MotionAxis::Yaw;
  const MotionAxis most = widest(axis, done);
  const double moved = part(done, most);
  std::string text = "commanded " + named(axis, rate) +
                     (turn ? number(" %.0f deg/s", std::abs(rate) / kDegree)
                           : number(" %.2f m/s", std::abs(rate))) +
                     number(" for %.1f s: the vehicle ", seconds);
  if (judge(axis, rate, seconds, done) == AxisVerdict::NotMoved) {
    return text + "did not follow (" + named(axis, part(done, axis)) +
           (turn ? number(" %.0f deg)", std::abs(part(done, axis)) / kDegree)
                 : number(" %.2f m)", std::abs(part(done, axis))));
  }
  if (turn) {
    return text + "turned " + (moved < 0 ? "left" : "right") +
           number(" %.0f deg", std::abs(moved) / kDegree);
  }
  return text + "moved " + named(most, moved) + number(" %.2f m", std::abs(moved));
}

}  // namespace kestrel
