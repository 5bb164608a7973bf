#include "kestrel/io/task_options.hpp"

#include <array>
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

/// The keys that cv::SIFT and Kestrel's have in common.
template <class Options>
Options read_sift(const Section& s) {
  Options o;
  o.octave_layers = s.whole("octave_layers", o.octave_layers);
  o.contrast_threshold = s.number("contrast_threshold", o.contrast_threshold);
  o.edge_threshold = s.number("edge_threshold", o.edge_threshold);
  o.sigma = s.number("sigma_px", o.sigma);
  o.max_keypoints = s.whole("max_keypoints", o.max_keypoints);
  return o;
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

/// The words of a task file for values that have names.
template <class Value, std::size_t N>
std::vector<std::pair<std::string, Value>> words(const std::array<Value, N>& all) {
  std::vector<std::pair<std::string, Value>> named;
  named.reserve(N);
  for (const Value one : all) named.emplace_back(name(one), one);
  return named;
}

DetectOptions read_detect(const Section& s) {
  DetectOptions o;
  o.source = s.choice("source", words(kSiftSources), o.source);
  if (const auto sift = s.child_if("sift")) {
    o.sift = read_sift<FastSiftOptions>(*sift);
    o.sift.is_doubled = sift->flag("doubled", o.sift.is_doubled);
  }
  if (const auto match = s.child_if("match")) {
    o.match.ratio = match->number("ratio", o.match.ratio);
    o.match.max_pairs = match->whole("max_pairs", o.match.max_pairs);
    o.match.same_place_px = match->number("same_place_px", o.match.same_place_px);
  }
  if (const auto fit = s.child_if("fit")) {
    o.fit.max_reprojection_px = fit->number("max_reprojection_px", o.fit.max_reprojection_px);
    o.fit.min_inliers = fit->whole("min_inliers", o.fit.min_inliers);
    o.fit.max_hypotheses = fit->whole("max_hypotheses", o.fit.max_hypotheses);
    o.fit.max_voters = fit->whole("max_voters", o.fit.max_voters);
  }
  o.max_px_per_frame = s.whole("max_px_per_frame", o.max_px_per_frame);
  return checked(s, o);
}

BlockOptions read_blocks(const Section& s) {
  BlockOptions o;
  o.max_blocks = s.whole("max_blocks", o.max_blocks);
  o.max_coarse_blocks = s.whole("max_coarse_blocks", o.max_coarse_blocks);
  o.noise_grey = s.number("noise_grey", o.noise_grey);
  o.model_error = s.number("model_error", o.model_error);
  return checked(s, o);
}

AlignOptions read_align(const Section& s) {
  AlignOptions o;
  o.max_iterations = s.whole("max_iterations", o.max_iterations);
  o.tolerance_px = s.number("tolerance_px", o.tolerance_px);
  o.weight_scale = s.number("weight_scale", o.weight_scale);
  o.search_radius_px = s.whole("search_radius_px", o.search_radius_px);
  if (const auto a = s.child_if("agreement")) {
    o.agreement.alike_zncc = a->number("alike_zncc", o.agreement.alike_zncc);
    o.agreement.min_alike_share = a->number("min_alike_share", o.agreement.min_alike_share);
    o.agreement.min_better_half = a->number("min_better_half", o.agreement.min_better_half);
    o.agreement.min_visible_share = a->number("min_visible_share", o.agreement.min_visible_share);
    o.agreement.min_alike = a->whole("min_alike", o.agreement.min_alike);
  }
  return checked(s, o);
}

MotionOptions read_motion(const Section& s) {
  MotionOptions o;
  o.acceleration_px_s2 = s.number("acceleration_px_s2", o.acceleration_px_s2);
  o.first_speed_px_s = s.number("first_speed_px_s", o.first_speed_px_s);
  o.longest_gap_s = s.number("longest_gap_s", o.longest_gap_s);
  return checked(s, o);
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
  o.method = s->choice("method", words(kTrackMethods), o.method);
  o.window = s->choice("window", words(kWindowPolicies), o.window);
  o.simd = s->choice("simd", words(kSimds), o.simd);
  if (const auto detect = s->child_if("detect")) o.detect = read_detect(*detect);
  if (const auto blocks = s->child_if("blocks")) o.blocks = read_blocks(*blocks);
  if (const auto align = s->child_if("align")) o.align = read_align(*align);
  if (const auto motion = s->child_if("motion")) o.motion = read_motion(*motion);
  o.coast_s = s->number("coast_s", o.coast_s);
  o.weak_share = s->number("weak_share", o.weak_share);
  o.weak_frames = s->whole("weak_frames", o.weak_frames);
  if (const auto sift = s->child_if("sift")) o.sift = checked(*sift, read_sift<SiftOptions>(*sift));
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

namespace {

/// law, by any of its names; interaction, by what the three best known matrices were called first.
Law read_law(const Section& s, Law otherwise) {
  if (!s.has("interaction")) {
    std::vector<std::pair<std::string, Law>> words;
    for (const Law law : all_laws()) words.emplace_back(name(law), law);
    return s.choice<Law>("law", words, otherwise);
  }
  if (s.has("law")) s.fail("interaction", "stands beside law, which says the same; keep one");
  return s.choice<Law>("interaction",
                       {{"current", Law::Cur}, {"desired", Law::Des}, {"mean", Law::Mean}});
}

}  // namespace

ServoOptions read_servo_options(const Section& root) {
  ServoOptions o;
  const auto s = root.child_if("servo");
  if (!s) return o;
  o.law = read_law(*s, o.law);
  o.freedom = s->choice<Freedom>(
      "freedom", {{"six", Freedom::Six}, {"four", Freedom::Four}, {"three", Freedom::Three}},
      o.freedom);
  o.gain_per_s = s->number("gain_per_s", o.gain_per_s);
  if (s->has("far_gain_per_s")) o.far_gain_per_s = s->number("far_gain_per_s");
  o.gain_slope_per_s = s->number("gain_slope_per_s", o.gain_slope_per_s);
  o.smooth_start_per_s = s->number("smooth_start_per_s", o.smooth_start_per_s);
  o.damping = s->number("damping", o.damping);
  o.learning_gate = s->number("learning_gate", o.learning_gate);
  o.forgetting = s->number("forgetting", o.forgetting);
  o.initial_covariance = s->number("initial_covariance", o.initial_covariance);
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

TimingOptions read_timing_options(const Section& root) {
  TimingOptions o;
  const auto s = root.child_if("timing");
  if (!s) return o;
  o.predict = s->choice<Prediction>("predict",
                                    {{name(Prediction::Off), Prediction::Off},
                                     {name(Prediction::Measured), Prediction::Measured},
                                     {name(Prediction::Commanded), Prediction::Commanded}},
                                    o.predict);
  o.gain_share = s->number("gain_share", o.gain_share);
  if (s->has("latency_s")) o.latency_s = s->number("latency_s");
  o.response.velocity_s = s->number("velocity_time_constant_s", o.response.velocity_s);
  o.response.tilt_s = s->number("tilt_time_constant_s", o.response.tilt_s);
  o.response.vertical_s = s->number("vertical_time_constant_s", o.response.vertical_s);
  o.response.yaw_s = s->number("yaw_time_constant_s", o.response.yaw_s);
  return checked(*s, o);
}

}  // namespace kestrel
