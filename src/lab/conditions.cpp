#include "kestrel/lab/conditions.hpp"

#include <cmath>
#include <stdexcept>

#include "modifier_words.hpp"

namespace kestrel {
namespace {

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("conditions: ") + what);
}

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

[[noreturn]] void reject(const std::string& word) {
  throw std::invalid_argument("modifier \"" + word +
                              "\" is none of kz f u v d l r n (with a number), sat, model");
}

double number_of(const std::string& word, std::size_t letters) {
  if (const auto value = number_behind(word, letters)) return *value;
  reject(word);
}

int whole_number_of(const std::string& word, std::size_t letters) {
  const double value = number_of(word, letters);
  if (value != std::floor(value) || std::abs(value) > 1e6) reject(word);
  return int(value);
}

/// One word of a modifier's name.
Conditions with_word(Conditions c, const std::string& word) {
  constexpr int kNoisySteps = 900;
  if (word == "sat") {
    c.limits.emplace();
  } else if (word == "model") {
    c.desired = Conditions::Desired::Model;
  } else if (word.rfind("kz", 0) == 0) {
    c.depth_factor = number_of(word, 2);
  } else {
    switch (word.empty() ? '\0' : word.front()) {
      case 'f':
        c.focal_factor = number_of(word, 1);
        break;
      case 'u':
        c.principal_u_px = number_of(word, 1);
        break;
      case 'v':
        c.principal_v_px = number_of(word, 1);
        break;
      case 'd':
        c.delay_frames = whole_number_of(word, 1);
        break;
      case 'l':
        c.gain_per_s = number_of(word, 1);
        break;
      case 'r':
        c.rate_hz = number_of(word, 1);
        break;
      case 'n':
        c.noise_px = number_of(word, 1);
        c.steps = kNoisySteps;
        break;
      default:
        reject(word);
    }
  }
  return c;
}

}  // namespace

void Conditions::check() const {
  demand(!gain_per_s || is_positive(*gain_per_s), "gain_per_s must be above 0");
  demand(is_positive(rate_hz), "rate_hz must be above 0");
  demand(steps >= 1 && steps <= 10000000, "steps must be 1 to 10000000");
  demand(is_positive(depth_factor), "depth_factor must be above 0");
  demand(is_positive(focal_factor), "focal_factor must be above 0");
  demand(std::isfinite(principal_u_px), "principal_u_px must be finite");
  demand(std::isfinite(principal_v_px), "principal_v_px must be finite");
  demand(std::isfinite(noise_px) && noise_px >= 0, "noise_px must not be negative");
  demand(delay_frames >= 0 && delay_frames <= 100000, "delay_frames must be 0 to 100000");
  demand(!limits || is_positive(limits->linear_m_s), "limits.linear_m_s must be above 0");
  demand(!limits || is_positive(limits->angular_rad_s), "limits.angular_rad_s must be above 0");
}

Conditions modified(const Conditions& conditions, const std::string& modifier) {
  return with_words(conditions, modifier, with_word);
}

}  // namespace kestrel
