// return_table: how often a template that was lost is found in the first frame that shows it again,
// by its size and the size it comes back at, turned by angles all around.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>

#include "kestrel/vision/tracker.hpp"

#include "bench/guarded.hpp"
#include "bench/stress_light.hpp"
#include "bench/stress_motion.hpp"
#include "bench/stress_scene.hpp"
#include "bench/stress_texture.hpp"

namespace kestrel::test {
namespace {

/// Of a pixel, grey levels: a camera's in daylight.
constexpr double kNoise_grey = 2;

/// As stress_score: nearer is right, farther is wrong.
constexpr double kRight_px = 5;
constexpr double kWrong_px = 10;

struct Arguments {
  std::string set = "dev";
  TrackMethod method = TrackMethod::Hybrid;
  std::vector<std::string> textures;
  std::vector<int> widths_px{60, 64, 96, 128, 160};
  std::vector<double> scales{0.5, 0.7, 1, 1.4, 2};
  int turns = 12;
  double away_s = 3;
};

Arguments arguments(int argc, char** argv) {
  Arguments a;
  CLI::App app("Templates that come back after a loss");
  app.add_option("--set", a.set, "dev or held-out")->check(CLI::IsMember({"dev", "held-out"}));
  app.add_option("--method", a.method, "hybrid or detect")
      ->transform(CLI::CheckedTransformer(std::map<std::string, TrackMethod>{
          {"hybrid", TrackMethod::Hybrid}, {"detect", TrackMethod::Detect}}));
  app.add_option("--texture", a.textures, "only these, of either set");
  app.add_option("--width", a.widths_px, "of the templates, px; their height is 4/5 of it");
  app.add_option("--scale", a.scales, "of the template when it comes back");
  app.add_option("--turns", a.turns, "angles all around")->check(CLI::PositiveNumber);
  app.add_option("--away", a.away_s, "s without it")->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));  // NOLINT(concurrency-mt-unsafe)
  }
  if (a.textures.empty()) {
    a.textures = texture_names(a.set == "dev" ? StressSet::Dev : StressSet::HeldOut);
  }
  return a;
}

/// One template, and what a camera sees of it.
class ReturnScene {
 public:
  ReturnScene(const std::string& texture, cv::Size px)
      : name_(texture + " " + std::to_string(px.width)),
        px_(px),
        scene_("nominal", stress_texture(texture), px),
        noise_(noise_table(name_)) {}

  Frame frame(const StressPose& pose, StressScene::Shown shown, double stamp_s) const {
    StressLight light;
    light.noise_grey = kNoise_grey;
    const cv::Mat gray = exposed(scene_.view(pose.camera_from_target(), shown), light, noise_,
                                 name_ + " " + std::to_string(stamp_s));
    return {0, stamp_s, gray, {}};
  }

  PixelBox learned_at() const {
    return {320 - px_.width / 2., 240 - px_.height / 2., double(px_.width), double(px_.height)};
  }

  /// Mean distance of the corners from where they are in that pose, px.
  double error_px(const Homography& seen, const StressPose& pose) const {
    const TargetPose camera_from_target = pose.camera_from_target();
    const auto at = outline(seen, px_.width, px_.height);
    const std::array<std::pair<int, int>, 4> ends{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = ends[i].first * (px_.width - 1) / 2. / kPxPerMetre;
      const double y = ends[i].second * (px_.height - 1) / 2. / kPxPerMetre;
      const Eigen::Vector3d p = camera_from_target * Eigen::Vector3d(x, y, 0);
      const Pixel to{319.5 + kFocal_px * p.x() / p.z(), 239.5 + kFocal_px * p.y() / p.z()};
      sum += distance(at[i], to);
    }
    return sum / 4;
  }

 private:
  std::string name_;
  cv::Size px_;
  StressScene scene_;
  std::vector<float> noise_;
};

/// Where it comes back: elsewhere in the image, wholly in it, its sides never along the pixels.
StressPose pose_of(double scale, int turn, int turns, cv::Size px) {
  StressPose pose;
  pose.scale = scale;
  pose.roll = 2 * M_PI * (turn + 0.25) / turns;
  const double reach_px = scale * std::hypot(px.width, px.height) / 2 + 4;
  const double around = 2 * M_PI * (turn * 5 % turns) / turns;
  pose.centre.u += std::max(0.0, 319.5 - reach_px) * 0.9 * std::cos(around);
  pose.centre.v += std::max(0.0, 239.5 - reach_px) * 0.9 * std::sin(around);
  return pose;
}

struct Count {
  int shown = 0;
  int right = 0;
  int wrong = 0;
  std::map<std::string, int> missed_for;
  std::vector<double> ms;
};

std::string listed(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [word, n] : counts) text += " " + word + ":" + std::to_string(n);
  return text;
}

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

/// Learned, seen once, missed once, then shown again: each time as if for the first time.
void count(const std::string& texture, int width_px, const Arguments& a,
           std::map<double, Count>& by_scale) {
  const cv::Size px{width_px, width_px * 2 / 5 * 2};
  const ReturnScene scene(texture, px);
  const Frame first = scene.frame({}, StressScene::Shown::Poster, 0);
  TrackOptions options;
  options.method = a.method;
  Tracker tracker(first.gray, scene.learned_at(), options);
  TrackState state = tracker.track(first, tracker.start(640, 480)).next;
  state = tracker.track(scene.frame({}, StressScene::Shown::Wall, 0.04), state).next;
  for (const double scale : a.scales) {
    Count& c = by_scale[scale];
    for (int turn = 0; turn < a.turns; ++turn) {
      const StressPose pose = pose_of(scale, turn, a.turns, px);
      const Frame back = scene.frame(pose, StressScene::Shown::Poster, a.away_s + 1e-3 * turn);
      const double before_ms = cpu_ms();
      const Track seen = tracker.track(back, state);
      c.ms.push_back(cpu_ms() - before_ms);
      ++c.shown;
      if (!seen.found()) {
        ++c.missed_for[name(seen.miss)];
        continue;
      }
      const double error_px = scene.error_px(*seen.image_from_template, pose);
      c.right += error_px < kRight_px ? 1 : 0;
      c.wrong += error_px > kWrong_px ? 1 : 0;
    }
  }
}

int run(int argc, char** argv) {
  cv::setNumThreads(1);
  const Arguments a = arguments(argc, argv);
  std::printf("%6s %6s %6s %8s %6s %8s %8s  %s\n", "width", "scale", "shown", "found %", "wrong",
              "med ms", "max ms", "missed for");
  for (const int width_px : a.widths_px) {
    std::map<double, Count> by_scale;
    for (const std::string& texture : a.textures) count(texture, width_px, a, by_scale);
    for (auto& [scale, c] : by_scale) {
      std::sort(c.ms.begin(), c.ms.end());
      std::printf("%6d %6.2f %6d %8.1f %6d %8.2f %8.2f %s\n", width_px, scale, c.shown,
                  100.0 * c.right / c.shown, c.wrong, c.ms[c.ms.size() / 2], c.ms.back(),
                  listed(c.missed_for).c_str());
    }
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace kestrel::test

int main(int argc, char** argv) { return kestrel::test::guarded(kestrel::test::run, argc, argv); }
