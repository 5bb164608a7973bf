#include "kestrel/io/task_options.hpp"

#include <cmath>
#include <stdexcept>

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

/// Options whose own check() complains about the section they were read from.
template <class Options>
Options checked(const Section& section, const Options& options) {
  try {
    options.check();
  } catch (const std::invalid_argument& error) {
    section.fail("", std::string(error.what()) + "; see tasks/README.md for its range");
  }
  return options;
}

std::uint64_t seed(const Section& section, std::uint64_t otherwise) {
  const std::int64_t value = section.integer("seed", std::int64_t(otherwise));
  if (value < 0) section.fail("seed", "is negative; give 0 or more");
  return std::uint64_t(value);
}

SiftOptions read_sift(const Section& s) {
  SiftOptions o;
  o.octave_layers = s.whole("octave_layers", o.octave_layers);
  o.contrast_threshold = s.number("contrast_threshold", o.contrast_threshold);
  o.edge_threshold = s.number("edge_threshold", o.edge_threshold);
  o.sigma = s.number("sigma_px", o.sigma);
  o.max_keypoints = s.whole("max_keypoints", o.max_keypoints);
  return checked(s, o);
}

MatchOptions read_match(const Section& s) {
  MatchOptions o;
  o.ratio = s.number("ratio", o.ratio);
  o.checks = s.whole("checks", o.checks);
  o.seed = s.whole("seed", o.seed);
  return checked(s, o);
}

RansacOptions read_ransac(const Section& s) {
  RansacOptions o;
  o.max_reprojection_px = s.number("max_reprojection_px", o.max_reprojection_px);
  o.min_inliers = s.whole("min_inliers", o.min_inliers);
  o.min_inlier_share = s.number("min_inlier_share", o.min_inlier_share);
  o.max_trials = s.whole("max_trials", o.max_trials);
  o.confidence = s.number("confidence", o.confidence);
  o.seed = seed(s, o.seed);
  return checked(s, o);
}

OutlineOptions read_outline(const Section& s) {
  OutlineOptions o;
  o.min_area_ratio = s.number("min_area_ratio", o.min_area_ratio);
  o.max_area_ratio = s.number("max_area_ratio", o.max_area_ratio);
  o.min_side_px = s.number("min_side_px", o.min_side_px);
  return o;
}

/// Velocities, or their changes, whose keys end like this.
VelocityCommand read_velocities(const Section& s, const VelocityCommand& otherwise,
                                const std::string& linear, const std::string& angular) {
  return {s.number("forward_" + linear, otherwise.forward_m_s),
          s.number("right_" + linear, otherwise.right_m_s),
          s.number("down_" + linear, otherwise.down_m_s),
          s.number("yaw_rate_" + angular, otherwise.yaw_rate_rad_s / kDegree) * kDegree};
}

}  // namespace

TrackOptions read_track_options(const Section& root) {
  TrackOptions o;
  const auto s = root.child_if("track");
  if (!s) return o;
  if (const auto sift = s->child_if("sift")) o.sift = read_sift(*sift);
  if (const auto match = s->child_if("match")) o.match = read_match(*match);
  if (const auto ransac = s->child_if("ransac")) o.ransac = read_ransac(*ransac);
  if (const auto outline = s->child_if("outline")) o.outline = read_outline(*outline);
  o.max_outline_deviation_px = s->number("max_outline_deviation_px", o.max_outline_deviation_px);
  return checked(*s, o);
}

PlanePoseOptions read_pose_options(const Section& root) {
  PlanePoseOptions o;
  const auto s = root.child_if("pose");
  if (!s) return o;
  o.corner_noise_px = s->number("corner_noise_px", o.corner_noise_px);
  return checked(*s, o);
}

ServoOptions read_servo_options(const Section& root) {
  ServoOptions o;
  const auto s = root.child_if("servo");
  if (!s) return o;
  o.interaction = s->choice<Interaction>("interaction",
                                         {{"current", Interaction::Current},
                                          {"desired", Interaction::Desired},
                                          {"mean", Interaction::Mean}},
                                         o.interaction);
  o.freedom = s->choice<Freedom>(
      "freedom", {{"six", Freedom::Six}, {"four", Freedom::Four}, {"three", Freedom::Three}},
      o.freedom);
  o.gain_per_s = s->number("gain_per_s", o.gain_per_s);
  return checked(*s, o);
}

CommandLimits read_command_limits(const Section& root) {
  CommandLimits o;
  const auto s = root.child_if("limits");
  if (!s) return o;
  if (const auto speed = s->child_if("speed")) {
    o.speed = read_velocities(*speed, o.speed, "m_s", "deg_s");
  }
  if (const auto acceleration = s->child_if("acceleration")) {
    o.acceleration = read_velocities(*acceleration, o.acceleration, "m_s2", "deg_s2");
  }
  return checked(*s, o);
}

LossOptions read_loss_options(const Section& root) {
  LossOptions o;
  const auto s = root.child_if("loss");
  if (!s) return o;
  o.hold_s = s->number("hold_s", o.hold_s);
  o.decay_s = s->number("decay_s", o.decay_s);
  o.hover_after_s = s->number("hover_after_s", o.hover_after_s);
  return checked(*s, o);
}

}  // namespace kestrel
