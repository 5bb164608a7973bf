#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include "kestrel/link/command_receiver.hpp"

namespace kestrel::test {

/// Seconds of the machine's monotonic clock.
inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Hears the commands that go out, on a port and a thread of its own.
class WireListener {
 public:
  WireListener() : thread_([this] { listen(); }) {}
  ~WireListener() {
    done_ = true;
    thread_.join();
  }
  WireListener(const WireListener&) = delete;
  WireListener& operator=(const WireListener&) = delete;

  std::string url() const { return to_string(receiver_.local()); }
  long heard() const { return heard_; }
  /// Of the last command: its length, m/s and rad/s together, and its time on the wire.
  double speed() const { return speed_; }
  double stamp_s() const { return stamp_s_; }
  VelocityCommand command() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return command_;
  }
  /// The largest speed since it was asked last.
  double fastest() { return fastest_.exchange(0); }
  /// When the first zero after something else was heard, now_s().
  double stopped_s() const { return stopped_s_; }

 private:
  void listen() {
    while (!done_) {
      for (const ReceivedCommand& received : receiver_.poll(0.02)) take(received);
    }
  }
  void take(const ReceivedCommand& received) {
    const double speed = received.command.vector().norm();
    if (speed == 0 && speed_ > 0) stopped_s_ = now_s();
    speed_ = speed;
    stamp_s_ = double(received.time_boot_ms) / 1e3;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      command_ = received.command;
    }
    if (speed > fastest_) fastest_ = speed;
    ++heard_;
  }

  CommandReceiver receiver_{Address{"127.0.0.1", 0}};
  std::atomic<bool> done_{false};
  std::atomic<long> heard_{0};
  std::atomic<double> speed_{0};
  std::atomic<double> stamp_s_{0};
  std::atomic<double> fastest_{0};
  std::atomic<double> stopped_s_{0};
  mutable std::mutex mutex_;
  VelocityCommand command_;
  std::thread thread_;
};

}  // namespace kestrel::test
