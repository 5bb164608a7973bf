#pragma once

#include <cstdint>
#include <vector>

#include "kestrel/link/autopilot_adapter.hpp"
#include "kestrel/link/autopilot_model.hpp"

#include "samples.hpp"

namespace kestrel::test {

/// The adapter and the stand-in for an autopilot at the two ends of a line with a delay, in steps
/// of 10 ms; what is on the line can be looked at.
class AdapterFlight {
 public:
  AdapterFlight(const AutopilotOptions& options, const AutopilotModelOptions& rules)
      : adapter(options), model(rules), vehicle(start(rules)) {}

  /// Flies on; at 30 Hz a frame is captured and `command` decided for it, as long as `sees`.
  void fly(double seconds) {
    for (double end_s = now_s + seconds - 0.005; now_s < end_s;) step();
  }

  void step() {
    now_s += 0.01;
    if (sees && now_s >= next_frame_s_) {
      adapter.decide(command, now_s - 0.03, now_s);
      next_frame_s_ = now_s + 1 / 30.0;
    }
    if (beats) post(down_, model.tick(vehicle.truth(), now_s));
    vehicle.move(model.reference(), 0.01);
    post(up_, adapter.tick(now_s));
    for (const Buffer& datagram : arrived(up_)) {
      look_at(datagram);
      if (hears) post(down_, model.receive(view(datagram), vehicle.truth(), now_s));
    }
    for (const Buffer& datagram : arrived(down_)) {
      post(up_, adapter.receive(view(datagram), now_s));
    }
  }

  HandshakeState control() const { return adapter.status(now_s).control; }
  double speed() const { return vehicle.truth().velocity_ned_m_s.norm(); }

  template <class M>
  std::vector<M> sent() const {
    std::vector<M> all;
    for (const auto& packet : wire) {
      if (const auto* message = std::get_if<M>(&packet.message)) all.push_back(*message);
    }
    return all;
  }

  AutopilotAdapter adapter;
  AutopilotModel model;
  KinematicVehicle vehicle;
  VelocityCommand command{1, 0, 0, 0};
  double now_s = 1000;
  bool sees = true;
  bool beats = true;                  // the autopilot sends
  bool hears = true;                  // and receives
  std::vector<mavlink::Packet> wire;  // what the adapter sent, as it arrives
  std::vector<double> wire_s;

 private:
  static constexpr double kDelay_s = 0.02;
  struct Flying {
    double at_s;
    Buffer datagram;
  };

  static VehicleTruth start(const AutopilotModelOptions& rules) {
    VehicleTruth truth;
    truth.position_ned_m.z() = rules.starts_armed ? -10 : 0;
    return truth;
  }

  void post(std::vector<Flying>& line, const std::vector<mavlink::EncodedFrame>& frames) {
    for (const auto& frame : frames) line.push_back({now_s + kDelay_s, copy(frame.bytes())});
  }

  std::vector<Buffer> arrived(std::vector<Flying>& line) const {
    std::vector<Buffer> all;
    while (!line.empty() && line.front().at_s <= now_s) {
      all.push_back(line.front().datagram);
      line.erase(line.begin());
    }
    return all;
  }

  void look_at(const Buffer& datagram) {
    for (const auto& packet : contents(datagram).packets) {
      wire.push_back(packet);
      wire_s.push_back(now_s);
    }
  }

  std::vector<Flying> up_;
  std::vector<Flying> down_;
  double next_frame_s_ = 0;
};

}  // namespace kestrel::test
