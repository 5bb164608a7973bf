#include "kestrel/lab/run_diagnosis.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "kestrel/lab/vehicle_response.hpp"

#include "error_findings.hpp"

namespace kestrel {
namespace {

using Findings = std::vector<Finding>;

/// The rows in which the law had an answer.
LogRows answered(const LogFile& log) {
  LogRows rows;
  for (const LogRow& row : log.rows) {
    if (row.servo) rows.push_back(&row);
  }
  return rows;
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

Finding seen(const LogFile& log, const LogRows& rows) {
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

void look_at_condition(const LogRows& rows, Findings& findings) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const LogRow* row : rows) values.push_back(row->servo->condition);
  const double typical = median_of(values);
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

void look_at_tilt(const LogRows& rows, Findings& findings) {
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
  const LogRows rows = answered(log);
  Findings findings{seen(log, rows)};
  look_at_answer(log, findings);
  if (rows.size() >= 10) {
    const double gain_per_s = task.servo.gain_per_s;
    findings.push_back(error_course(rows, gain_per_s));
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
