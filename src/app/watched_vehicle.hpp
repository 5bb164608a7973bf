#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "kestrel/io/summary.hpp"
#include "kestrel/link/autopilot_link.hpp"
#include "kestrel/sim/vehicle.hpp"

namespace kestrel::app {

/// The address of "mavlink:udp:HOST:PORT". Throws std::invalid_argument for another text.
Address watched_address(const std::string& text);

/// Another vehicle, an autopilot in software for instance, that is looked at and never flown:
/// ATTITUDE and LOCAL_POSITION_NED give its motion. On the wire it is met by a camera (component
/// 100), which asks for both at 50 Hz and for the time.
class WatchedVehicle {
 public:
  /// origin_m: where its local frame begins, in World. Throws as UdpSocket::connected_to.
  WatchedVehicle(const Address& at, const Eigen::Vector3d& origin_m);

  /// Its motion at a time of link_clock_s(), between two reports or up to 0.1 s after the last;
  /// empty when nothing is known.
  std::optional<TrueMotion> motion_at(double clock_s) const;

  void report(Summary& summary);

 private:
  Eigen::Vector3d origin_m_;
  AutopilotLink link_;
};

}  // namespace kestrel::app
