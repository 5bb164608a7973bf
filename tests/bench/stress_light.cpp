#include "bench/stress_light.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "support/random.hpp"

namespace kestrel::test {
namespace {

constexpr int kTableBits = 18;
constexpr double kShadowEdge_px = 40;
constexpr double kMidGrey = 128;

double turn(std::int64_t frame, double period_frames) {
  return 2 * M_PI * double(frame) / period_frames;
}

StressLight uneven(std::int64_t frame) {
  StressLight light;
  light.noise_grey = 8;
  const double s = std::sin(turn(frame, 75));
  light.gain = std::exp(s > 0 ? s * std::log(1.6) : -s * std::log(0.5));
  light.bias_grey = 40 * std::sin(turn(frame, 52));
  light.shade = 0.3 * std::sin(turn(frame, 160));
  light.shade_angle = turn(frame, 110);
  light.shadow = 0.4;
  light.shadow_at_px = 420 * std::cos(turn(frame, 90));
  return light;
}

/// Share of the light that reaches each pixel.
cv::Mat falloff(const StressLight& how, cv::Size size) {
  cv::Mat share(size, CV_32F);
  const double c = std::cos(how.shade_angle);
  const double s = std::sin(how.shade_angle);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const double along = c * (u - (size.width - 1) / 2.) + s * (v - (size.height - 1) / 2.);
      const double hidden = 0.5 + 0.5 * std::tanh((along - how.shadow_at_px) / kShadowEdge_px);
      share.at<float>(v, u) = float((1 + how.shade * along / 320) * (1 - how.shadow * hidden));
    }
  }
  return share;
}

void add_noise(cv::Mat& light, double sigma, const std::vector<float>& table,
               const std::string& name) {
  Random random(name);
  const int width = light.cols;
  for (int v = 0; v < light.rows; ++v) {
    const float* noise = &table[std::size_t(random.integer(0, int(table.size()) - width))];
    auto* row = light.ptr<float>(v);
    for (int u = 0; u < width; ++u) row[u] += float(sigma) * noise[u];
  }
}

}  // namespace

StressLight stress_light(const std::string& cls, std::int64_t frame) {
  StressLight light;
  if (frame == 0) return light;
  if (cls == "noise") return uneven(frame);
  light.noise_grey = 1.5;  // of a camera by day
  if (cls == "blur") light.defocus_px = 1 - std::cos(turn(frame, 70));
  if (cls == "flight" || cls == "flight_window") {
    light.noise_grey = 4;
    light.defocus_px = 0.6;
  }
  if (cls == "gust") {  // at dusk
    light.noise_grey = 8;
    light.defocus_px = 0.8;
    light.gain = 0.6;
  }
  return light;
}

double stress_exposure(const std::string& cls) {
  if (cls == "blur") return 0.6;
  if (cls == "gust") return 0.7;
  if (cls == "flight" || cls == "flight_window") return 0.4;
  return 0;
}

std::vector<float> noise_table(const std::string& name) {
  Random random(name);
  std::vector<float> table(std::size_t(1) << kTableBits);
  for (float& x : table) x = float(random.normal());
  return table;
}

cv::Mat exposed(const cv::Mat& light, const StressLight& how, const std::vector<float>& table,
                const std::string& name) {
  cv::Mat sum = light.clone();
  if (how.shade != 0 || how.shadow != 0) sum = sum.mul(falloff(how, sum.size()));
  if (how.defocus_px > 0.05) {
    cv::GaussianBlur(sum, sum, {}, how.defocus_px, 0, cv::BORDER_REPLICATE);
  }
  sum.convertTo(sum, CV_32F, how.gain, kMidGrey * (1 - how.gain) + how.bias_grey);
  if (how.noise_grey > 0) add_noise(sum, how.noise_grey, table, name);
  cv::Mat gray;
  sum.convertTo(gray, CV_8U);
  return gray;
}

}  // namespace kestrel::test
