#include "kestrel/lab/helicopter_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "modifier_words.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr int kLongestFrames = 100000;

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("conditions: ") + what);
}

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

[[noreturn]] void reject(const std::string& word) {
  throw std::invalid_argument("modifier \"" + word +
                              "\" is none of kz p d l n t roll pitch yaw loss (with a number), "
                              "pred, ff, free, hold, hover, seed0.93");
}

/// What a word with a number behind it does.
struct Numbered {
  std::string letters;
  std::function<void(HelicopterConditions&, double)> change;
};

int whole(double value) {
  const bool fits = value == std::floor(value) && std::abs(value) <= kLongestFrames;
  return fits ? int(value) : -1;  // which check() refuses
}

const std::vector<Numbered>& numbered_words() {
  using C = HelicopterConditions;
  static const std::vector<Numbered> words = {
      {"kz", [](C& c, double x) { c.depth_factor = x; }},
      {"p", [](C& c, double x) { c.period_frames = whole(x); }},
      {"d", [](C& c, double x) { c.delay_frames = whole(x); }},
      {"l", [](C& c, double x) { c.gain_per_s = x; }},
      {"n", [](C& c, double x) { c.noise_px = x; }},
      {"t", [](C& c, double x) { c.duration_s = x; }},
      {"roll", [](C& c, double x) { c.roll_bias_rad = x * kDegree; }},
      {"pitch", [](C& c, double x) { c.pitch_bias_rad = x * kDegree; }},
      {"yaw", [](C& c, double x) { c.yaw_bias_rad = x * kDegree; }},
      {"loss",
       [](C& c, double x) {
         c.loss = TargetLoss{x, c.duration_s};
       }},
  };
  return words;
}

/// The longest beginning of the word that is no number, and the number.
HelicopterConditions with_number(HelicopterConditions c, const std::string& word) {
  const std::size_t letters = std::min(word.find_first_of("0123456789+-."), word.size());
  for (const Numbered& known : numbered_words()) {
    if (known.letters != word.substr(0, letters)) continue;
    const std::optional<double> value = number_behind(word, letters);
    if (!value) reject(word);
    known.change(c, *value);
    return c;
  }
  reject(word);
}

HelicopterConditions with_word(HelicopterConditions c, const std::string& word) {
  if (word == "pred") {
    c.predicted = true;
  } else if (word == "ff") {
    c.feed_forward = true;
  } else if (word == "free") {
    c.limits.reset();
  } else if (word == "hold") {
    c.reaction = LossReaction::Hold;
  } else if (word == "hover") {
    c.reaction = LossReaction::Hover;
  } else if (word == "seed0.93") {
    c.period_frames = 28;
    c.delay_frames = 28;
    c.duration_s = 80;
  } else {
    return with_number(c, word);
  }
  return c;
}

}  // namespace

const char* name(LossReaction reaction) {
  switch (reaction) {
    case LossReaction::Failsafe:
      return "failsafe";
    case LossReaction::Hold:
      return "hold";
    case LossReaction::Hover:
      return "hover";
  }
  return "unknown";
}

void HelicopterConditions::check() const {
  demand(!gain_per_s || is_positive(*gain_per_s), "gain_per_s must be above 0");
  demand(is_positive(duration_s) && duration_s <= 3600, "duration_s must be above 0, up to 3600");
  demand(period_frames >= 1 && period_frames <= kLongestFrames, "period_frames must be 1 or more");
  demand(delay_frames >= 0 && delay_frames <= kLongestFrames, "delay_frames must be 0 or more");
  demand(is_positive(depth_factor), "depth_factor must be above 0");
  demand(std::isfinite(noise_px) && noise_px >= 0, "noise_px must not be negative");
  const auto is_tilt = [](double angle) { return std::abs(angle) < M_PI / 2; };
  demand(is_tilt(roll_bias_rad), "roll_bias_rad must be within a quarter turn");
  demand(is_tilt(pitch_bias_rad), "pitch_bias_rad must be within a quarter turn");
  demand(std::abs(yaw_bias_rad) <= M_PI, "yaw_bias_rad must be within half a turn");
  demand(!loss || (std::isfinite(loss->from_s) && loss->from_s >= 0),
         "loss.from_s must not be negative");
  demand(!loss || (std::isfinite(loss->for_s) && loss->for_s >= 0),
         "loss.for_s must not be negative");
  if (limits) limits->check();
  failsafe.check();
  plant.check();
}

HelicopterConditions modified(const HelicopterConditions& conditions, const std::string& modifier) {
  return with_words(conditions, modifier, with_word);
}

}  // namespace kestrel
