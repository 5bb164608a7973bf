#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kestrel/io/summary.hpp"
#include "kestrel/link/autopilot_model.hpp"
#include "kestrel/link/kinematic_vehicle.hpp"
#include "kestrel/link/receiver_state.hpp"
#include "kestrel/link/socket.hpp"

#include "peers.hpp"

namespace kestrel::app {

/// A flight controller that is not there: the rules of an autopilot and a simple vehicle behind a
/// UDP socket. It talks to all who have talked to it.
class StandIn {
 public:
  /// Throws std::runtime_error when it cannot listen there.
  StandIn(const Address& at, const AutopilotModelOptions& rules);

  const Address& local() const { return socket_.local(); }

  /// Lets time pass up to timeout_s: the setpoints that have arrived, in their order, whether they
  /// were obeyed or not.
  std::vector<ReceivedCommand> poll(double timeout_s);

  const ReceiverCounts& counts() const { return received_.counts(); }

  /// What a human at the autopilot would have seen since the last call, one line each.
  std::vector<std::string> take_events();

  /// Adds what became of the setpoints, and where the vehicle is.
  void report(Summary& summary) const;

 private:
  void send(const AutopilotModel::Frames& frames);
  void send_to(const Address& peer, const AutopilotModel::Frames& frames);
  void fly();

  const double booted_s_;
  UdpSocket socket_;
  AutopilotModel model_;
  KinematicVehicle vehicle_;
  ReceiverState received_;
  Peers peers_;
  double flown_s_;
};

}  // namespace kestrel::app
