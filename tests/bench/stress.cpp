#include "bench/stress.hpp"

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>

#include <opencv2/core.hpp>

#include "bench/stress_light.hpp"
#include "bench/stress_motion.hpp"
#include "bench/stress_scene.hpp"
#include "bench/stress_view.hpp"

namespace kestrel::test {
namespace {

constexpr double kRate_hz = 30;
constexpr double kMinVisible = 0.6;

/// Of the frames between two jumps the last ones do not show the target.
constexpr int kVisibleFrames = 18;
enum class Gap { None, Black, White, Grey, Wall, OtherPoster };

/// All that one sequence is made of; never changed.
struct Plan {
  StressOptions options;
  std::string name;
  StressView view;
  StressScene scene;
  std::vector<float> noise;
};

Gap gap(const Plan& plan, std::int64_t frame) {
  const int period = plan.view.motion.jump_frames;
  if (period == 0 || frame % period < kVisibleFrames) return Gap::None;
  constexpr std::array<Gap, 5> kTurns = {Gap::Black, Gap::Wall, Gap::White, Gap::OtherPoster,
                                         Gap::Grey};
  return kTurns[std::size_t(frame / period) % kTurns.size()];
}

cv::Mat light(const Plan& plan, std::int64_t frame, StressScene::Shown shown) {
  cv::Mat sum(480, 640, CV_32F, cv::Scalar(0));
  const std::vector<double> times = instants(plan.view, frame);
  for (const double t : times) {
    const TargetPose pose = plan.view.motion.at(t).camera_from_target();
    cv::Mat view = plan.scene.view(pose, shown);
    if (plan.options.cls == "occlusion") {
      plan.scene.occlude(view, pose * occluder_pose(t));
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
  return {"nominal", "scale",         "rotation", "tilt", "blur",     "noise", "occlusion",
          "flight",  "flight_window", "gust",     "fast", "blackout", "small"};
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
  const auto plan =
      std::make_shared<const Plan>(Plan{options,
                                        name,
                                        {options.cls, size, stress_motion(options.cls, name)},
                                        StressScene(options.cls, texture, size),
                                        noise_table(name + " noise")});
  StressSequence result;
  result.sequence.name = name;
  result.sequence.template_px = {320 - size.width / 2., 240 - size.height / 2., double(size.width),
                                 double(size.height)};
  result.sequence.open = [plan] { return std::make_unique<StressSource>(plan); };
  for (std::int64_t frame = 0; frame < options.frames; ++frame) {
    if (gap(*plan, frame) != Gap::None) {
      result.absent.insert(frame);
    } else if (visible_share(plan->view, double(frame)) >= kMinVisible) {
      result.sequence.truth[frame] = corners_seen(plan->view, frame);
    }
  }
  return result;
}

std::vector<cv::Mat> rendered_frames(const StressSequence& sequence) {
  std::vector<cv::Mat> frames;
  const auto source = sequence.sequence.open();
  while (const auto frame = source->next()) frames.push_back(frame->gray.clone());
  return frames;
}

}  // namespace kestrel::test
