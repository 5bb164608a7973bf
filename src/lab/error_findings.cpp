#include "error_findings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "kestrel/eval/spread.hpp"

#include "oscillation.hpp"

namespace kestrel {
namespace {

/// Median error norm of rows [from, to) as shares of all.
double median_error(const LogRows& rows, double from, double to) {
  std::vector<double> values;
  const auto n = double(rows.size());
  for (auto i = std::size_t(from * n); i < std::size_t(std::ceil(to * n)); ++i) {
    values.push_back(rows[i]->servo->error_norm);
  }
  return median_of(std::move(values));
}

/// Rate of the exponential decay of the error from the start to where a tenth is left, 1/s.
std::optional<double> decay_rate_per_s(const LogRows& rows, double first) {
  double n = 0, t = 0, y = 0, tt = 0, ty = 0;
  for (const LogRow* row : rows) {
    if (row->servo->error_norm < 0.1 * first) break;
    if (!(row->servo->error_norm > 0)) break;
    const double at = row->stamp_s - rows.front()->stamp_s;
    const double log_error = std::log(row->servo->error_norm);
    n += 1;
    t += at;
    y += log_error;
    tt += at * at;
    ty += at * log_error;
  }
  const double spread = n * tt - t * t;
  if (n < 3 || !(spread > 0)) return std::nullopt;
  return -(n * ty - t * y) / spread;
}

/// A motion of the target in the image: a share of each of the eight errors.
struct Motion {
  const char* words;
  std::array<double, 8> share;
};
constexpr std::array<Motion, 3> kMotions{
    {{"from side to side", {.25, 0, .25, 0, .25, 0, .25, 0}},
     {"up and down", {0, .25, 0, .25, 0, .25, 0, .25}},
     {"back and forth (in size)", {-.25, 0, .25, 0, .25, 0, -.25, 0}}}};

/// The swing of one motion in the last two thirds of the run.
std::optional<Oscillation> swing(const LogRows& rows, const Motion& motion) {
  std::vector<double> times_s;
  std::vector<double> values;
  for (std::size_t i = rows.size() / 3; i < rows.size(); ++i) {
    const auto& e = rows[i]->servo->error;
    times_s.push_back(rows[i]->stamp_s);
    values.push_back(std::inner_product(e.begin(), e.end(), motion.share.begin(), 0.));
  }
  return oscillation(times_s, values);
}

/// Smallest swing worth a word, on the normalised plane: some pixels of any usual lens.
constexpr double kSwing = 0.01;

/// Below this |v| / (gain |e|) hardly any of the error is one that a motion could take away: the
/// largest singular value of L being below 5 for points inside usual images, an error that could
/// be taken away gives 0.2 at least.
constexpr double kStall = 0.05;
constexpr double kErrorLeft = 0.02;  // normalised plane

}  // namespace

double median_of(std::vector<double> values) {
  const auto spread = spread_of(std::move(values));
  return spread ? spread->median : 0;
}

Finding error_course(const LogRows& rows, double gain_per_s) {
  const double first = median_error(rows, 0, 0.05);
  const double last = median_error(rows, 0.9, 1);
  std::string what = fmt::format("the error went from {:.3g} to {:.3g}", first, last);
  if (last < 0.1 * first) {
    if (const auto rate = decay_rate_per_s(rows, first)) {
      what += fmt::format(", at {:.2f} per second on the way (gain {:.2f})", *rate, gain_per_s);
    }
    return {Weight::Fine, "error", what, ""};
  }
  const char* remedy =
      "the findings below say where it was held up; without one, give it more time";
  return {last > first ? Weight::Fault : Weight::Doubt, "error", what, remedy};
}

void look_at_swing(const LogRows& rows, double gain_per_s, std::vector<Finding>& findings) {
  for (const Motion& motion : kMotions) {
    const auto found = swing(rows, motion);
    if (!found || found->amplitude < kSwing) continue;
    const double limit_per_s = 2 * M_PI / found->period_s;
    const bool stays = found->growth > 0.8;
    findings.push_back(
        {stays ? Weight::Fault : Weight::Doubt, "oscillation",
         fmt::format(
             "the target swings {} in the image, {:.2f} s a period, {}; a loop at its limit "
             "with this period has the gain {:.2f} per second and a quarter of the period "
             "({:.2f} s) of latency, the vehicle's included",
             motion.words, found->period_s,
             stays ? "and does not calm down" : "and calms down slowly", limit_per_s,
             found->period_s / 4),
         fmt::format("lower gain_per_s from {:.2f} to {:.2f} (a quarter of the limit) or make the "
                     "loop faster",
                     gain_per_s, std::min(gain_per_s / 2, limit_per_s / 4))});
  }
}

void look_for_minimum(const LogRows& rows, double gain_per_s, std::vector<Finding>& findings) {
  std::vector<double> ratios;
  for (std::size_t i = rows.size() * 4 / 5; i < rows.size(); ++i) {
    const LoggedServo& servo = *rows[i]->servo;
    if (!(servo.error_norm > 0)) continue;
    ratios.push_back(servo.twist.vector().norm() / (gain_per_s * servo.error_norm));
  }
  const double left = median_error(rows, 0.8, 1);
  if (left < kErrorLeft || !(median_of(ratios) < kStall)) return;
  findings.push_back(
      {Weight::Fault, "local_minimum",
       fmt::format("the law stands still with an error of {:.3g} left: no motion it may use would "
                   "make it smaller",
                   left),
       "start from elsewhere; take a law without local minima (pbvs_ct, 2.5d), or give it the "
       "freedom it lacks; check width_m, height_m and the goal: a view that no pose gives cannot "
       "be reached"});
}

}  // namespace kestrel
