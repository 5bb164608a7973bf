#include "bench/stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "bench/stress_light.hpp"
#include "bench/stress_motion.hpp"
#include "bench/stress_scene.hpp"

namespace kestrel::test {
namespace {

constexpr double kRate_hz = 30;
constexpr double kMinVisible = 0.6;
constexpr int kMostSubframes = 32;

/// Of the frames between two jumps the last ones do not show the target.
constexpr int kVisibleFrames = 18;
enum class Gap { None, Black, White, Grey, Wall, OtherPoster };

/// All that one sequence is made of; never changed.
struct Plan {
  StressOptions options;
  std::string name;
  cv::Size template_px;
  StressMotion motion;
  StressScene scene;
  std::vector<float> noise;
};

Gap gap(const Plan& plan, std::int64_t frame) {
  const int period = plan.motion.jump_frames;
  if (period == 0 || frame % period < kVisibleFrames) return Gap::None;
  constexpr std::array<Gap, 5> kTurns = {Gap::Black, Gap::Wall, Gap::White, Gap::OtherPoster,
                                         Gap::Grey};
  return kTurns[std::size_t(frame / period) % kTurns.size()];
}

/// Template px to frame px at an instant.
Homography image_from_template(const Plan& plan, double t_frames) {
  const TargetPose pose = plan.motion.at(t_frames).camera_from_target();
  Eigen::Matrix3d K;
  K << kFocal_px, 0, 319.5, 0, kFocal_px, 239.5, 0, 0, 1;
  Eigen::Matrix3d ray_from_plane;
  ray_from_plane << pose.rotation.leftCols<2>(), pose.translation;
  Eigen::Matrix3d plane_from_template;
  plane_from_template << 1, 0, -(plan.template_px.width - 1) / 2., 0, 1,
      -(plan.template_px.height - 1) / 2., 0, 0, kPxPerMetre;
  return {K * ray_from_plane * plane_from_template};
}

Corners corners_at(const Plan& plan, double t_frames) {
  return outline(image_from_template(plan, t_frames), plan.template_px.width,
                 plan.template_px.height);
}

/// Instants at which an open shutter is sampled: close enough that no corner moves more than 0.7 px
/// from one to the next.
std::vector<double> instants(const Plan& plan, std::int64_t frame) {
  const double open = frame == 0 ? 0 : stress_exposure(plan.options.cls);
  if (open == 0) return {double(frame)};
  constexpr int kSteps = 8;
  double path_px = 0;
  Corners before = corners_at(plan, double(frame) - open / 2);
  for (int i = 1; i <= kSteps; ++i) {
    const Corners now = corners_at(plan, double(frame) + open * (double(i) / kSteps - 0.5));
    double longest = 0;
    for (std::size_t c = 0; c < 4; ++c) longest = std::max(longest, distance(before[c], now[c]));
    path_px += longest;
    before = now;
  }
  const int n = std::clamp(int(std::ceil(path_px / 0.7)), 2, kMostSubframes);
  std::vector<double> result;
  for (int i = 0; i < n; ++i) result.push_back(double(frame) + open * ((i + 0.5) / n - 0.5));
  return result;
}

/// Mean over the exposure.
Corners corners_seen(const Plan& plan, std::int64_t frame) {
  const std::vector<double> times = instants(plan, frame);
  Corners sum{};
  for (const double t : times) {
    const Corners at = corners_at(plan, t);
    for (std::size_t c = 0; c < 4; ++c) {
      sum[c].u += at[c].u / double(times.size());
      sum[c].v += at[c].v / double(times.size());
    }
  }
  return sum;
}

double visible_share(const Plan& plan, std::int64_t frame) {
  const Homography H = image_from_template(plan, double(frame));
  constexpr int kGrid = 20;
  int inside = 0;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const Pixel p = H * Pixel{(i % kGrid + 0.5) / kGrid * plan.template_px.width - 0.5,
                              (double(i / kGrid) + 0.5) / kGrid * plan.template_px.height - 0.5};
    inside += p.u > 0 && p.v > 0 && p.u < 639 && p.v < 479 ? 1 : 0;
  }
  return inside / double(kGrid * kGrid);
}

/// Passes over the poster from side to side, turning; far from it in frame 0.
TargetPose target_from_occluder(double t_frames) {
  const double along = 1.1 * std::cos(2 * M_PI * t_frames / 120);
  const double direction = 2 * M_PI * t_frames / 330 + 0.3;
  const double turn = 2 * M_PI * t_frames / 200;
  TargetPose pose;
  pose.rotation << std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1;
  pose.translation << along * std::cos(direction), along * std::sin(direction), 0;
  return pose;
}

cv::Mat light(const Plan& plan, std::int64_t frame, StressScene::Shown shown) {
  cv::Mat sum(480, 640, CV_32F, cv::Scalar(0));
  const std::vector<double> times = instants(plan, frame);
  for (const double t : times) {
    const TargetPose pose = plan.motion.at(t).camera_from_target();
    cv::Mat view = plan.scene.view(pose, shown);
    if (plan.options.cls == "occlusion") {
      const TargetPose in_target = target_from_occluder(t);
      plan.scene.occlude(view, {pose.rotation * in_target.rotation,
                                pose.rotation * in_target.translation + pose.translation});
    }
    sum += view;
  }
  return sum / double(times.size());
}

cv::Mat picture(const Plan& plan, std::int64_t frame) {
  const Gap what = gap(plan, frame);
  if (what == Gap::Black) return cv::Mat(480, 640, CV_8U, cv::Scalar(0));
  if (what == Gap::White) return cv::Mat(480, 640, CV_8U, cv::Scalar(255));
  if (what == Gap::Grey) return cv::Mat(480, 640, CV_8U, cv::Scalar(128));
  const auto shown = what == Gap::Wall          ? StressScene::Shown::Wall
                     : what == Gap::OtherPoster ? StressScene::Shown::OtherPoster
                                                : StressScene::Shown::Poster;
  return exposed(light(plan, frame, shown), stress_light(plan.options.cls, frame), plan.noise,
                 plan.name + " noise " + std::to_string(frame));
}

class StressSource final : public FrameSource {
 public:
  explicit StressSource(std::shared_ptr<const Plan> plan) : plan_(std::move(plan)) {}

  std::optional<Frame> next() override {
    if (next_ >= plan_->options.frames) return std::nullopt;
    Frame frame{next_, double(next_) / kRate_hz, picture(*plan_, next_), {}};
    ++next_;
    return frame;
  }
  const std::vector<std::string>& skipped() const override { return skipped_; }
  std::optional<std::int64_t> frame_count() const override { return plan_->options.frames; }

 private:
  std::shared_ptr<const Plan> plan_;  // shared with the sequence that opened this source
  std::int64_t next_ = 0;
  std::vector<std::string> skipped_;
};

}  // namespace

std::vector<std::string> stress_classes() {
  return {"nominal",   "scale",  "rotation",      "tilt", "blur",     "noise",
          "occlusion", "flight", "flight_window", "fast", "blackout", "small"};
}

void StressOptions::check() const {
  stress_motion(cls, "");
  stress_texture(texture);
  if (frames < 1) throw std::invalid_argument("frames: must be at least 1");
}

StressSequence stress_sequence(const StressOptions& options) {
  options.check();
  const StressTexture texture = stress_texture(options.texture);
  const std::string name = options.cls + "/" + options.texture + "/" + std::to_string(options.seed);
  const cv::Size size = poster_size(options.cls, load_picture(texture.file).size());
  const auto plan = std::make_shared<const Plan>(
      Plan{options, name, size, stress_motion(options.cls, name),
           StressScene(options.cls, texture, size), noise_table(name + " noise")});
  StressSequence result;
  result.sequence.name = name;
  result.sequence.template_px = {320. - size.width / 2, 240. - size.height / 2, double(size.width),
                                 double(size.height)};
  result.sequence.open = [plan] { return std::make_unique<StressSource>(plan); };
  for (std::int64_t frame = 0; frame < options.frames; ++frame) {
    if (gap(*plan, frame) != Gap::None) {
      result.absent.insert(frame);
    } else if (visible_share(*plan, frame) >= kMinVisible) {
      result.sequence.truth[frame] = corners_seen(*plan, frame);
    }
  }
  return result;
}

}  // namespace kestrel::test
