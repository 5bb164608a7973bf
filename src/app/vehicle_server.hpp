#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "kestrel/link/socket.hpp"

#include "flying_vehicle.hpp"
#include "peers.hpp"

namespace kestrel::app {

/// The built-in helicopter by the clock: a FlyingVehicle with a socket and a thread of its own,
/// which talks MAVLink to all who have talked to it. Times are of link_clock_s().
class VehicleServer {
 public:
  /// rules.boot_s and the start of the flight are now. Throws std::runtime_error when it cannot
  /// listen there.
  VehicleServer(const Address& at, FlyingVehicleOptions options);
  ~VehicleServer();
  VehicleServer(const VehicleServer&) = delete;
  VehicleServer& operator=(const VehicleServer&) = delete;

  const Address& local() const { return socket_.local(); }

  /// As FlyingVehicle::motion_at; a time not flown yet is flown first.
  std::optional<TrueMotion> motion_at(double clock_s);

  /// What a human at the autopilot would have seen since the last call, one line each.
  std::vector<std::string> take_events();

  void report(Summary& summary) const;

 private:
  void run() noexcept;
  void turn();
  void send(const FlyingVehicle::Frames& frames);

  const double booted_s_;
  UdpSocket socket_;  // of the thread, but for its address
  Peers peers_;       // of the thread
  mutable std::mutex mutex_;
  FlyingVehicle vehicle_;
  FlyingVehicle::Frames untold_;  // what it told while somebody else let it fly
  double flown_to_s_;
  double latest_s_ = 0;  // the longest that the flight was behind the clock
  std::string broken_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace kestrel::app
