#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/socket.hpp"

#include "link/relay_socket.hpp"

namespace kestrel::test {

// The bound of every safety test on the wire: deadman, a period of the setpoints, and the time
// until a process that is ready to run does run. With ten others on each core and slices of 3 ms
// (CFS) that is some 30 ms, for each of four that take part: the sender, the switch, the kernel's
// softirqs, and the test, which reads the clock. Twice that.
constexpr double kDeadman_s = 0.5;
constexpr double kSetpointPeriod_s = 0.05;
constexpr double kScheduling_s = 0.25;
constexpr double kZeroBound_s = kDeadman_s + kSetpointPeriod_s + kScheduling_s;

/// Hears what goes to flight control, on the wire: a thread that reads and looks at the clock.
class FlightListener {
 public:
  struct Heard {
    double time_s = 0;  // monotonic_s() when it was read
    mavlink::SetPositionTarget setpoint;

    bool is_zero() const {
      return setpoint.vx_m_s == 0 && setpoint.vy_m_s == 0 && setpoint.vz_m_s == 0 &&
             setpoint.yaw_rate_rad_s == 0;
    }
  };

  FlightListener() : socket_(UdpSocket::bound_to({"127.0.0.1", 0})), local_(socket_.local()) {
    thread_ = std::thread([this] {
      while (!done_) listen();
    });
  }
  ~FlightListener() {
    done_ = true;
    thread_.join();
  }
  FlightListener(const FlightListener&) = delete;
  FlightListener& operator=(const FlightListener&) = delete;

  const Address& local() const { return local_; }

  std::vector<Heard> heard() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }
  /// Waits until it has been told to move ten times since a moment; false after 30 s.
  bool moves(double since_s) const {
    const double end_s = monotonic_s() + 30;
    for (; monotonic_s() < end_s; std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
      const auto all = heard();
      const auto is_move = [=](const Heard& h) { return !h.is_zero() && h.time_s > since_s; };
      if (std::count_if(all.begin(), all.end(), is_move) >= 10) return true;
    }
    return false;
  }

  /// When it first heard an exact zero after a moment, with nothing but zeros after it; 1e18 for
  /// never.
  double lasting_zero_s(double after_s) const {
    double zero_s = 1e18;
    for (const Heard& h : heard()) {
      if (h.time_s < after_s) continue;
      zero_s = h.is_zero() ? std::min(zero_s, h.time_s) : 1e18;
    }
    return zero_s;
  }

  /// Frames that were no setpoint, and bytes that were no frame.
  long others() const { return others_; }
  long refused() const { return refused_; }

 private:
  void listen() {
    const auto datagram = socket_.receive(0.02);
    const double now_s = monotonic_s();
    if (!datagram) return;
    for (Bytes rest = datagram->bytes; rest.size > 0;) {
      const mavlink::Decoded decoded = mavlink::decode(rest);
      rest = rest.after(decoded.size);
      const auto* packet = std::get_if<mavlink::Packet>(&decoded.content);
      if (packet == nullptr) {
        ++refused_;
      } else if (const auto* s = std::get_if<mavlink::SetPositionTarget>(&packet->message)) {
        const std::lock_guard lock(mutex_);
        heard_.push_back({now_s, *s});
      } else {
        ++others_;
      }
    }
  }

  UdpSocket socket_;
  Address local_;
  mutable std::mutex mutex_;
  std::vector<Heard> heard_;
  std::atomic<long> others_ = 0;
  std::atomic<long> refused_ = 0;
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

}  // namespace kestrel::test
