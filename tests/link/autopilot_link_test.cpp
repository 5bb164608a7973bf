#include "kestrel/link/autopilot_link.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "kestrel/link/autopilot_model.hpp"

#include "loopback.hpp"
#include "samples.hpp"

namespace kestrel {
namespace {

/// The stand-in for an autopilot behind a real socket, in a thread of its own.
class ThreadedAutopilot {
 public:
  explicit ThreadedAutopilot(Autopilot which) : model_(rules(which)), vehicle_(high_up()) {
    thread_ = std::thread([this] { run(); });
  }
  ~ThreadedAutopilot() {
    ending_ = true;
    thread_.join();
  }
  ThreadedAutopilot(const ThreadedAutopilot&) = delete;
  ThreadedAutopilot& operator=(const ThreadedAutopilot&) = delete;

  Address address() const { return socket_.local(); }
  double north_m_s() const { return north_m_s_; }
  long setpoints() const { return setpoints_; }
  bool ends_at_zero() const { return last_is_zero_; }
  std::uint32_t mode() const { return mode_; }

 private:
  static AutopilotModelOptions rules(Autopilot which) {
    AutopilotModelOptions options;
    options.autopilot = which;
    return options;
  }
  static VehicleTruth high_up() {
    VehicleTruth truth;
    truth.position_ned_m.z() = -10;
    return truth;
  }

  void run() {
    // Its mode is to be told at once, not a second later: these tests are in a hurry.
    const auto often = mavlink::encode(interval_request(0, 50, {1, 1}), {255, 190, 0});
    model_.receive(often.bytes(), vehicle_.truth(), link_clock_s());
    std::optional<Address> peer;
    double last_s = link_clock_s();
    const auto answer = [&](const AutopilotModel::Frames& frames) {
      if (!peer) return;
      for (const auto& frame : frames) socket_.send_to(*peer, frame.bytes());
    };
    while (!ending_) {
      if (const auto datagram = socket_.receive(0.005)) {
        peer = datagram->from;
        look_at(datagram->bytes);
        answer(model_.receive(datagram->bytes, vehicle_.truth(), link_clock_s()));
      }
      const double now_s = link_clock_s();
      answer(model_.tick(vehicle_.truth(), now_s));
      vehicle_.move(model_.reference(), now_s - last_s);
      last_s = now_s;
      north_m_s_ = vehicle_.truth().velocity_ned_m_s.x();
      setpoints_ = model_.counts().setpoints;
      mode_ = model_.mode();
    }
  }

  void look_at(Bytes bytes) {
    for (const auto& packet : test::contents(test::copy(bytes)).packets) {
      if (const auto* s = std::get_if<mavlink::SetPositionTarget>(&packet.message)) {
        last_is_zero_ = velocity_of(*s)->vector().isZero(0);
      }
    }
  }

  UdpSocket socket_ = UdpSocket::bound_to({"127.0.0.1", 0});
  AutopilotModel model_;
  KinematicVehicle vehicle_;
  std::atomic<double> north_m_s_{0};
  std::atomic<long> setpoints_{0};
  std::atomic<bool> last_is_zero_{false};
  std::atomic<std::uint32_t> mode_{0};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// Calls `work` every 20 ms until it is so, at most kPatience_s.
bool until(
    const std::function<bool()>& is_so, const std::function<void()>& work = [] {}) {
  for (const double end_s = link_clock_s() + test::kPatience_s; link_clock_s() < end_s;) {
    if (is_so()) return true;
    work();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return is_so();
}

TEST(AutopilotLink, FliesAnAutopilotBehindASocketAndGivesItBack) {
  ThreadedAutopilot autopilot(Autopilot::ArduPilot);
  AutopilotOptions options;
  options.farewell_s = 0.1;
  constexpr double kOrigin_s = 100;  // where our clock is when the stamps begin
  AutopilotLink link(autopilot.address(), options, kOrigin_s);
  const auto stamp_s = [] { return link_clock_s() - kOrigin_s; };
  const auto frame = [&] { link.send({1, 0, 0, 0}, stamp_s()); };
  EXPECT_TRUE(until([&] { return autopilot.north_m_s() > 0.3; }, frame));
  EXPECT_EQ(link.status().control, HandshakeState::InControl);
  EXPECT_TRUE(until([&] { return link.attitude_at(stamp_s() - 0.02).has_value(); }, frame));
  EXPECT_TRUE(until([&] { return link.status().clock.has_value(); }, frame));
  const std::vector<SentSetpoint> sent = link.take_sent();
  ASSERT_GT(sent.size(), 3u);
  EXPECT_EQ(sent.back().state, StreamState::Fresh);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_GE(sent[i].sent_s, sent[i].capture_s);
    if (i > 0) {
      EXPECT_GT(sent[i].sent_s, sent[i - 1].sent_s);
    }
  }
  link.stop();
  EXPECT_TRUE(autopilot.ends_at_zero());
  const long setpoints = autopilot.setpoints();
  frame();
  std::this_thread::sleep_for(std::chrono::milliseconds(120));
  EXPECT_EQ(autopilot.setpoints(), setpoints);
  EXPECT_EQ(link.failures(), 0);
}

// The vision thread is stuck, the process lives: zeros, by the thread of the link.
TEST(AutopilotLink, ZerosWhenNothingIsDecidedAnyMore) {
  ThreadedAutopilot autopilot(Autopilot::ArduPilot);
  AutopilotOptions options;
  options.farewell_s = 0;
  options.stream.time_to_live_s = 0.1;
  options.stream.zero_after_s = 0.2;
  AutopilotLink link(autopilot.address(), options);
  double stamp_s = 0;
  const auto frame = [&] { link.send({1, 0, 0, 0}, stamp_s += 0.02); };
  ASSERT_TRUE(until([&] { return autopilot.north_m_s() > 0.2; }, frame));
  EXPECT_TRUE(until([&] { return autopilot.ends_at_zero(); }));
  // A frozen frame does not move it again.
  EXPECT_FALSE(link.attitude_at(stamp_s));  // the stamps are not of our clock
  for (int i = 0; i < 5; ++i) {
    link.send({1, 0, 0, 0}, stamp_s);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(autopilot.ends_at_zero());
  }
}

TEST(AutopilotLink, EndsSoonWhenNobodyListensAndNeverThrows) {
  const double start_s = link_clock_s();
  {
    AutopilotLink link(test::deaf_port());
    for (int i = 0; i < 10; ++i) link.send({1, 0, 0, 0}, i / 30.0);
    EXPECT_EQ(link.status().control, HandshakeState::Unseen);
  }
  EXPECT_LT(link_clock_s() - start_s, test::kPatience_s);
}

TEST(AutopilotLink, RefusesOptionsAndPlacesThatMakeNoSense) {
  AutopilotOptions options;
  options.rate_hz = 1;
  EXPECT_THROW(AutopilotLink({"127.0.0.1", 5005}, options), std::invalid_argument);
  EXPECT_THROW(AutopilotLink({"127.0.0.1", 0}), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
