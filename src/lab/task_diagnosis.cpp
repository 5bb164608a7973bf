#include "kestrel/lab/task_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include <Eigen/SVD>

#include "kestrel/lab/helicopter_margins.hpp"
#include "kestrel/servo/interaction.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr int kStarts = 24;

using Findings = std::vector<Finding>;

std::string words(const VelocityCommand& c) {
  // What rounds to nothing has no sign.
  const auto shown = [](double value, double unit) { return std::round(value / unit) * unit + 0.; };
  return fmt::format("forward {:+.3f}, right {:+.3f}, down {:+.3f} m/s, yaw {:+.2f} deg/s",
                     shown(c.forward_m_s, 1e-3), shown(c.right_m_s, 1e-3), shown(c.down_m_s, 1e-3),
                     shown(c.yaw_rate_rad_s / kDegree, 1e-2));
}

std::vector<const char*> motions(Freedom freedom) {
  if (freedom == Freedom::Three) return {"forward", "right", "down"};
  if (freedom == Freedom::Four) return {"forward", "right", "down", "yaw"};
  return {"forward", "right", "down", "roll", "pitch", "yaw"};
}

/// "0.98 right, -0.20 yaw": the parts of a unit vector of motions that count.
std::string direction(const Eigen::VectorXd& v, Freedom freedom) {
  const std::vector<const char*> names = motions(freedom);
  std::string text;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    if (std::abs(v[i]) < 0.1) continue;
    text += fmt::format("{}{:.2f} {}", text.empty() ? "" : ", ", v[i], names[std::size_t(i)]);
  }
  return text;
}

using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

void look_at_jacobian(const Task& task, const Svd& svd, Findings& findings) {
  const Eigen::VectorXd& s = svd.singularValues();
  const double condition = s[0] / s[s.size() - 1];
  const Eigen::VectorXd weakest = svd.matrixV().col(svd.matrixV().cols() - 1);
  const std::string what = fmt::format(
      "at the goal the image shows the {} motions with singular values from {:.3g} to {:.3g} "
      "(condition {:.3g}); least of all: {}",
      s.size(), s[0], s[s.size() - 1], condition, direction(weakest, task.servo.freedom));
  if (condition < 300) return findings.push_back({Weight::Fine, "jacobian", what, ""});
  findings.push_back(
      {condition > kLargestCondition ? Weight::Fault : Weight::Doubt, "jacobian", what,
       "that motion is commanded from next to nothing: come nearer, use a larger target, or leave "
       "it out (freedom: three, the heading held by the compass)"});
}

void look_at_noise(const Task& task, const Svd& svd, Findings& findings) {
  const Eigen::MatrixXd inverse = svd.solve(Eigen::MatrixXd::Identity(8, 8));
  const double focal_px = task.camera.parameters().px;
  const std::vector<const char*> names = motions(task.servo.freedom);
  std::string what = "a pixel of noise in the corners commands";
  double worst = 0;
  for (Eigen::Index i = 0; i < inverse.rows(); ++i) {
    const double std = task.servo.gain_per_s * inverse.row(i).norm() / focal_px;
    const bool turns = i >= 3;
    what += fmt::format("{} {} {:.3f} {}", i == 0 ? "" : ",", names[std::size_t(i)],
                        turns ? std / kDegree : std, turns ? "deg/s" : "m/s");
    worst = std::max(worst, turns ? std / (5 * kDegree) : std / 0.1);
  }
  what += " (standard deviations)";
  if (worst < 1) return findings.push_back({Weight::Fine, "noise", what, ""});
  findings.push_back(
      {Weight::Doubt, "noise", what,
       "more than 0.1 m/s or 5 deg/s from one pixel: lower the gain, come nearer, or "
       "leave the worst motion out"});
}

void look_at_gain(const Task& task, const TaskTiming& timing, const HelicopterSetup& setup,
                  Findings& findings) {
  const double d = std::round(timing.latency_s * timing.rate_hz);
  const double integrator = 2 * std::sin(M_PI / (2 * (2 * d + 1))) * timing.rate_hz;
  const auto vehicle = lateral_gain_limit(setup);
  const double gain = task.servo.gain_per_s;
  std::string what = fmt::format(
      "gain {:.2f} per second; the limit at {:.3g} commands per second and {:.2f} s of latency is "
      "{:.3g} for a vehicle that follows at once",
      gain, timing.rate_hz, timing.latency_s, integrator);
  double limit = integrator;
  if (vehicle) {
    what += fmt::format(" and {:.3g} for the built-in helicopter", *vehicle);
    limit = std::min(limit, *vehicle);
  }
  if (gain <= limit / 4) return findings.push_back({Weight::Fine, "gain", what, ""});
  findings.push_back({gain >= limit ? Weight::Fault : Weight::Doubt, "gain", what,
                      fmt::format("set gain_per_s to {:.2g} or less, a quarter of the limit, or "
                                  "make the loop faster",
                                  limit / 4)});
}

void look_at_signs(const Task& task, Findings& findings) {
  const auto command = [&](double dx, double dy, double scale) -> std::string {
    std::vector<Feature> seen = desired_features(task);
    for (Feature& f : seen) {
      f.at = {f.at.x * scale + dx, f.at.y * scale + dy};
      f.depth_m /= scale;
    }
    const LawAnswer answer = law_on_body(law_input(seen, task), task.body_from_camera, task.servo);
    if (!answer.twist) return fmt::format("no answer ({})", name(answer.refusal));
    return words(to_command(task.body_from_camera * *answer.twist));
  };
  findings.push_back({Weight::Fine, "sign",
                      "a target seen too far to the right commands " + command(0.02, 0, 1) +
                          "; too low: " + command(0, 0.02, 1) +
                          "; too small: " + command(0, 0, 0.9),
                      ""});
}

/// A start beside the goal, within half the goal's distance along each axis and 15 degrees of
/// heading, from which all points are in the image; false when this draw is none.
bool draw_start(HelicopterSetup& setup, double distance_m, std::mt19937_64& chance) {
  const auto uniform = [&] { return 2 * (double(chance() >> 11) * 0x1p-53) - 1; };
  HelicopterScenario& s = setup.scenario;
  const Eigen::Vector3d offset = distance_m / 2 * Eigen::Vector3d(uniform(), uniform(), uniform());
  s.start_camera_m = s.body_from_camera.translation + offset;
  s.start_yaw_rad = 15 * kDegree * uniform();
  const Transform<frame::World, frame::Camera> camera{
      rotation_from_rpy(0, 0, s.start_yaw_rad) * s.body_from_camera.rotation, s.start_camera_m};
  const TargetPose seen = camera.inverse() * s.world_from_target;
  const LabCamera& c = setup.camera;
  return std::all_of(s.points_m.begin(), s.points_m.end(), [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = seen * point;
    const double u = c.principal_u_px + c.focal_px * p.x() / p.z();
    const double v = c.principal_v_px + c.focal_px * p.y() / p.z();
    return p.z() > 0.1 * distance_m && u >= 0 && v >= 0 && u < c.width_px && v < c.height_px;
  });
}

void look_at_starts(const Task& task, HelicopterSetup setup, Findings& findings) {
  std::mt19937_64 chance(1);
  std::map<std::string, int> ends;
  int flown = 0;
  for (int draws = 0; draws < 100 * kStarts && flown < kStarts; ++draws) {
    if (!draw_start(setup, task.goal.translation.norm(), chance)) continue;
    ++flown;
    ++ends[name(run_helicopter(setup, [](const HelicopterStep&) {}).end)];
  }
  if (flown == 0) {
    findings.push_back({Weight::Fault, "start", "at the goal the target is not within the image",
                        "check the goal, the target's size and the camera"});
    return;
  }
  std::string what =
      fmt::format("of {} flights of the built-in helicopter from around the goal", flown);
  for (const auto& [end, count] : ends) what += fmt::format(", {} ended: {}", count, end);
  const int good = ends["converged"];
  if (good == flown) return findings.push_back({Weight::Fine, "start", what, ""});
  findings.push_back({2 * good < flown ? Weight::Fault : Weight::Doubt, "start", what,
                      "position_only: the law has no hold on the heading (freedom, or a poor "
                      "condition); others: lower the gain, or compare laws (kestrel compare)"});
}

}  // namespace

void TaskTiming::check() const {
  const auto require = [](bool good, const char* what, double value) {
    if (good) return;
    std::ostringstream message;
    message << what << ", is " << value;
    throw std::invalid_argument(message.str());
  };
  require(rate_hz > 0 && rate_hz <= 1e4, "rate_hz: must be positive and at most 10000", rate_hz);
  require(latency_s >= 0 && latency_s <= 10, "latency_s: must be from 0 to 10", latency_s);
}

HelicopterSetup helicopter_setup(const Task& task, const TaskTiming& timing) {
  HelicopterSetup setup;
  const auto corners = target_corners(task);
  setup.scenario.name = "task";
  setup.scenario.points_m.assign(corners.begin(), corners.end());
  setup.scenario.body_from_camera = task.body_from_camera;
  setup.scenario.goal = task.goal;
  setup.scenario.world_from_target =
      Transform<frame::World, frame::Body>{} * task.body_from_camera * task.goal;
  setup.scenario.start_camera_m = task.body_from_camera.translation;
  const CameraParameters& p = task.camera.parameters();
  setup.camera.focal_px = p.px;
  if (p.width > 0 && p.height > 0) {
    setup.camera = {p.px, p.u0, p.v0, p.width, p.height};
  }
  setup.law.law = law_options(task.servo);
  setup.law.law.solver = LawSolver::Eigen;
  setup.law.variant = task.servo.freedom == Freedom::Four    ? HelicopterVariant::Vp4
                      : task.servo.freedom == Freedom::Three ? HelicopterVariant::Vp3
                                                             : HelicopterVariant::Drop6;
  setup.conditions.limits = task.limits;
  setup.conditions.failsafe = task.loss;
  setup.conditions.duration_s = 60;
  setup.conditions.period_frames = std::max(1, int(std::lround(30 / timing.rate_hz)));
  setup.conditions.delay_frames = int(std::lround(timing.latency_s * 30));
  return setup;
}

std::vector<Finding> diagnosis(const Task& task, const TaskTiming& timing) {
  timing.check();
  const Eigen::MatrixXd J = interaction_matrix(desired_features(task)) *
                            body_basis(task.body_from_camera, task.servo.freedom);
  const Svd svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const HelicopterSetup setup = helicopter_setup(task, timing);
  Findings findings;
  look_at_jacobian(task, svd, findings);
  look_at_noise(task, svd, findings);
  look_at_gain(task, timing, setup, findings);
  look_at_signs(task, findings);
  look_at_starts(task, setup, findings);
  return by_weight(std::move(findings));
}

}  // namespace kestrel
