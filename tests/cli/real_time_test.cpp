// Separate processes by the clock: the simulated vehicle and camera, the servo, the switch, over
// real sockets of loopback. What is asserted is where the flight goes, never how long it takes.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/link/socket.hpp"

#include "cli/program.hpp"
#include "link/udp_relay.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

using testing::HasSubstr;

constexpr double kPatience_s = 45;  // a flight takes about ten seconds where nobody else works
constexpr double kDegree = M_PI / 180;

// The pass criterion of the missions is 0.10 m and 2 degrees in lockstep; here frames are lost to
// whatever else the machine does, and each late command moves the vehicle by some centimetres.
constexpr double kArrived_m = 0.15;
constexpr double kArrivedHeading_rad = 3 * kDegree;
// The loops stop within their time constants of half a second: after three seconds there is 0.3 %
// of at most 2 m/s left, and what a last command before the zeros did.
constexpr double kHover_m_s = 0.1;

/// A task whose camera looks north from a helicopter with about this heading (degrees): from the
/// nose of one that looks north itself, from the left side of one that looks east. A heading that
/// is taken the wrong way round somewhere flies the latter into the wall.
std::string task(int heading_deg, const std::string& helicopter) {
  const std::string mount = heading_deg > 45 ? "[90, 0, 0]" : "[90, 0, 90]";
  return "source: simulation\n"
         "sink: none\n"
         "camera:\n"
         "  intrinsics_px: [300, 300, 159.5, 119.5]\n"
         "  size_px: [320, 240]\n"
         "  body_from_camera: {translation_m: [0, 0, 0], rpy_deg: " +
         mount +
         "}\n"
         "target: {width_m: 2.0, height_m: 1.5}\n"
         "goal_camera_from_target: {translation_m: [0, 0, 4.0], rpy_deg: [0, 0, 0]}\n"
         "servo: {interaction: mean, gain_per_s: 0.8, freedom: four}\n"
         "limits: {speed: {forward_m_s: 1, right_m_s: 0.8, down_m_s: 0.6}}\n"
         "simulation:\n"
         "  start: {position_ned_m: [-5, 0.4, 0.2], heading_deg: " +
         std::to_string(heading_deg) + "}\n  rate_hz: 20\n  helicopter: {model: " + helicopter +
         "}\n";
}

// Of the three limits at once, as a vector, and what the loops overshoot a step by.
const double kFastest_m_s = 1.1 * std::sqrt(1 + 0.8 * 0.8 + 0.6 * 0.6);

/// A row of truth.csv, by column.
using Row = std::map<std::string, double>;

void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

Address free_place() { return UdpSocket::bound_to({"127.0.0.1", 0}).local(); }

class RealTime : public testing::Test {
 protected:
  std::unique_ptr<Program> start(const std::vector<std::string>& words) const {
    return std::make_unique<Program>(words, folder_.path());
  }

  void start_switch() {
    folder_.write("switch.yaml", "links:\n  - {name: autopilot, role: flight, url: \"" +
                                     to_string(vehicle_at_) +
                                     "\"}\n  - {name: eyes, role: vision, url: \"udp-listen://" +
                                     to_string(vision_at_).substr(6) + "\"}\n");
    switch_ = start({"switch", "switch.yaml"});
  }

  void start_vehicle(const std::string& description) {
    folder_.write("task.yaml", description);
    vehicle_ =
        start({"simulate", "task.yaml", "--real-time", "--vehicle-port",
               std::to_string(vehicle_at_.port), "--frames", "./frames", "--output", "flight"});
  }

  void start_servo(const Address& sink) {
    servo_ = start({"servo", "task.yaml", "--source", "sim:./frames", "--sink",
                    "autopilot:" + to_string(sink), "--no-video", "--output", "out"});
  }

  /// The truth so far; a line that is being written is not whole.
  std::vector<Row> truth() const {
    std::ifstream file(folder_ / "flight/truth.csv");
    std::string line;
    std::getline(file, line);
    const std::string head = line;
    std::vector<Row> rows;
    while (std::getline(file, line) && !file.eof()) {
      Row row;
      const auto names = csv_fields(head);
      const auto fields = csv_fields(line);
      for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i) {
        row[std::string(names[i])] = csv_number(fields[i]).value_or(std::nan(""));
      }
      rows.push_back(row);
    }
    return rows;
  }

  static bool is_there(const Row& row) {
    return row.at("position_error_m") <= kArrived_m &&
           std::abs(row.at("heading_error_rad")) <= kArrivedHeading_rad;
  }

  /// True once the helicopter has held its goal for two seconds (40 frames).
  bool arrives() const {
    for (double waited_s = 0; waited_s < kPatience_s; waited_s += 0.25) {
      const auto rows = truth();
      const bool long_enough = rows.size() > 40;
      if (long_enough && std::all_of(rows.end() - 40, rows.end(), is_there)) return true;
      pause(0.25);
    }
    return false;
  }

  /// Its speed over the last half second, three seconds from now.
  double speed_later() const {
    pause(3);
    const auto rows = truth();
    double fastest = rows.size() < 10 ? std::nan("") : 0;
    for (std::size_t i = rows.size() - std::min<std::size_t>(rows.size(), 10); i < rows.size();
         ++i) {
      fastest = std::max(fastest, rows[i].at("speed_m_s"));
    }
    return fastest;
  }

  void expect_within_the_limits() const {
    for (const Row& row : truth()) {
      EXPECT_LE(row.at("speed_m_s"), kFastest_m_s) << row.at("time_s");
      EXPECT_LE(row.at("north_m"), -2) << row.at("time_s");  // the wall is at 0
    }
  }

  TempFolder folder_;
  const Address vehicle_at_ = free_place();
  const Address vision_at_ = free_place();
  std::unique_ptr<Program> vehicle_;
  std::unique_ptr<Program> switch_;
  std::unique_ptr<Program> servo_;
};

TEST_F(RealTime, ThreeProcessesFlyToTheHover) {
  start_vehicle(task(86, "rigid"));
  start_switch();
  start_servo(vision_at_);
  EXPECT_TRUE(arrives()) << truth().size();
  servo_->signal(SIGINT);
  const Outcome servo = servo_->wait();
  EXPECT_EQ(servo.exit_code, 130) << servo.err;
  EXPECT_THAT(servo.out, HasSubstr("released"));
  EXPECT_LE(speed_later(), kHover_m_s);
  expect_within_the_limits();
  vehicle_->signal(SIGINT);
  EXPECT_THAT(vehicle_->wait().out, HasSubstr("mode GUIDED"));
  // Jitter and latency, for humans and for programs.
  EXPECT_THAT(read(folder_ / "out/report.html"), HasSubstr("Latency, capture to wire"));
  EXPECT_THAT(read(folder_ / "out/report.html"), HasSubstr("Period of the commands"));
  EXPECT_THAT(read(folder_ / "out/wire.csv"), HasSubstr("sent_s,capture_s,period_ms,age_ms,first"));
}

// 20 % of the datagrams lost and 100 ms of delay each way, between the servo and the switch; and at
// the end the cable pulled.
TEST_F(RealTime, OverABadLineItArrivesOrStopsSafely) {
  RelayOptions line;
  line.to = vision_at_;
  line.out.loss = line.back.loss = 0.2;
  line.out.delay_s = line.back.delay_s = 0.1;
  UdpRelay relay(line);
  start_vehicle(task(86, "loops"));
  start_switch();
  start_servo(relay.local());
  const bool arrived = arrives();
  std::printf("over the bad line it has %s\n", arrived ? "arrived" : "not arrived");
  EXPECT_GT(relay.counts().out.lost, 0);
  relay.block();
  EXPECT_LE(speed_later(), kHover_m_s);
  const auto rows = truth();
  ASSERT_FALSE(rows.empty());
  EXPECT_LT(rows.back().at("position_error_m"), rows.front().at("position_error_m"));
  expect_within_the_limits();
}

// The pose comes from another program, which knows no simulation: `simulate` only renders it.
TEST_F(RealTime, AnotherAutopilotIsSeenThroughOurCamera) {
  folder_.write("task.yaml", task(0, "loops"));
  const auto other = start({"receive", to_string(vehicle_at_), "--autopilot", "px4", "--quiet"});
  vehicle_ = start({"simulate", "task.yaml", "--real-time", "--vehicle",
                    "mavlink:udp:" + to_string(vehicle_at_).substr(6), "--vehicle-origin",
                    "-5,0.4,10.2",  // it starts 10 m above its own ground
                    "--frames", "./frames", "--output", "flight"});
  start_servo(vehicle_at_);
  EXPECT_TRUE(arrives()) << truth().size();
  servo_->signal(SIGINT);
  EXPECT_THAT(servo_->wait().out, HasSubstr("released"));
  vehicle_->signal(SIGINT);
  EXPECT_THAT(vehicle_->wait().out, HasSubstr("watched vehicle"));
}

TEST_F(RealTime, WhatDoesNotGoTogetherIsAUsageError) {
  folder_.write("task.yaml", task(0, "loops"));
  const auto code = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"simulate", "task.yaml"};
    words.insert(words.end(), more.begin(), more.end());
    return kestrel(words, folder_.path()).exit_code;
  };
  EXPECT_EQ(code({"--vehicle-port", "14550"}), 2);  // without --real-time
  EXPECT_EQ(code({"--real-time", "--seeds", "1-2"}), 2);
  const Outcome wrong =
      kestrel({"simulate", "task.yaml", "--real-time", "--vehicle", "udp:x"}, folder_.path());
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.err, HasSubstr("mavlink:udp:127.0.0.1:14580"));
}

}  // namespace
}  // namespace kestrel::test
