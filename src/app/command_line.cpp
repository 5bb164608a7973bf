#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "arguments.hpp"
#include "ground_options.hpp"
#include "replay.hpp"
#include "source_options.hpp"

namespace kestrel::app {
namespace {

constexpr int kUsageError = 2;

void add_run_options(CLI::App& verb, RunArguments& run) {
  verb.add_option("--output,--save", run.output,
                  "Run folder to make (default: runs/<name>; a number is added when it exists)");
  verb.add_flag("!--no-video", run.video, "Do not write the annotated video");
  verb.add_flag(
      "--display,!--no-display", run.display,
      "Show each frame in a window, curves in another; the vehicle hovers until a left "
      "click starts, the next one stops; a right click ends the run (default: no window)");
}

constexpr const char* kFlightPage =
    "Serve the ground station's page at this port, its commands and its emergency stop at the next "
    "two (0: any free ones); the vehicle hovers until Start is pressed there (default: no page)";
constexpr const char* kKeys =
    "In a terminal, Space aborts: zero velocity at once, until Reset in the page; without a page "
    "until r resets to hover, and then s starts.";
constexpr const char* kTrackPage =
    "Serve a page to look on at this port (0: any free one); frames go by at their own rate "
    "(default: no page)";

void add_track(CLI::App& app, const std::shared_ptr<TrackArguments>& a) {
  auto* verb = app.add_subcommand("track", "Find a template in a sequence, a video or a camera");
  verb->add_option("INPUT,--input", a->input,
                   "sequences/NAME.yaml, a pattern like I%04d.png, a folder, a video file, "
                   "camera:N, dc1394:, rtsp://..., rtp:..., udp://..., http://..., sim:HOST:PORT")
      ->required();
  verb->add_option_function<std::string>(
      "--roi", [a](const std::string& text) { a->roi = parse_roi(text); },
      "Template rectangle x,y,w,h in the first frame, px (default: the sequence's own, or drawn "
      "with the mouse where there is a display)");
  verb->add_option("--first", a->first_frame, "First frame (number in the file name; default 0)");
  verb->add_option("--last", a->last_frame, "Last frame (default: the last there is)");
  verb->add_option("--rate", a->rate_hz, "Frames per second of the recording, Hz");
  verb->add_option("--truth", a->truth, "CSV with the true corners: frame,x0,y0,...,x3,y3 (px)");
  verb->add_option("--camera,--intrinsic", a->camera,
                   "Camera file (ViSP .xml, OpenCV or ROS .yaml), to log the pose too");
  verb->add_option("--camera-name", a->camera_name,
                   "Camera's name in a ViSP file (default Camera)");
  verb->add_option("--size", a->size_m, "Width and height of the target, m, to log the pose")
      ->expected(2);
  const std::map<std::string, TrackMethod> known_methods{{"paper", TrackMethod::Paper},
                                                         {"detect", TrackMethod::Detect},
                                                         {"hybrid", TrackMethod::Hybrid}};
  verb->add_option(
          "--method", a->method,
          "paper (SIFT, kd-tree and RANSAC in every frame), detect (fast keypoints in every "
          "frame) or hybrid (follows the pixels, keypoints on doubt; default)")
      ->transform(CLI::CheckedTransformer(known_methods, CLI::ignore_case));
  add_ground_options(*verb, a->ground, kTrackPage);
  add_run_options(*verb, a->run);
}

void add_servo(CLI::App& app, const std::shared_ptr<ServoArguments>& a) {
  auto* verb = app.add_subcommand("servo", "Run a task: track, pose, servo, command, send");
  verb->add_option("TASK", a->task, "Task file (tasks/*.yaml)")->required();
  verb->add_option("--source,--input,--device", a->source,
                   "Frames, instead of the task's: sequence:FILE, images:PATTERN, video:FILE, "
                   "camera:N, dc1394:GUID, rtsp://..., rtp:..., udp://..., http://..., "
                   "sim:HOST:PORT or sim:PATH (simulate --real-time)");
  verb->add_option("--sink", a->sink,
                   "Where commands go, instead of the task's: autopilot:udp://HOST:PORT, "
                   "udp://HOST:PORT or none");
  verb->add_flag_callback(
      "--real-time", [a] { a->pace = Pace::RealTime; },
      "Play a recording at its own rate (default: as fast as possible)");
  add_ground_options(*verb, a->ground, kFlightPage);
  add_ground_link(*verb, a->ground);
  verb->footer(kKeys);
  add_run_options(*verb, a->run);
}

void add_simulate(CLI::App& app, const std::shared_ptr<SimulateArguments>& a) {
  auto* verb = app.add_subcommand("simulate", "Fly the built-in helicopter through a task");
  add_simulate_options(*verb, a);
  add_ground_options(*verb, a->ground, kFlightPage);
  add_ground_link(*verb, a->ground);
  verb->footer(kKeys);
  verb->get_option("--ground")->excludes(verb->get_option("--seeds"));
  verb->get_option("--ground")->excludes(verb->get_option("--real-time"));
  add_run_options(*verb, a->run);
}

void add_receive(CLI::App& app, const std::shared_ptr<ReceiveArguments>& a) {
  auto* verb =
      app.add_subcommand("receive", "Print, count and log the commands that arrive over UDP");
  verb->add_option("ADDRESS", a->address, "Where to listen (default udp://127.0.0.1:14550)");
  verb->add_option("--log", a->log, "CSV file to write");
  verb->add_option("--duration", a->duration_s, "Stop after this long, s (default: on Ctrl-C)");
  verb->add_option("--count", a->count, "Stop after this many commands (default: on Ctrl-C)");
  verb->add_flag("--quiet", a->quiet, "Print the counts at the end only");
  const std::map<std::string, std::optional<Autopilot>> known{
      {"none", std::nullopt}, {"ardupilot", Autopilot::ArduPilot}, {"px4", Autopilot::Px4}};
  verb->add_option_function<std::string>(
          "--autopilot", [a, known](const std::string& word) { a->autopilot = known.at(word); },
          "Stand in for an autopilot and fly by its rules: ardupilot, px4 or none (default none)")
      ->check(CLI::IsMember(known));
  verb->add_flag_callback(
      "--on-ground", [a] { a->starts_in_air = false; },
      "Start disarmed on the ground (default: armed, 10 m up); with --autopilot");
}

void add_jog(CLI::App& app, const std::shared_ptr<JogArguments>& a) {
  auto* verb = app.add_subcommand(
      "jog", "Move a vehicle along one axis at a time, slowly and briefly, and say what it did");
  verb->add_option("--to", a->to, "The autopilot: udp://HOST:PORT")->required();
  const std::map<std::string, MotionAxis> known{{"forward", MotionAxis::Forward},
                                                {"right", MotionAxis::Right},
                                                {"down", MotionAxis::Down},
                                                {"yaw", MotionAxis::Yaw}};
  verb->add_option("--axes", a->axes, "Which, in this order (default forward right down yaw)")
      ->transform(CLI::CheckedTransformer(known, CLI::ignore_case));
  verb->add_option("--speed", a->speed_m_s, "m/s, -1 to 1; negative: the other way (default 0.3)")
      ->check(CLI::Range(-1.0, 1.0));
  verb->add_option("--yaw-rate", a->yaw_rate_deg_s, "deg/s, -30 to 30 (default 10)")
      ->check(CLI::Range(-30.0, 30.0));
  verb->add_option("--seconds", a->seconds, "How long each move lasts, s, 0.5 to 5 (default 2)")
      ->check(CLI::Range(0.5, 5.0));
  verb->add_option("--wait", a->wait_s, "How long to wait for control, s (default 20)")
      ->check(CLI::Range(0.0, 600.0));
  verb->add_flag("--allow-arming", a->allow_arming,
                 "The vehicle may be armed, with --takeoff (default: it never is)");
  verb->add_option("--takeoff", a->takeoff_m,
                   "Take off to this height first when it stands, m (default: it must fly)")
      ->check(CLI::Range(0.0, 20.0));
  verb->add_flag("--yes", a->yes, "Do not ask before each move");
  verb->add_flag("--json", a->json, "Print JSON");
}

void add_check(CLI::App& app, const std::shared_ptr<CheckArguments>& a) {
  auto* verb = app.add_subcommand("check",
                                  "Validate task, camera, mount and sequence files and say what "
                                  "was understood");
  verb->add_option("FILES", a->files, "Files to check")->required();
  verb->add_option("--output,--save", a->output,
                   "Folder to make, for a drawing of the mount of each task and mount file "
                   "(default: no drawing)");
}

void add_demo(CLI::App& app, const std::shared_ptr<DemoArguments>& a) {
  auto* verb = app.add_subcommand(
      "demo", "The main job: track a recorded sequence, send the commands, fly the helicopter");
  verb->add_option("--tasks", a->tasks, "Folder of the task files (default tasks)");
  verb->add_option("--output", a->output, "Run folder to make (default runs/demo)");
}

}  // namespace

std::variant<Arguments, int> parse_command_line(int argc, char** argv) {
  CLI::App app{"Kestrel: visual servoing for helicopters and other velocity-controlled vehicles"};
  app.set_version_flag("--version", std::string("kestrel ") + KESTREL_VERSION);
  app.require_subcommand(1);
  app.fallthrough(false);
  const auto track = std::make_shared<TrackArguments>();
  const auto servo = std::make_shared<ServoArguments>();
  const auto simulate = std::make_shared<SimulateArguments>();
  const auto receive = std::make_shared<ReceiveArguments>();
  const auto check = std::make_shared<CheckArguments>();
  const auto demo = std::make_shared<DemoArguments>();
  const auto evaluate = std::make_shared<EvaluateArguments>();
  const auto compare = std::make_shared<CompareArguments>();
  const auto merge = std::make_shared<MergeArguments>();
  const auto laws = std::make_shared<LawsArguments>();
  const auto explain = std::make_shared<ExplainArguments>();
  const auto switching = std::make_shared<SwitchArguments>();
  const auto key = std::make_shared<KeyArguments>();
  add_track(app, track);
  add_servo(app, servo);
  add_simulate(app, simulate);
  add_receive(app, receive);
  add_check(app, check);
  add_demo(app, demo);
  add_evaluate_options(
      *app.add_subcommand("evaluate",
                          "Run methods and settings over sequences and score them against truth"),
      evaluate);
  add_compare(app, compare);
  add_merge(app, merge);
  add_laws(app, laws);
  add_explain(app, explain);
  add_switch(app, switching);
  add_key(app, key);
  const auto jog = std::make_shared<JogArguments>();
  add_jog(app, jog);
  const auto calibrate = std::make_shared<CalibrateArguments>();
  add_calibrate(app, calibrate);
  const auto hand_eye = std::make_shared<HandEyeArguments>();
  CLI::App* calibrating = app.get_subcommand("calibrate");
  add_hand_eye(*calibrating, hand_eye);
  const auto cameras = std::make_shared<CamerasArguments>();
  add_cameras(app, cameras);
  const auto record = std::make_shared<RecordArguments>();
  add_record(app, record);
  const auto replay = std::make_shared<ReplayArguments>();
  add_replay(app, replay);
  app.footer(
      "Exit codes: 0 done, 1 failed, 2 wrong usage, 130 interrupted (what was written is "
      "complete).\n'kestrel VERB --help' shows a verb's options.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
  if (app.got_subcommand("track")) return Arguments(*track);
  if (app.got_subcommand("servo")) return Arguments(*servo);
  if (app.got_subcommand("simulate")) return Arguments(*simulate);
  if (app.got_subcommand("receive")) return Arguments(*receive);
  if (app.got_subcommand("check")) return Arguments(*check);
  if (app.got_subcommand("evaluate")) return Arguments(*evaluate);
  if (app.got_subcommand("compare")) return Arguments(*compare);
  if (app.got_subcommand("merge")) return Arguments(*merge);
  if (app.got_subcommand("laws")) return Arguments(*laws);
  if (app.got_subcommand("explain")) return Arguments(*explain);
  if (app.got_subcommand("switch")) return Arguments(*switching);
  if (app.got_subcommand("key")) return Arguments(*key);
  if (app.got_subcommand("jog")) return Arguments(*jog);
  if (calibrating->got_subcommand("hand-eye")) return Arguments(*hand_eye);
  if (app.got_subcommand("calibrate")) return Arguments(*calibrate);
  if (app.got_subcommand("cameras")) return Arguments(*cameras);
  if (app.got_subcommand("record")) return Arguments(*record);
  if (app.got_subcommand("replay")) return Arguments(*replay);
  return Arguments(*demo);
}

}  // namespace kestrel::app
