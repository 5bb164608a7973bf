#include "link/flown_loop.hpp"

#include <cmath>
#include <optional>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/sim/world.hpp"

namespace kestrel::test {
namespace {

constexpr PeerId kFlight = 1;
constexpr PeerId kVision = 2;
constexpr double kFrame_s = 1 / 30.0;
constexpr double kFliesOn_s = 3;  // ArduPilot, GUIDED: the last velocity for so long

Task loop_task() {
  Task task{default_camera()};
  task.body_from_camera = forward_mount();
  task.target_width_m = 1;
  task.target_height_m = 1;
  task.goal.translation << 0, 0, 5;
  return task;
}

/// Decides for each frame and puts setpoints and heartbeats on its line.
class Companion {
 public:
  explicit Companion(const FlownLoopOptions& options)
      : options_(options), line_(options.to_switch, Carriage::Datagrams, options.name + " up") {}

  void look(const HelicopterState& state, double now_s) {
    while (next_frame_s_ <= now_s) {
      if (now_s < options_.frozen_from_s) decide_at(state, now_s);
      send(velocity_setpoint(command_, time_boot_ms(captured_s_), {}), now_s);
      next_frame_s_ += kFrame_s;
    }
    while (next_beat_s_ <= now_s) {
      send(mavlink::Heartbeat{}, now_s);
      next_beat_s_ += 1;
    }
  }

  ImpairedLine& line() { return line_; }
  double captured_s() const { return captured_s_; }

 private:
  void decide_at(const HelicopterState& state, double now_s) {
    const TargetPose seen = (pose(state) * task_.body_from_camera).inverse() * world_from_wall();
    std::vector<Feature> corners;
    if (now_s < options_.blind_from_s) corners = features(seen, target_corners(task_));
    const Decision decision = decide(corners, attitude(state), now_s, memory_, task_);
    memory_ = decision.next;
    command_ = decision.command;
    captured_s_ = now_s;
  }

  void send(const mavlink::Message& message, double now_s) {
    const auto frame = mavlink::encode(message, {1, 191, sequence_++});
    const bool cut = now_s >= options_.cut_from_s && now_s < options_.cut_until_s;
    if (!cut) line_.send(frame.bytes(), now_s);
  }

  const FlownLoopOptions& options_;
  Task task_ = loop_task();
  DecisionState memory_;
  VelocityCommand command_;
  double captured_s_ = 0;
  double next_frame_s_ = 0;
  double next_beat_s_ = 0;
  std::uint8_t sequence_ = 0;
  ImpairedLine line_;
};

/// Obeys what reaches it, too long.
class Vehicle {
 public:
  void take(Bytes datagram, double now_s, std::vector<ObeyedCommand>& obeyed) {
    for (const ReceivedCommand& got : receiver_.take(datagram, {"127.0.0.1", 1})) {
      command_ = got.command;
      commanded_s_ = now_s;
      const ReceiverCounts& counts = receiver_.counts();
      obeyed.push_back({now_s, got.command, counts.not_finite + counts.unsupported});
    }
  }

  void fly(double now_s) {
    const bool silent = now_s - commanded_s_ > kFliesOn_s;
    state_ = advanced(state_, silent ? VelocityCommand::hover() : command_, kLoopStep_s);
  }

  mavlink::EncodedFrame heartbeat() {
    mavlink::Heartbeat beat;
    beat.type = 4;       // MAV_TYPE_HELICOPTER
    beat.autopilot = 3;  // MAV_AUTOPILOT_ARDUPILOTMEGA
    return mavlink::encode(beat, {1, 1, sequence_++});
  }

  const HelicopterState& state() const { return state_; }
  const ReceiverCounts& counts() const { return receiver_.counts(); }

 private:
  HelicopterState state_ = WorldOptions::default_start();
  ReceiverState receiver_;
  VelocityCommand command_;
  double commanded_s_ = 0;
  std::uint8_t sequence_ = 0;
};

}  // namespace

SwitchOptions loop_switch() {
  SwitchOptions options;
  options.links.resize(2);
  options.links[0].name = "autopilot";
  options.links[0].role = LinkRole::Flight;
  options.links[1].name = "companion";
  options.links[1].role = LinkRole::Vision;
  options.envelope.speed = VelocityCommand::from_vector(0.5 * CommandLimits{}.speed.vector());
  return options;
}

FlownLoop flown_loop(const FlownLoopOptions& options) {
  FlownLoop loop;
  Companion companion(options);
  Vehicle vehicle;
  ImpairedLine to_vehicle(options.to_vehicle, Carriage::Datagrams, options.name + " down");
  SwitchCore core(options.switching);
  core.connect(kFlight, 0, {"127.0.0.1", 1}, {0, 0});
  core.connect(kVision, 1, {"127.0.0.1", 2}, {0, 0});
  const auto pass = [&](const std::vector<Delivery>& deliveries, double now_s) {
    for (const Delivery& d : deliveries) {
      if (d.to == kFlight) to_vehicle.send(d.bytes, now_s);
    }
  };
  double next_beat_s = 0;
  for (long k = 0; double(k) * kLoopStep_s < options.duration_s; ++k) {
    const double now_s = double(k) * kLoopStep_s;
    companion.look(vehicle.state(), now_s);
    if (now_s < options.cut_from_s) loop.last_fresh_s = companion.captured_s();
    for (const auto& piece : companion.line().arrived(now_s)) {
      pass(core.receive(kVision, {piece.data(), piece.size()}, {now_s, now_s}), now_s);
    }
    for (; next_beat_s <= now_s; next_beat_s += 1) {
      core.receive(kFlight, vehicle.heartbeat().bytes(), {now_s, now_s});
    }
    pass(core.tick({now_s, now_s}), now_s);
    for (const auto& piece : to_vehicle.arrived(now_s)) {
      vehicle.take({piece.data(), piece.size()}, now_s, loop.obeyed);
    }
    vehicle.fly(now_s);
    loop.states.push_back(vehicle.state());
  }
  loop.status = core.status({options.duration_s, options.duration_s});
  loop.to_switch = companion.line().counts();
  loop.to_vehicle = to_vehicle.counts();
  loop.received = vehicle.counts();
  return loop;
}

double goal_error_m(const HelicopterState& state) {
  return (state.position_m - Eigen::Vector3d(-5, 0, 0)).norm();
}

}  // namespace kestrel::test
