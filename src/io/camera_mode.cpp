#include "kestrel/io/camera_mode.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace kestrel {
namespace {

constexpr double kUsualArea_px = 640.0 * 480.0;
constexpr double kRateTolerance = 0.01;  // 29.97 is 30

/// The rate in a mode: the lowest that reaches what is asked for, else the highest; empty when none
/// reaches it.
std::optional<double> rate_of(const CameraMode& mode, const CaptureSettings& settings) {
  if (mode.rates_hz.empty()) return settings.rate_hz.value_or(0);
  if (!settings.rate_hz) return *std::max_element(mode.rates_hz.begin(), mode.rates_hz.end());
  std::optional<double> lowest;
  for (const double rate : mode.rates_hz) {
    if (rate < *settings.rate_hz * (1 - kRateTolerance)) continue;
    if (!lowest || rate < *lowest) lowest = rate;
  }
  return lowest;
}

std::string list_of(const std::vector<CameraMode>& modes) {
  std::string list;
  for (const CameraMode& mode : modes) list += (list.empty() ? "" : "; ") + to_string(mode);
  return list.empty() ? "nothing that it names" : list;
}

std::string wish(const CaptureSettings& s) {
  std::string text = s.format.empty() ? "a picture" : s.format;
  if (s.size) text += fmt::format(" of {}x{}", s.size->width, s.size->height);
  if (s.rate_hz) text += fmt::format(" at {} Hz", *s.rate_hz);
  return text;
}

}  // namespace

std::string to_string(const CameraMode& mode) {
  std::string text = fmt::format("{} {}x{}", mode.format, mode.size.width, mode.size.height);
  for (std::size_t i = 0; i < mode.rates_hz.size(); ++i)
    text += fmt::format("{}{:.4g}", i == 0 ? " at " : ", ", mode.rates_hz[i]);
  return mode.rates_hz.empty() ? text : text + " Hz";
}

ChosenMode choose_mode(const std::vector<CameraMode>& modes, const CaptureSettings& settings,
                       const std::vector<std::string>& formats) {
  std::optional<ChosenMode> best;
  std::tuple<double, std::ptrdiff_t, double> best_cost;
  for (const CameraMode& mode : modes) {
    const auto known = std::find(formats.begin(), formats.end(), mode.format);
    const bool is_wanted = settings.format.empty() || settings.format == mode.format;
    if (known == formats.end() || !is_wanted) continue;
    if (settings.size && *settings.size != mode.size) continue;
    const auto rate = rate_of(mode, settings);
    if (!rate) continue;
    const std::tuple<double, std::ptrdiff_t, double> cost{
        std::abs(std::log(std::max(1.0, mode.size.area() / 1.0) / kUsualArea_px)),
        known - formats.begin(), settings.rate_hz ? *rate : -*rate};
    if (best && !(cost < best_cost)) continue;
    best = ChosenMode{mode, *rate};
    best_cost = cost;
  }
  if (best) return *best;
  throw std::runtime_error("it cannot send " + wish(settings) + "; it has " + list_of(modes));
}

}  // namespace kestrel
