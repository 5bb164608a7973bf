#include "watched_vehicle.hpp"

#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel::app {
namespace {

constexpr const char* kStart = "mavlink:udp:";
constexpr double kRateSpan_s = 0.02;  // over which the rates are taken: a period of the reports

AutopilotOptions observer() {
  AutopilotOptions options;
  options.part = AdapterPart::Observer;
  options.component_id = 100;  // MAV_COMP_ID_CAMERA
  options.attitude_hz = 50;
  options.position_hz = 50;
  return options;
}

Eigen::Matrix3d rotation(const Attitude& a) { return rotation_from_rpy(a.roll, a.pitch, a.yaw); }

}  // namespace

Address watched_address(const std::string& text) {
  if (text.rfind(kStart, 0) != 0) {
    throw std::invalid_argument("--vehicle '" + text +
                                "': write mavlink:udp:HOST:PORT, for instance "
                                "mavlink:udp:127.0.0.1:14580");
  }
  return parse_address("udp://" + text.substr(std::string(kStart).size()));
}

WatchedVehicle::WatchedVehicle(const Address& at, const Eigen::Vector3d& origin_m)
    : origin_m_(origin_m), link_(at, observer(), 0.0) {}

std::optional<TrueMotion> WatchedVehicle::motion_at(double clock_s) const {
  const auto attitude = link_.attitude_at_clock(clock_s);
  const auto place = link_.motion_at(clock_s);
  if (!attitude || !place) return std::nullopt;
  TrueMotion motion;
  motion.world_from_body = {rotation(*attitude), origin_m_ + place->position_ned_m};
  motion.velocity_m_s = place->velocity_ned_m_s;
  if (const auto before = link_.attitude_at_clock(clock_s - kRateSpan_s)) {
    motion.rate_rad_s =
        rotation_vector(rotation(*before).transpose() * rotation(*attitude)) / kRateSpan_s;
  }
  return motion;
}

void WatchedVehicle::report(Summary& summary) {
  link_.stop();
  const AdapterStatus s = link_.status();
  summary.begin_section("watched vehicle");
  summary.add("autopilot", s.autopilot ? name(*s.autopilot) : "none");
  summary.add("attitudes received", std::int64_t(s.telemetry.attitudes));
  summary.add("positions received", std::int64_t(s.telemetry.positions));
  if (s.clock) summary.add("clock known within", s.clock->error_s * 1e3, "ms");
}

}  // namespace kestrel::app
