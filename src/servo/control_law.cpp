#include "kestrel/servo/control_law.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "laws/input_check.hpp"
#include "laws/laws.hpp"

namespace kestrel {
namespace {

void require(bool good, const char* name, const char* what, double value) {
  if (good) return;
  std::ostringstream message;
  message << name << ": must be " << what << ", is " << value;
  throw std::invalid_argument(message.str());
}

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

LawAnswer answer_of_family(const LawInput& input, const LawOptions& options,
                           const LawState& state) {
  switch (options.law) {
    case Law::Broyden:
    case Law::BroydenRaw:
    case Law::Rls:
      return laws::learned_law(input, options, state);
    case Law::Polar:
      return laws::polar_law(input, options);
    case Law::Partition:
      return laws::partition_law(input, options);
    case Law::TwoAndHalfD:
      return laws::hybrid_law(input, options);
    case Law::Homog:
      return laws::homography_law(input, options);
    case Law::PbvsCt:
    case Law::PbvsCo:
    case Law::Screw:
      return laws::pose_law(input, options);
    case Law::Moments:
      return laws::moments_law(input, options);
    case Law::Decoupled:
      return laws::decoupled_law(input, options);
    default:
      return laws::point_law(input, options);
  }
}

/// v - exp(-mu t) v(0), v(0) kept for a gain of one so that an adaptive gain scales both.
void start_smoothly(LawAnswer& answer, const LawInput& input, const LawOptions& options,
                    const LawState& state) {
  if (options.smooth_start_per_s <= 0) return;
  const Vector6d v = answer.twist->vector();
  const Vector6d first = state.first_twist.value_or(v / answer.gain_per_s);
  answer.next.first_twist = first;
  const double share = std::exp(-options.smooth_start_per_s * input.time_s);
  answer.twist = CameraTwist::from_vector(v - share * answer.gain_per_s * first);
}

}  // namespace

LawAnswer control_law(const LawInput& input, const LawOptions& options, const LawState& state) {
  const LawRefusal refusal = laws::refusal_of(input, options.law);
  if (refusal != LawRefusal::None) return laws::refused(refusal, state);
  LawAnswer answer = answer_of_family(input, options, state);
  if (answer.twist) start_smoothly(answer, input, options, state);
  if (answer.twist && !answer.twist->vector().allFinite()) {
    answer.twist.reset();
    answer.refusal = LawRefusal::Singular;
  }
  if (!answer.twist) answer.next = state;
  if (answer.refusal == LawRefusal::Singular) answer.refusal = laws::cause_of_singularity(input);
  return answer;
}

double LawGain::at(double x) const {
  const double range_per_s = at_zero_per_s - at_infinity_per_s;
  if (range_per_s == 0) return at_zero_per_s;
  return range_per_s * std::exp(-slope_at_zero_per_s * x / range_per_s) + at_infinity_per_s;
}

void LawGain::check() const {
  require(is_positive(at_zero_per_s), "at_zero_per_s", "positive and finite (1/s)", at_zero_per_s);
  require(is_positive(at_infinity_per_s) && at_infinity_per_s <= at_zero_per_s, "at_infinity_per_s",
          "positive and not above at_zero_per_s (1/s)", at_infinity_per_s);
  require(std::isfinite(slope_at_zero_per_s) && slope_at_zero_per_s >= 0, "slope_at_zero_per_s",
          "finite and not negative", slope_at_zero_per_s);
}

void LawOptions::check() const {
  try {
    gain.check();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(std::string("gain.") + e.what());
  }
  require(std::isfinite(smooth_start_per_s) && smooth_start_per_s >= 0, "smooth_start_per_s",
          "finite and not negative (1/s)", smooth_start_per_s);
  require(rank_tolerance >= 0 && rank_tolerance < 1, "rank_tolerance", "at least 0 and below 1",
          rank_tolerance);
  require(max_condition >= 1, "max_condition", "at least 1 (infinity: no limit)", max_condition);
  require(std::isfinite(damping) && damping >= 0, "damping", "finite and not negative", damping);
  require(std::isfinite(learning_gate) && learning_gate >= 0, "learning_gate",
          "finite and not negative", learning_gate);
  require(forgetting > 0 && forgetting <= 1, "forgetting", "above 0 and at most 1", forgetting);
  require(is_positive(initial_covariance), "initial_covariance", "positive and finite",
          initial_covariance);
}

const char* name(LawSolver solver) {
  switch (solver) {
    case LawSolver::Eigen:
      return "eigen";
    case LawSolver::Visp:
      return "visp";
  }
  return "unknown";
}

const char* name(LawRefusal refusal) {
  switch (refusal) {
    case LawRefusal::None:
      return "none";
    case LawRefusal::FewPoints:
      return "few_points";
    case LawRefusal::Unequal:
      return "unequal";
    case LawRefusal::NotFinite:
      return "not_finite";
    case LawRefusal::Depth:
      return "depth";
    case LawRefusal::Coincident:
      return "coincident";
    case LawRefusal::Collinear:
      return "collinear";
    case LawRefusal::Pose:
      return "pose";
    case LawRefusal::Homography:
      return "homography";
    case LawRefusal::Singular:
      return "singular";
    case LawRefusal::Unreachable:
      return "unreachable";
  }
  return "unknown";
}

}  // namespace kestrel
