// What the switch costs a setpoint: its way over loopback through the switch, beside a datagram
// sent straight to the receiver in the same run; and what is left of it under load. Read the
// differences: the times themselves are the machine's.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/real_time.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/socket.hpp"
#include "kestrel/link/switch_loop.hpp"

namespace kestrel {
namespace {

constexpr int kPriority = 10;    // of who sends, switches and receives, where the kernel permits it
constexpr double kLost_s = 0.5;  // what takes longer counts as lost
constexpr int kCodes = 1000;     // setpoints told apart by their speed
constexpr double kStep_m_s = 1e-3;
constexpr double kLeast_m_s = 0.1;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
SwitchTime clock_now() { return {now_s(), 1.8e9}; }

struct Moment {
  int code = 0;
  double at_s = 0;
};

/// A thread that notes when each setpoint arrives.
class Receiver {
 public:
  explicit Receiver(int priority = 0)
      : socket_(UdpSocket::bound_to({"127.0.0.1", 0})), address_(socket_.local()) {
    arrivals_.reserve(1 << 20);
    thread_ = std::thread([this, priority] {
      run_in_real_time(priority);
      run();
    });
  }
  ~Receiver() { stop(); }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  const Address& address() const { return address_; }
  const std::vector<Moment>& stop() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
    return arrivals_;
  }

 private:
  void run() {
    while (!ends_) {
      const std::optional<Datagram> datagram = socket_.receive(0.05);
      const double at_s = now_s();
      if (!datagram || arrivals_.size() == arrivals_.capacity()) continue;
      const mavlink::Decoded decoded = mavlink::decode(datagram->bytes);
      const auto* packet = std::get_if<mavlink::Packet>(&decoded.content);
      if (packet == nullptr) continue;
      const auto* setpoint = std::get_if<mavlink::SetPositionTarget>(&packet->message);
      if (setpoint == nullptr) continue;
      arrivals_.push_back(
          {int(std::lround((double(setpoint->vx_m_s) - kLeast_m_s) / kStep_m_s)), at_s});
    }
  }

  UdpSocket socket_;
  Address address_;
  std::vector<Moment> arrivals_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// Setpoints from a companion computer at a rate, each with its code; and a heartbeat a second.
std::vector<Moment> send_setpoints(const Address& to, double rate_hz, double duration_s) {
  UdpSocket socket = UdpSocket::connected_to(to);
  // The first setpoint of a source only claims control.
  socket.send(
      mavlink::encode(velocity_setpoint({}, time_boot_ms(now_s()), {}), {1, 191, 255}).bytes());
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::vector<Moment> sent;
  std::uint8_t sequence = 0;
  const double start_s = now_s();
  double next_beat_s = start_s;
  for (double due_s = start_s; due_s < start_s + duration_s; due_s += 1 / rate_hz) {
    while (now_s() < due_s) {  // sleeping is too coarse for 0.1 ms
      if (due_s - now_s() > 3e-4) std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    if (now_s() >= next_beat_s) {
      socket.send(mavlink::encode(mavlink::Heartbeat{}, {1, 191, sequence++}).bytes());
      next_beat_s += 1;
    }
    VelocityCommand command;
    const int code = int(sent.size()) % kCodes;
    command.forward_m_s = kLeast_m_s + code * kStep_m_s;
    const auto frame = mavlink::encode(velocity_setpoint(command, time_boot_ms(now_s()), {}),
                                       {1, 191, sequence++});
    sent.push_back({code, now_s()});
    socket.send(frame.bytes());
  }
  return sent;
}

/// Delays of those that arrived, sorted, in microseconds.
std::vector<double> delays_us(const std::vector<Moment>& sent, const std::vector<Moment>& arrived) {
  std::vector<double> delays;
  std::size_t from = 0;
  for (const Moment& each : sent) {
    while (from < arrived.size() && arrived[from].at_s < each.at_s) ++from;
    for (std::size_t i = from; i < arrived.size() && arrived[i].at_s < each.at_s + kLost_s; ++i) {
      if (arrived[i].code != each.code) continue;
      delays.push_back((arrived[i].at_s - each.at_s) * 1e6);
      break;
    }
  }
  std::sort(delays.begin(), delays.end());
  return delays;
}

double quantile(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) return NAN;
  return sorted[std::min(sorted.size() - 1, std::size_t(q * double(sorted.size())))];
}

void print_row(const std::string& what, std::size_t sent, const std::vector<double>& delays) {
  std::printf("%-44s %7zu %6zu %9.1f %9.1f %9.1f\n", what.c_str(), sent, sent - delays.size(),
              quantile(delays, 0.5), quantile(delays, 0.99), quantile(delays, 1));
}

/// A switch in a thread: eyes on link 1, a script on link 2.
class RunningSwitch {
 public:
  explicit RunningSwitch(const Address& autopilot, int priority = 0)
      : loop_(options(autopilot), clock_now) {
    thread_ = std::thread([this, priority] {
      run_in_real_time(priority);
      while (!ends_) loop_.turn();
    });
  }
  ~RunningSwitch() { stop(); }
  RunningSwitch(const RunningSwitch&) = delete;
  RunningSwitch& operator=(const RunningSwitch&) = delete;

  /// What became of the setpoints that did not pass, in words.
  void print_refusals() {
    stop();
    for (const PeerStatus& peer : loop_.report().core.peers) {
      if (peer.link == 1) {
        std::printf("  read %llu frames, accepted %llu setpoints, passed on %llu frames\n",
                    static_cast<unsigned long long>(peer.counters.frames),
                    static_cast<unsigned long long>(peer.counters.setpoints),
                    static_cast<unsigned long long>(peer.counters.forwarded));
      }
      for (std::size_t i = 0; peer.link == 1 && i < kRefusedReasons; ++i) {
        if (peer.counters.refused[i] == 0) continue;
        std::printf("  refused as %s: %llu\n", name(Refused(i)),
                    static_cast<unsigned long long>(peer.counters.refused[i]));
      }
    }
    std::printf("  longest turn of the switch: %.1f us\n", 1e6 * loop_.report().longest_turn_s);
  }

  Address eyes() const { return loop_.address(1); }
  Address script() const { return loop_.address(2); }

 private:
  void stop() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
  }
  static SwitchLoopOptions options(const Address& autopilot) {
    SwitchLoopOptions options;
    options.core.links.resize(3);
    const LinkRole roles[] = {LinkRole::Flight, LinkRole::Vision, LinkRole::Script};
    for (std::size_t i = 0; i < 3; ++i) {
      options.core.links[i].name = name(roles[i]);
      options.core.links[i].role = roles[i];
      options.places.push_back({{LinkKind::UdpServer, {"127.0.0.1", 0}}, {}});
    }
    options.core.links[1].flow = {20000, 20000};
    options.places[0].place = {LinkKind::UdpClient, autopilot};
    const double any = 1e9;  // the speeds are codes here
    options.core.envelope.acceleration = {any, any, any, any};
    return options;
  }

  SwitchLoop loop_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// Intact heartbeats, as fast as the machine sends them.
class Flood {
 public:
  explicit Flood(const Address& to)
      : thread_([this, to] {
          UdpSocket socket = UdpSocket::connected_to(to);
          for (std::uint8_t i = 0; !ends_; ++i, ++sent_) {
            socket.send(mavlink::encode(mavlink::Heartbeat{}, {9, 9, i}).bytes());
          }
        }) {}
  ~Flood() {
    ends_ = true;
    thread_.join();
  }
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;
  long sent() const { return sent_; }

 private:
  std::atomic<bool> ends_{false};
  std::atomic<long> sent_{0};
  std::thread thread_;
};

/// What the function returns, run in a thread of its own before the others.
template <class Function>
auto in_real_time(const Function& function) {
  return std::async(std::launch::async,
                    [&] {
                      run_in_real_time(kPriority);
                      return function();
                    })
      .get();
}

std::vector<double> direct(double rate_hz, double duration_s) {
  Receiver receiver;
  const auto sent = send_setpoints(receiver.address(), rate_hz, duration_s);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  auto delays = delays_us(sent, receiver.stop());
  print_row("direct, " + std::to_string(int(rate_hz)) + " /s", sent.size(), delays);
  return delays;
}

std::vector<double> switched(double rate_hz, double duration_s) {
  Receiver receiver;
  RunningSwitch running(receiver.address());
  const auto sent = send_setpoints(running.eyes(), rate_hz, duration_s);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  auto delays = delays_us(sent, receiver.stop());
  print_row("through the switch, " + std::to_string(int(rate_hz)) + " /s", sent.size(), delays);
  running.print_refusals();
  return delays;
}

/// The same noise, to a socket that nobody reads: what the machine leaves to a direct datagram.
void direct_beside_noise(double rate_hz, double duration_s) {
  Receiver receiver(kPriority);
  const UdpSocket nobody = UdpSocket::bound_to({"127.0.0.1", 0});
  const Flood flood(nobody.local());
  const auto sent =
      in_real_time([&] { return send_setpoints(receiver.address(), rate_hz, duration_s); });
  const long noise = flood.sent();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  print_row("direct, beside " + std::to_string(long(double(noise) / duration_s)) + " /s of noise",
            sent.size(), delays_us(sent, receiver.stop()));
}

void flooded(double rate_hz, double duration_s) {
  Receiver receiver(kPriority);
  RunningSwitch running(receiver.address(), kPriority);
  const Flood flood(running.script());
  const auto sent =
      in_real_time([&] { return send_setpoints(running.eyes(), rate_hz, duration_s); });
  const long noise = flood.sent();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const auto delays = delays_us(sent, receiver.stop());
  print_row("the same under " + std::to_string(long(double(noise) / duration_s)) + " /s of another",
            sent.size(), delays);
  running.print_refusals();
}

}  // namespace
}  // namespace kestrel

int main() {
  const bool given = std::async(std::launch::async, [] {
                       return kestrel::run_in_real_time(kestrel::kPriority);
                     }).get();
  std::printf("under noise sender, switch and receiver run %s\n",
              given ? "in real time (SCHED_RR), noise does not" : "as all others do");
  std::printf("%-44s %7s %6s %9s %9s %9s\n", "setpoints over loopback", "sent", "lost", "median us",
              "p99 us", "worst us");
  const auto plain = kestrel::direct(1000, 5);
  const auto through = kestrel::switched(1000, 5);
  std::printf("%-44s %7s %6s %9.1f %9.1f\n", "added", "", "",
              kestrel::quantile(through, 0.5) - kestrel::quantile(plain, 0.5),
              kestrel::quantile(through, 0.99) - kestrel::quantile(plain, 0.99));
  kestrel::direct(10000, 3);
  kestrel::switched(10000, 3);
  kestrel::direct_beside_noise(1000, 5);
  kestrel::flooded(1000, 5);
  return 0;
}
