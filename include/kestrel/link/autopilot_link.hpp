#pragma once

#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/autopilot_adapter.hpp"
#include "kestrel/link/socket.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// Seconds of the machine's monotonic clock: the clock of AutopilotLink and of what it sends.
double link_clock_s();

/// A setpoint that left, and what it rested on. Times are of link_clock_s().
struct SentSetpoint {
  double sent_s = 0;     // when the network had it
  double capture_s = 0;  // of its frame; of zeros that rest on none: when they were decided
  StreamState state = StreamState::Waiting;
};

/// A sink that flies a real autopilot: an AutopilotAdapter with a socket, a clock and a thread of
/// its own, so that the setpoints keep their rate whatever the frames do. The heartbeat follows the
/// frames, not the thread: it stops when nothing new is decided.
class AutopilotLink final : public CommandSink {
 public:
  /// Starts to talk to the address. stamp_origin_s: what link_clock_s() was when the stamps of the
  /// frames were zero; then the age of a command counts from the capture of its frame. Without it
  /// (a recording, a simulation) a frame counts as captured when its command arrives, if its stamp
  /// is newer than the last. Throws as UdpSocket::connected_to and AutopilotOptions::check.
  explicit AutopilotLink(const Address& to, const AutopilotOptions& options = {},
                         std::optional<double> stamp_origin_s = std::nullopt);

  /// Gives control back, if stop() has not.
  ~AutopilotLink() override;
  AutopilotLink(const AutopilotLink&) = delete;
  AutopilotLink& operator=(const AutopilotLink&) = delete;

  /// Leaves the command for the next setpoint. Waits for nothing but the few microseconds in which
  /// the thread looks at what there is; never for the network. For one thread.
  void send(const VelocityCommand& command, double stamp_s) noexcept override;

  /// Datagrams with a setpoint that the network did not take, or sent where nobody listens.
  long failures() const override { return failures_; }

  /// A human asks for control, or for the ground.
  void request_control();
  void request_landing();

  /// Zeros, then control is given back; waits until that is done, at most some seconds. Nothing is
  /// sent afterwards.
  void stop() noexcept;

  /// The vehicle's attitude when the frame with this stamp was captured; empty when telemetry does
  /// not tell, and without a stamp_origin_s.
  std::optional<Attitude> attitude_at(double stamp_s) const;

  /// Place and velocity at a time of link_clock_s().
  std::optional<VehicleMotion> motion_at(double clock_s) const;
  std::optional<Attitude> attitude_at_clock(double clock_s) const;

  AdapterStatus status() const;

  /// The setpoints that the network took since the last call; the oldest are forgotten when nobody
  /// asks for long.
  std::vector<SentSetpoint> take_sent();

  /// This end.
  const Address& local() const { return socket_.local(); }

 private:
  void run() noexcept;
  void run_until_released();
  void listen(double until_s);
  bool transmit(const AutopilotAdapter::Frames& frames) noexcept;
  void note_sent(const StreamSetpoint& setpoint);
  double capture_s(double stamp_s, double now_s);

  const double period_s_;
  const std::optional<double> stamp_origin_s_;
  UdpSocket socket_;  // of the thread
  // Of the caller of send:
  std::optional<double> last_stamp_s_;
  double last_capture_s_ = 0;

  mutable std::mutex mutex_;  // never held while the network is asked for anything
  AutopilotAdapter adapter_;
  std::deque<SentSetpoint> sent_;
  std::atomic<long> failures_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace kestrel
