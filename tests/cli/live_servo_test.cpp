// The program itself on a live camera: FFmpeg sends a poster over UDP, stands still, goes on. What
// goes out to the flight controller is what counts.
#include <csignal>
#include <fstream>

#include <gtest/gtest.h>

#include "kestrel/io/camera_device.hpp"
#include "kestrel/link/command_receiver.hpp"

#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "cli/video_sender.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

constexpr double kLongest_s = 90;

std::string task(int port, const std::string& roi) {
  return "source: udp://127.0.0.1:" + std::to_string(port) +
         "\n"
         "capture: {open_timeout_s: 60, stall_timeout_s: 1, longest_retry_s: 0.5}\n"
         "camera: {intrinsics_px: [300, 300, 159.5, 119.5], size_px: [320, 240],\n"
         "  body_from_camera: {translation_m: [0, 0, 0], rpy_deg: [90, 0, 90]}}\n"
         "target: {width_m: 0.4, height_m: 0.4, template_px: [" +
         roi +
         "]}\n"
         "goal_camera_from_target: {translation_m: [0, 0, 2], rpy_deg: [0, 0, 0]}\n";
}

bool is_zero(const ReceivedCommand& c) { return c.command.vector().isZero(0); }

/// Waits for `count` commands in a row that are zero, or are not; seconds, kLongest_s when they do
/// not come.
double wait_for(CommandReceiver& receiver, bool zero, int count) {
  const double start_s = monotonic_clock_s();
  for (int in_a_row = 0; monotonic_clock_s() - start_s < kLongest_s;) {
    for (const ReceivedCommand& c : receiver.poll(0.1))
      in_a_row = is_zero(c) == zero ? in_a_row + 1 : 0;
    if (in_a_row >= count) return monotonic_clock_s() - start_s;
  }
  return kLongest_s;
}

TEST(LiveServo, HoversWhileTheCameraIsSilentAndServoesAgain) {
  const TempFolder folder;
  const auto sequence = rendered_sequence(folder / "poster", 40);
  const int port = free_port();
  const VideoSender sender(
      {{"-stream_loop", "-1", "-framerate", "25", "-i", "poster/%04d.png"}, mpeg_over_udp(port)},
      folder.path());
  folder.write("live.yaml", task(port, sequence.roi));
  CommandReceiver receiver({"127.0.0.1", 0});
  Program servo({"servo", "live.yaml", "--no-video", "--sink",
                 "udp://127.0.0.1:" + std::to_string(receiver.local().port), "--output", "run"},
                folder.path());
  EXPECT_LT(wait_for(receiver, false, 5), kLongest_s);

  sender.stall();
  const double hover_s = wait_for(receiver, true, 10);  // ten: zeros that keep coming
  EXPECT_LT(hover_s, kLongest_s);
  sender.go_on();
  const double again_s = wait_for(receiver, false, 5);
  EXPECT_LT(again_s, kLongest_s);

  servo.signal(SIGINT);
  const Outcome outcome = servo.wait(60);
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_SAYS(outcome.out, "without a picture");
  EXPECT_SAYS(outcome.out, "capture to command, median");
  EXPECT_SAYS(outcome.out, "longest silence");
  // The last word is hover.
  bool last_is_zero = false;
  for (const ReceivedCommand& c : receiver.poll(1)) last_is_zero = is_zero(c);
  EXPECT_TRUE(last_is_zero);
  std::printf("ten zeros %.2f s after the stall, servo again %.2f s after it ended\n%s\n", hover_s,
              again_s, outcome.out.c_str());
}

TEST(LiveServo, EndsWithHoverWhenTheCameraIsGoneForGood) {
  const TempFolder folder;
  const auto sequence = rendered_sequence(folder / "poster", 40);
  const int port = free_port();
  auto sender = std::make_unique<VideoSender>(
      VideoStream{{"-stream_loop", "-1", "-framerate", "25", "-i", "poster/%04d.png"},
                  mpeg_over_udp(port)},
      folder.path());
  std::string text = task(port, sequence.roi);
  text.replace(text.find("stall_timeout_s: 1"), 18, "stall_timeout_s: 1, give_up_s: 2");
  folder.write("live.yaml", text);
  CommandReceiver receiver({"127.0.0.1", 0});
  Program servo({"servo", "live.yaml", "--no-video", "--sink",
                 "udp://127.0.0.1:" + std::to_string(receiver.local().port), "--output", "run"},
                folder.path());
  EXPECT_LT(wait_for(receiver, false, 5), kLongest_s);
  sender.reset();
  const Outcome outcome = servo.wait(kLongest_s);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_SAYS(outcome.out, "no picture for");
  EXPECT_TRUE(std::filesystem::exists(folder / "run/report.html"));
  bool last_is_zero = false;
  for (const ReceivedCommand& c : receiver.poll(1)) last_is_zero = is_zero(c);
  EXPECT_TRUE(last_is_zero);
}

/// A simulated camera in another process, on a local socket; its vehicle obeys nobody and stays.
std::unique_ptr<Program> simulated_camera(const TempFolder& folder, const std::string& output) {
  return std::make_unique<Program>(
      std::vector<std::string>{"simulate", "task.yaml", "--real-time", "--vehicle-port",
                               std::to_string(free_port()), "--frames", "./frames", "--output",
                               output},
      folder.path());
}

TEST(LiveServo, HoversWhileTheSimulatedCameraIsSilentOrGoneAndServoesAgain) {
  const TempFolder folder;
  folder.write(
      "task.yaml",
      "source: simulation\nsink: none\n"
      "capture: {open_timeout_s: 60, stall_timeout_s: 1, longest_retry_s: 0.5}\n"
      "camera: {intrinsics_px: [300, 300, 159.5, 119.5], size_px: [320, 240],\n"
      "  body_from_camera: {translation_m: [0, 0, 0], rpy_deg: [90, 0, 90]}}\n"
      "target: {width_m: 2.0, height_m: 1.5}\n"
      "goal_camera_from_target: {translation_m: [0, 0, 5], rpy_deg: [0, 0, 0]}\n"
      "simulation: {start: {position_ned_m: [-7, 0.5, 0.5], heading_deg: -5}, rate_hz: 20,\n"
      "  duration_s: 300}\n");
  auto camera = simulated_camera(folder, "flight");
  CommandReceiver receiver({"127.0.0.1", 0});
  Program servo({"servo", "task.yaml", "--source", "sim:./frames", "--no-video", "--sink",
                 "udp://127.0.0.1:" + std::to_string(receiver.local().port), "--output", "run"},
                folder.path());
  EXPECT_LT(wait_for(receiver, false, 5), kLongest_s);

  camera->signal(SIGSTOP);
  const double stalled_s = wait_for(receiver, true, 10);
  EXPECT_LT(stalled_s, kLongest_s);
  camera->signal(SIGCONT);
  const double again_s = wait_for(receiver, false, 5);
  EXPECT_LT(again_s, kLongest_s);

  camera.reset();  // killed
  const double gone_s = wait_for(receiver, true, 10);
  EXPECT_LT(gone_s, kLongest_s);
  camera = simulated_camera(folder, "flight2");
  const double restarted_s = wait_for(receiver, false, 5);
  EXPECT_LT(restarted_s, kLongest_s);
  std::printf(
      "sim: ten zeros %.2f s after a stall, servo again %.2f s after it; ten zeros %.2f s after it "
      "was killed, servo again %.2f s after a new start\n",
      stalled_s, again_s, gone_s, restarted_s);
}

}  // namespace
}  // namespace kestrel::test
