// From the last fresh command to the first zero on the wire: the real `kestrel servo` through the
// real `kestrel switch`, and the vision process stopped, killed, or without frames.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "link/flight_listener.hpp"
#include "link/loopback.hpp"
#include "link/udp_relay.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;
using Heard = FlightListener::Heard;

constexpr int kFrames = 120;
constexpr int kRate_hz = 20;

class LastCommand : public testing::Test {
 protected:
  void SetUp() override {
    const RenderedSequence sequence = rendered_sequence(folder_ / "frames", kFrames);
    folder_.write("task.yaml",
                  "source: images:frames/%04d.png\nrate_hz: " + std::to_string(kRate_hz) +
                      "\ncamera: {intrinsics_px: [300, 300, 159.5, 119.5], size_px: [320, 240], "
                      "body_from_camera: {translation_m: [0, 0, 0], rpy_deg: [90, 0, 90]}}\n"
                      "target: {width_m: 1, height_m: 1, template_px: [" +
                      sequence.roi +
                      "]}\ngoal_camera_from_target: {translation_m: [0, 0, 2], rpy_deg: [0, 0, "
                      "0]}\nservo: {gain_per_s: 0.5}\n");
    folder_.write("switch.yaml", "links:\n  - {name: autopilot, role: flight, url: \"" +
                                     to_string(flight_.local()) +
                                     "\"}\n  - {name: companion, role: vision, url: "
                                     "\"udp-listen://" +
                                     to_string(vision_at_).substr(6) +
                                     "\"}\ndeadman_s: 0.5\nrate_hz: 20\nlog: {file: switch.log}\n");
    switch_ = start({"switch", "switch.yaml"});
  }

  std::unique_ptr<Program> start(const std::vector<std::string>& arguments) const {
    return std::make_unique<Program>(arguments, folder_.path());
  }

  void start_servo(const Address& sink) {
    servo_ = start({"servo", "task.yaml", "--no-video", "--real-time", "--output", "out", "--sink",
                    to_string(sink)});
  }

  /// When the last setpoint came that was not the one before it again, and no zero.
  double last_fresh_s(double before_s) const {
    double fresh_s = -1;
    float last = 0;
    for (const Heard& h : flight_.heard()) {
      if (h.time_s > before_s) break;
      if (!h.is_zero() && h.setpoint.vx_m_s != last) fresh_s = h.time_s;
      last = h.setpoint.vx_m_s;
    }
    return fresh_s;
  }

  /// Two seconds of what comes after a fault: a zero in time, and zeros without a gap from then on.
  void expect_stop(const char* what, double fault_s) const {
    std::this_thread::sleep_for(std::chrono::seconds(2));
    const double zero_s = flight_.lasting_zero_s(fault_s);
    const double fresh_s = last_fresh_s(zero_s);
    std::printf(
        "%s: first zero %.3f s after the fault, %.3f s after the last fresh setpoint on "
        "the wire (bound %.2f s)\n",
        what, zero_s - fault_s, zero_s - fresh_s, kZeroBound_s);
    EXPECT_LE(zero_s - fault_s, kZeroBound_s);
    double before_s = zero_s;
    for (const Heard& h : flight_.heard()) {
      if (h.time_s < zero_s) continue;
      EXPECT_TRUE(h.is_zero());
      EXPECT_LE(h.time_s - before_s, kSetpointPeriod_s + kScheduling_s);
      before_s = h.time_s;
    }
    EXPECT_LE(monotonic_s() - before_s, kSetpointPeriod_s + kScheduling_s);  // never silence
    EXPECT_EQ(flight_.refused(), 0);
  }

  TempFolder folder_;
  FlightListener flight_;
  Address vision_at_ = deaf_port();
  std::unique_ptr<Program> switch_;
  std::unique_ptr<Program> servo_;
};

TEST_F(LastCommand, AVisionProcessThatIsStoppedIsAZeroInTime) {
  start_servo(vision_at_);
  ASSERT_TRUE(flight_.moves(0));
  const double fault_s = monotonic_s();
  servo_->signal(SIGSTOP);
  expect_stop("SIGSTOP", fault_s);
  // Awake again, it may fly on: what it says is fresh.
  servo_->signal(SIGCONT);
}

TEST_F(LastCommand, AVisionProcessThatIsKilledIsAZeroInTime) {
  start_servo(vision_at_);
  ASSERT_TRUE(flight_.moves(0));
  const double fault_s = monotonic_s();
  servo_->signal(SIGKILL);
  expect_stop("SIGKILL", fault_s);
}

// The next picture is a pipe that nobody writes: the process lives, and waits for it.
TEST_F(LastCommand, FramesThatFreezeWhileTheProcessLivesAreAZeroInTime) {
  const fs::path frame = folder_ / "frames/0060.png";
  fs::remove(frame);
  ASSERT_EQ(mkfifo(frame.c_str(), 0600), 0);
  start_servo(vision_at_);
  ASSERT_TRUE(flight_.moves(0));
  // The fault is the picture that does not come: a period after the last one that did.
  std::this_thread::sleep_for(std::chrono::seconds(60 / kRate_hz + 2));
  const double fresh_s = last_fresh_s(1e18);
  ASSERT_GT(fresh_s, 0);
  expect_stop("frozen frames", fresh_s);
}

TEST_F(LastCommand, ACableThatIsPulledIsAZeroInTime) {
  RelayOptions line;
  line.to = vision_at_;
  UdpRelay relay(line);
  start_servo(relay.local());
  ASSERT_TRUE(flight_.moves(0));
  const double fault_s = monotonic_s();
  relay.block();
  expect_stop("cable pulled", fault_s);
}

TEST_F(LastCommand, ASwitchThatIsToldToEndSaysZeroFirst) {
  start_servo(vision_at_);
  ASSERT_TRUE(flight_.moves(0));
  const double fault_s = monotonic_s();
  switch_->signal(SIGTERM);
  const Outcome ended = switch_->wait(10);
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto heard = flight_.heard();
  ASSERT_FALSE(heard.empty());
  EXPECT_TRUE(heard.back().is_zero());
  const double zero_s = flight_.lasting_zero_s(fault_s);
  std::printf("SIGTERM to the switch: first zero after %.3f s\n", zero_s - fault_s);
  EXPECT_LE(zero_s - fault_s, kSetpointPeriod_s + kScheduling_s);
}

}  // namespace
}  // namespace kestrel::test
