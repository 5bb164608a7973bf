#include "kestrel/lab/run_diagnosis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "kestrel/eval/spread.hpp"
#include "kestrel/lab/vehicle_response.hpp"

#include "oscillation.hpp"

namespace kestrel {
namespace {

using Findings = std::vector<Finding>;

/// The rows in which the law had an answer.
std::vector<const LogRow*> answered(const LogFile& log) {
  std::vector<const LogRow*> rows;
  for (const LogRow& row : log.rows) {
    if (row.servo) rows.push_back(&row);
  }
  return rows;
}

/// 0 for none.
double median(std::vector<double> values) {
  const auto spread = spread_of(std::move(values));
  return spread ? spread->median : 0;
}

/// Median error norm of rows [from, to) as shares of all.
double median_error(const std::vector<const LogRow*>& rows, double from, double to) {
  std::vector<double> values;
  const auto n = double(rows.size());
  for (auto i = std::size_t(from * n); i < std::size_t(std::ceil(to * n)); ++i) {
    values.push_back(rows[i]->servo->error_norm);
  }
  return median(std::move(values));
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

double longest_loss_s(const LogFile& log) {
  double longest = 0;
  std::optional<double> since;
  for (const LogRow& row : log.rows) {
    if (row.servo) {
      since.reset();
    } else {
      if (!since) since = row.stamp_s;
      longest = std::max(longest, row.stamp_s - *since);
    }
  }
  return longest;
}

/// The commonest reason for not seeing the target; empty when it was always seen.
std::string commonest_miss(const LogFile& log) {
  std::map<std::string, int> counts;
  for (const LogRow& row : log.rows) {
    if (!row.pose) ++counts[row.miss == Miss::None ? "no pose" : name(row.miss)];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "" : most->first;
}

Finding seen(const LogFile& log, const std::vector<const LogRow*>& rows) {
  const double share = double(rows.size()) / double(log.rows.size());
  std::string what = fmt::format(
      "the target was seen and answered in {} of {} frames; the longest "
      "time without was {:.1f} s",
      rows.size(), log.rows.size(), longest_loss_s(log));
  const std::string miss = commonest_miss(log);
  if (!miss.empty()) what += ", most often because of: " + miss;
  if (share >= 0.95) return {Weight::Fine, "seen", what, ""};
  return {share < 0.5 ? Weight::Fault : Weight::Doubt, "seen", what,
          "mend the tracking first (kestrel track shows it): a larger or richer template, more "
          "light, a sharper picture, a target that stays in the image"};
}

void look_at_answer(const LogFile& log, Findings& findings) {
  const auto silent = std::count_if(log.rows.begin(), log.rows.end(),
                                    [](const LogRow& row) { return row.pose && !row.servo; });
  if (silent == 0) return;
  findings.push_back(
      {double(silent) > 0.05 * double(log.rows.size()) ? Weight::Fault : Weight::Doubt, "answer",
       fmt::format("in {} frames the target was seen, but the law had no answer", silent),
       "the view determines no command there: come nearer, look less along the target's plane, or "
       "choose fewer freedoms or another law"});
}

/// Rate of the exponential decay of the error from the start to where a tenth is left, 1/s.
std::optional<double> decay_rate_per_s(const std::vector<const LogRow*>& rows, double first) {
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

Finding error(const std::vector<const LogRow*>& rows, double gain_per_s) {
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
std::optional<Oscillation> swing(const std::vector<const LogRow*>& rows, const Motion& motion) {
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

void look_at_swing(const std::vector<const LogRow*>& rows, double gain_per_s, Findings& findings) {
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

/// Below this |v| / (gain |e|) hardly any of the error is one that a motion could take away: the
/// largest singular value of L being below 5 for points inside usual images, an error that could
/// be taken away gives 0.2 at least.
constexpr double kStall = 0.05;
constexpr double kErrorLeft = 0.02;  // normalised plane

void look_for_minimum(const std::vector<const LogRow*>& rows, double gain_per_s,
                      Findings& findings) {
  std::vector<double> ratios;
  for (std::size_t i = rows.size() * 4 / 5; i < rows.size(); ++i) {
    const LoggedServo& servo = *rows[i]->servo;
    if (!(servo.error_norm > 0)) continue;
    ratios.push_back(servo.twist.vector().norm() / (gain_per_s * servo.error_norm));
  }
  const double left = median_error(rows, 0.8, 1);
  if (left < kErrorLeft || !(median(ratios) < kStall)) return;
  findings.push_back(
      {Weight::Fault, "local_minimum",
       fmt::format("the law stands still with an error of {:.3g} left: no motion it may use would "
                   "make it smaller",
                   left),
       "start from elsewhere; take a law without local minima (pbvs_ct, 2.5d), or give it the "
       "freedom it lacks; check width_m, height_m and the goal: a view that no pose gives cannot "
       "be reached"});
}

void look_at_response(const LogFile& log, const Task& task, Findings& findings) {
  const auto response = vehicle_response(log, task);
  if (!response) return;
  for (int i = 0; i < 4; ++i) {
    const auto& axis = response->axes[std::size_t(i)];
    if (!axis) continue;
    const double doubt = 3 * axis->standard_error;
    const std::string seen = fmt::format(
        "commands {} moved the image {:.2f} (+-{:.2f}) times as predicted, {:.2f} s "
        "later",
        axis_name(i), axis->gain, axis->standard_error, axis->latency_s);
    if (axis->gain + doubt < 0) {
      findings.push_back({Weight::Fault, "sign", seen,
                          "the vehicle moves the other way: check the camera's mount "
                          "(body_from_camera) and the signs of the flight controller"});
    } else if (axis->gain - doubt > 1.4 || axis->gain + doubt < 0.6) {
      findings.push_back(
          {Weight::Doubt, i < 3 ? "depth" : "yaw_rate", seen,
           i < 3 ? "depths are wrong by this factor: check width_m and height_m of the target and "
                   "the focal length; the gain is in effect multiplied by it"
                 : "the vehicle turns faster or slower than it is told"});
    } else {
      findings.push_back({Weight::Fine, "response", seen, ""});
    }
  }
}

void look_at_condition(const std::vector<const LogRow*>& rows, Findings& findings) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const LogRow* row : rows) values.push_back(row->servo->condition);
  const double typical = median(values);
  const std::string what = fmt::format("condition number of the task's Jacobian {:.0f}", typical);
  if (typical < 1000) return findings.push_back({Weight::Fine, "condition", what, ""});
  findings.push_back({Weight::Doubt, "condition", what,
                      "noise of the image becomes motion: come nearer, use a larger target, or "
                      "hold the heading by the compass (three freedoms)"});
}

void look_at_limits(const LogFile& log, Findings& findings) {
  double held = 0;
  double all = 0;
  for (const LogRow& row : log.rows) {
    if (!row.decision || row.decision->state != CommandState::Servo) continue;
    all += 1;
    const Eigen::Vector4d wanted = row.decision->wanted.vector();
    if ((wanted - row.decision->sent.vector()).norm() > 0.01 * wanted.norm()) held += 1;
  }
  if (!(all > 0)) return;
  const std::string what =
      fmt::format("the limits changed {} of the commands", percent(held / all));
  if (held < 0.5 * all) return findings.push_back({Weight::Fine, "limits", what, ""});
  findings.push_back(
      {Weight::Doubt, "limits", what,
       "lower the gain, or raise `limits` where the vehicle and the place allow it"});
}

void look_at_tilt(const std::vector<const LogRow*>& rows, Findings& findings) {
  const bool known =
      std::any_of(rows.begin(), rows.end(), [](const LogRow* row) { return bool(row->attitude); });
  if (known) return;
  findings.push_back(
      {Weight::Doubt, "tilt",
       "no attitude was known: the tilt of the helicopter was answered as if it were "
       "an error of the view",
       "give the attitude at the image's time (telemetry), or keep the gain low"});
}

}  // namespace

std::vector<Finding> diagnosis(const LogFile& log, const Task& task) {
  if (log.rows.empty()) {
    return {{Weight::Fault, "seen", "the log has no frames", "run the task again"}};
  }
  const std::vector<const LogRow*> rows = answered(log);
  Findings findings{seen(log, rows)};
  look_at_answer(log, findings);
  if (rows.size() >= 10) {
    const double gain_per_s = task.servo.gain_per_s;
    findings.push_back(error(rows, gain_per_s));
    look_at_swing(rows, gain_per_s, findings);
    look_for_minimum(rows, gain_per_s, findings);
    look_at_response(log, task, findings);
    look_at_condition(rows, findings);
    look_at_limits(log, findings);
    look_at_tilt(rows, findings);
  }
  return by_weight(std::move(findings));
}

}  // namespace kestrel
