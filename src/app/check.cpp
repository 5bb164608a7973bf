#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/run_folder.hpp"
#include "kestrel/io/sequence_file.hpp"
#include "kestrel/io/task_file.hpp"
#include "kestrel/io/truth_file.hpp"
#include "kestrel/lab/lab_plan_file.hpp"
#include "kestrel/lab/planned_runs.hpp"

#include "autopilot_file.hpp"
#include "mount_check.hpp"
#include "simulation_file.hpp"
#include "sinks.hpp"
#include "switch_file.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = M_PI / 180;

const char* words(Lens lens) {
  switch (lens) {
    case Lens::Pinhole:
      return "no lens distortion";
    case Lens::VispRadial:
      return "ViSP's radial distortion";
    case Lens::PlumbBob:
      return "OpenCV's plumb-bob distortion";
    case Lens::KannalaBrandt:
      return "Kannala-Brandt fisheye distortion";
  }
  return "unknown distortion";
}

std::string describe(const Camera& camera) {
  const CameraParameters& p = camera.parameters();
  std::string text = fmt::format("focal length {:.1f} x {:.1f} px, centre ({:.1f}, {:.1f}), {}",
                                 p.px, p.py, p.u0, p.v0, words(p.lens));
  if (p.width > 0 && p.height > 0) {
    text += fmt::format("; images of {} x {} px, {:.0f} x {:.0f} degrees wide", p.width, p.height,
                        2 * std::atan(p.width / 2.0 / p.px) / kDegree,
                        2 * std::atan(p.height / 2.0 / p.py) / kDegree);
  }
  return text;
}

std::string describe(const TrackOptions& track) {
  switch (track.method) {
    case TrackMethod::Paper:
      return "paper: SIFT, kd-tree and RANSAC in every frame, in a window that doubles on each "
             "miss";
    case TrackMethod::Detect:
      return fmt::format("detect: keypoints in every frame, checked on the pixels; window: {}",
                         name(track.window));
    case TrackMethod::Hybrid:
      break;
  }
  return fmt::format(
      "hybrid: follows the pixels, keypoints on doubt and on loss; window: {}; lost after {} s",
      name(track.window), track.coast_s);
}

std::string describe_goal(const Task& task) {
  const Eigen::Vector3d& t = task.goal.translation;
  return fmt::format(
      "the target {:.2f} m ahead of the camera, {:+.2f} m to its right, {:+.2f} m below its axis, "
      "turned by {:.1f} degrees; it is {:.2f} x {:.2f} m",
      t.z(), t.x(), t.y(), rotation_vector(task.goal.rotation).norm() / kDegree,
      task.target_width_m, task.target_height_m);
}

const char* words(Freedom freedom) {
  if (freedom == Freedom::Six) return "all six body velocities";
  return freedom == Freedom::Four ? "forward, right, down and yaw" : "forward, right and down";
}

std::string describe(const VelocityCommand& limit, const char* per) {
  return fmt::format("forward {:.2f}, right {:.2f}, down {:.2f} m/s{}, yaw {:.0f} deg/s{}",
                     limit.forward_m_s, limit.right_m_s, limit.down_m_s, per,
                     limit.yaw_rate_rad_s / kDegree, per);
}

void say_template(const Experiment& e) {
  if (e.template_image) return say("template", "the picture " + e.template_image->string());
  if (!e.template_px) return say("template", "none: you will be asked to draw it");
  const PixelBox& box = *e.template_px;
  say("template", fmt::format("{} x {} px at ({}, {}) of the first frame", box.width, box.height,
                              box.u, box.v));
}

void check_task(const Section& root, const fs::path& drawings) {
  const Experiment e = read_experiment(root);
  fmt::print("{}: a task\n", e.file.string());
  say("frames", e.source);
  say("commands", e.sink);
  if (e.source != "simulation") say_template(e);
  say("camera", describe(e.task.camera));
  say_mount(e.task, e.file, drawings);
  say("tracker", describe(e.task.track));
  say("goal", describe_goal(e.task));
  say("law", fmt::format("{}, gain {} 1/s, over {}", name(e.task.servo.law),
                         e.task.servo.gain_per_s, words(e.task.servo.freedom)));
  say("limits", describe(e.task.limits.speed, ""));
  say("slew", describe(e.task.limits.acceleration, " per s"));
  say("on loss", fmt::format("hold {} s, decay with {} s, hover from {} s", e.task.loss.hold_s,
                             e.task.loss.decay_s, e.task.loss.hover_after_s));
  if (const auto section = root.child_if("simulation")) {
    const Simulation s = read_simulation(*section);
    const Eigen::Vector3d& p = s.world.start.position_m;
    say("simulation",
        fmt::format("starts {:.1f} m south, {:.1f} m east, {:.1f} m below the target, heading "
                    "{:.0f} degrees; hovers when within {} m and {:.1f} degrees for {} s",
                    -p.x(), p.y(), p.z(), s.world.start.yaw / kDegree, s.goal.position_m,
                    s.goal.heading_rad / kDegree, s.goal.hold_s));
  }
  read_autopilot(root);
  root.done();
  check_sink(e.sink);
  if (!e.ground_link.empty()) check_sink(e.ground_link);
}

void check_sequence(const fs::path& file) {
  const SequenceDescription d = load_sequence(file);
  fmt::print("{}: a sequence: {}\n", file.string(), d.what);
  say("images", d.sequence.input);
  const PixelBox& box = d.template_px;
  say("template", fmt::format("{} x {} px at ({}, {})", box.width, box.height, box.u, box.v));
  if (d.camera) say("camera", describe(load_camera(*d.camera, d.camera_name)));
  if (d.truth) say("truth", fmt::format("{} labelled frames", load_truth(*d.truth).size()));
  say("origin", d.origin);
  say("licence", d.licence);
}

void check_plan(const fs::path& file) {
  const LabPlan plan = load_plan(file);
  fmt::print("{}: a comparison: {}\n", file.string(), plan.title);
  say("laws", std::to_string(plan.laws.size() + plan.helicopter.laws.size()));
  say("scenarios", std::to_string(plan.scenarios.size() + plan.helicopter.scenarios.size()));
  say("runs", std::to_string(planned_runs(plan, "").size()));
}

void check_switch(const fs::path& file) {
  const SwitchTask task = read_switch_task(file);
  fmt::print("{}: a switch\n", file.string());
  for (std::size_t i = 0; i < task.loop.places.size(); ++i) {
    const SwitchLink& link = task.loop.core.links[i];
    say("link", fmt::format("{}: {} at {}{}", link.name, name(link.role),
                            to_string(task.loop.places[i].place), link.key ? ", signed" : ""));
  }
  say("limits", describe(task.loop.core.envelope.speed, ""));
  say("deadman", fmt::format("{} s", task.loop.core.deadman_s));
}

/// Which kind of file a YAML file is, by its keys.
void check_yaml(const fs::path& file, const fs::path& drawings) {
  const Section root = Section::load(file);
  if (root.has("images")) return check_sequence(file);
  if (root.has("camera_matrix") || root.has("Camera_Matrix")) {
    const Camera camera = load_camera(file);
    return fmt::print("{}: a camera: {}\n", file.string(), describe(camera));
  }
  if (root.has("translation_m") || root.has("data") || root.has("preset"))
    return check_mount(file, drawings);
  if (root.has("laws") || root.has("scenarios") || root.has("helicopter")) return check_plan(file);
  if (root.has("links")) return check_switch(file);
  check_task(root, drawings);
}

void check_file(const fs::path& file, const fs::path& drawings) {
  if (file.extension() == ".xml") {
    return fmt::print("{}: a camera: {}\n", file.string(), describe(load_camera(file, "")));
  }
  check_yaml(file, drawings);
}

}  // namespace

int run(const CheckArguments& a) {
  int wrong = 0;
  const fs::path drawings = a.output.empty() ? fs::path() : create_run_folder(a.output);
  for (const auto& file : a.files) {
    try {
      check_file(file, drawings);
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      ++wrong;
    }
  }
  if (a.files.size() > 1)
    fmt::print("{} of {} files are good\n", a.files.size() - std::size_t(wrong), a.files.size());
  return wrong == 0 ? 0 : 1;
}

}  // namespace kestrel::app
