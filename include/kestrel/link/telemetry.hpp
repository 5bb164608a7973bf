#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include <Eigen/Core>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/link/battery.hpp"
#include "kestrel/link/clock_sync.hpp"
#include "kestrel/link/message.hpp"

namespace kestrel {

/// MAV_LANDED_STATE.
enum class Landed : std::uint8_t { Unknown, OnGround, InAir, TakingOff, Landing };

/// "unknown", "on the ground", "in the air", "taking off", "landing".
const char* name(Landed landed);

/// What the vehicle said of itself last.
struct VehicleState {
  mavlink::Heartbeat heartbeat;
  double heard_s = 0;  // our clock, of the heartbeat
  Landed landed = Landed::Unknown;
  std::optional<double> down_m;  // of LOCAL_POSITION_NED: minus the height over the local origin
  std::optional<Battery> battery{};  // of SYS_STATUS
};

/// Where the vehicle is and how it moves.
struct VehicleMotion {
  Eigen::Vector3d position_ned_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ned_m_s = Eigen::Vector3d::Zero();
};

struct TelemetryOptions {
  double history_s = 5;        // older samples are forgotten
  double extrapolate_s = 0.1;  // so far beyond the newest sample an answer is still given
  double widest_gap_s = 0.5;   // samples further apart have nothing between them

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

struct TelemetryCounts {
  long attitudes = 0;
  long positions = 0;
  long not_finite = 0;    // not kept
  long out_of_order = 0;  // not newer than the one before: not kept
  long misdated = 0;      // dated by their arrival: their own time could not be (of the kept ones)
  long restarts = 0;      // their clock went back: what was known before is forgotten
};

/// What a vehicle tells of itself, dated by our clock, and what lies between the samples. At most
/// kMaxSamples of each kind are kept.
class Telemetry {
 public:
  /// Throws as TelemetryOptions::check.
  explicit Telemetry(const TelemetryOptions& options = {});

  /// Takes ATTITUDE, LOCAL_POSITION_NED, HEARTBEAT, EXTENDED_SYS_STATE and SYS_STATUS; others are
  /// passed over.
  /// A sample is dated by its own time (time_boot_ms, which turns over after 49.7 days) where the
  /// vehicle's clock is known, else by its arrival: then it is older than it seems by the delay of
  /// the line. A time more than a second away from the arrival is not believed.
  void take(const mavlink::Message& message, double now_s,
            const std::optional<ClockEstimate>& clock);

  /// The attitude at a time of our clock: between two samples on the shortest turn between them
  /// (slerp), beyond the newest by its rates. Empty where nothing is known: before the oldest, in a
  /// gap wider than widest_gap_s, more than extrapolate_s after the newest.
  std::optional<Attitude> attitude_at(double stamp_s) const;

  /// The same for place and velocity, on the straight line between two samples; beyond the newest
  /// by its velocity.
  std::optional<VehicleMotion> motion_at(double stamp_s) const;

  /// Empty before the first heartbeat.
  const std::optional<VehicleState>& state() const { return state_; }

  const TelemetryCounts& counts() const { return counts_; }

  static constexpr std::size_t kMaxSamples = 2048;

 private:
  struct AttitudeSample {
    double stamp_s;
    Eigen::Matrix3d world_from_body;
    Eigen::Vector3d rates_rad_s;  // of the body
  };
  struct MotionSample {
    double stamp_s;
    VehicleMotion motion;
  };

  void take_attitude(const mavlink::AttitudeReport& report, double now_s,
                     const std::optional<ClockEstimate>& clock);
  void take_position(const mavlink::LocalPosition& report, double now_s,
                     const std::optional<ClockEstimate>& clock);
  double date(std::uint32_t time_boot_ms, double now_s, const std::optional<ClockEstimate>& clock);
  template <class Sample>
  bool keep(std::deque<Sample>& samples, const Sample& sample);

  TelemetryOptions options_;
  std::deque<AttitudeSample> attitudes_;
  std::deque<MotionSample> motions_;
  std::optional<VehicleState> state_;
  Landed landed_ = Landed::Unknown;
  std::optional<double> down_m_;
  std::optional<Battery> battery_;
  TelemetryCounts counts_;
};

}  // namespace kestrel
