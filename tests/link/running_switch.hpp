#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "kestrel/link/switch_loop.hpp"

#include "link/relay_socket.hpp"

namespace kestrel::test {

/// A switch with its sockets on loopback: 0 the vehicle, 1 a companion over UDP, 2 ground stations
/// over TCP, 3 a script over UDP.
inline SwitchLoopOptions loopback_switch(const Address& flight) {
  SwitchLoopOptions options;
  const auto add = [&options](const char* name, LinkRole role, const std::string& place) {
    SwitchLink link;
    link.name = name;
    link.role = role;
    options.core.links.push_back(link);
    options.places.push_back({parse_link_place(place), {}});
  };
  add("autopilot", LinkRole::Flight, to_string(flight));
  add("companion", LinkRole::Vision, "udp-listen://127.0.0.1:0");
  add("ground", LinkRole::Ground, "tcp-listen://127.0.0.1:0");
  add("script", LinkRole::Script, "udp-listen://127.0.0.1:0");
  return options;
}

/// The same with ground stations over UDP, and so quick that tests are: heartbeats each 0.05 s, a
/// dead man of 0.15 s.
inline SwitchLoopOptions quick_switch(const Address& flight) {
  SwitchLoopOptions options = loopback_switch(flight);
  options.core.links[2].transport = Transport::Datagram;
  options.places[2].place = parse_link_place("udp-listen://127.0.0.1:0");
  options.core.heartbeat_period_s = 0.05;
  options.core.missed_heartbeats = 100;
  options.core.rate_hz = 50;
  options.core.deadman_s = 0.15;
  return options;
}

/// The switch on a thread of its own.
class RunningSwitch {
 public:
  explicit RunningSwitch(const SwitchLoopOptions& options)
      : loop_(options, [] {
          return SwitchTime{monotonic_s(), 1.8e9 + monotonic_s()};
        }) {
    thread_ = std::thread([this] {
      while (!done_) {
        loop_.turn();
        events_ += long(loop_.take_events().size());
      }
      loop_.shutdown();
    });
  }
  ~RunningSwitch() { end(); }
  RunningSwitch(const RunningSwitch&) = delete;
  RunningSwitch& operator=(const RunningSwitch&) = delete;

  /// Tells it to end, and waits for that.
  void end() {
    done_ = true;
    if (thread_.joinable()) thread_.join();
  }

  Address address(std::size_t link) const { return loop_.address(link); }
  /// After its end.
  SwitchReport report() const { return loop_.report(); }
  long events() const { return events_; }

 private:
  SwitchLoop loop_;
  std::atomic<bool> done_ = false;
  std::atomic<long> events_ = 0;
  std::thread thread_;
};

}  // namespace kestrel::test
