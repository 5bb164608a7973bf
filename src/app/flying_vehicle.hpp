#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/io/summary.hpp"
#include "kestrel/link/autopilot_model.hpp"
#include "kestrel/sim/vehicle.hpp"

namespace kestrel::app {

/// The motion a little later (or earlier), its velocity and rates kept.
TrueMotion carried_on(const TrueMotion& motion, double ahead_s);

struct FlyingVehicleOptions {
  AutopilotModelOptions rules;  // boot_s is when the flight starts
  VehicleOptions vehicle;
  HelicopterState start;  // in World
  double ground_down_m = 6;
  std::uint64_t seed = 1;
};

/// The built-in helicopter behind the rules of an autopilot. No socket, no clock: times are given,
/// and it flies in steps of its own period from one to the next. Its local frame begins on the
/// ground below the start; there it stands while it is not asked to climb, and there it may land.
class FlyingVehicle {
 public:
  using Frames = AutopilotModel::Frames;

  explicit FlyingVehicle(const FlyingVehicleOptions& options);

  /// What it answers to a datagram.
  Frames receive(Bytes datagram, double now_s);

  /// Flies until now; what it tells meanwhile.
  Frames fly_until(double now_s);

  /// The truth at a time, in World: of the step before, carried on. Empty before the flight and
  /// for what is longer ago than two seconds.
  std::optional<TrueMotion> motion_at(double time_s) const;

  /// What a human at the autopilot would have seen since the last call.
  std::vector<AutopilotEvent> take_events() { return model_.take_events(); }

  /// Adds what became of the setpoints.
  void report(Summary& summary) const;

 private:
  struct Sample {
    double at_s = 0;
    TrueMotion motion;
  };

  VehicleTruth told() const;
  VelocityCommand command() const;
  void step();
  void meet_the_ground();
  bool is_grounded() const;
  void keep();

  FlyingVehicleOptions options_;
  AutopilotModel model_;
  Vehicle vehicle_;
  Eigen::Vector3d origin_m_;  // of the local frame, in World
  double period_s_;
  double flown_s_;
  bool stands_ = false;
  double hardest_touch_m_s_ = 0;
  std::deque<Sample> past_;
};

}  // namespace kestrel::app
