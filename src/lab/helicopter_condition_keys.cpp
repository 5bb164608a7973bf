#include "condition_key.hpp"
#include "plan_keys.hpp"

namespace kestrel {
namespace {

using C = HelicopterConditions;
using Key = ConditionKey<C>;

const std::vector<std::string> kTruth{"false", "true"};
constexpr double kToTheEnd_s = 3600;  // the longest run

Key angle(const std::string& name, double C::*value) {
  return {name,
          [value](const C& c) { return in_unit(c.*value, kPlanDegree); },
          [value](C& c, double x) { c.*value = x * kPlanDegree; },
          {}};
}

Key flag(const std::string& name, bool C::*value) {
  return {name, [value](const C& c) { return c.*value ? 1.0 : 0.0; },
          [value](C& c, double x) { c.*value = x != 0; }, kTruth};
}

Key limit(const std::string& name, VelocityCommand CommandLimits::*of,
          double VelocityCommand::*value, double unit = 1) {
  return {name,
          [=](const C& c) {
            return c.limits ? std::optional(in_unit(((*c.limits).*of).*value, unit)) : std::nullopt;
          },
          [=](C& c, double x) {
            if (!c.limits) c.limits.emplace();
            ((*c.limits).*of).*value = x * unit;
          },
          {}};
}

/// Switches the limits off, or on as they are or else by default.
Key limited() {
  return {"limited", [](const C& c) { return c.limits ? 1.0 : 0.0; },
          [](C& c, double x) {
            if (x == 0) c.limits.reset();
            if (x != 0 && !c.limits) c.limits.emplace();
          },
          kTruth};
}

Key loss(const std::string& name, double TargetLoss::*value) {
  return {name,
          [value](const C& c) { return c.loss ? std::optional((*c.loss).*value) : std::nullopt; },
          [value](C& c, double x) {
            if (!c.loss) c.loss = TargetLoss{0, kToTheEnd_s};
            (*c.loss).*value = x;
          },
          {}};
}

Key reaction() {
  return {"reaction",
          [](const C& c) { return double(int(c.reaction)); },
          [](C& c, double x) { c.reaction = LossReaction(int(x)); },
          {name(LossReaction::Failsafe), name(LossReaction::Hold), name(LossReaction::Hover)}};
}

template <class Part>
Key part(const std::string& name, Part C::*of, double Part::*value, double unit = 1) {
  return {name,
          [=](const C& c) { return in_unit((c.*of).*value, unit); },
          [=](C& c, double x) { (c.*of).*value = x * unit; },
          {}};
}

std::vector<Key> limit_keys() {
  using V = VelocityCommand;
  using L = CommandLimits;
  return {limited(),
          limit("limit_forward_m_s", &L::speed, &V::forward_m_s),
          limit("limit_right_m_s", &L::speed, &V::right_m_s),
          limit("limit_down_m_s", &L::speed, &V::down_m_s),
          limit("limit_yaw_deg_s", &L::speed, &V::yaw_rate_rad_s, kPlanDegree),
          limit("acceleration_forward_m_s2", &L::acceleration, &V::forward_m_s),
          limit("acceleration_right_m_s2", &L::acceleration, &V::right_m_s),
          limit("acceleration_down_m_s2", &L::acceleration, &V::down_m_s),
          limit("acceleration_yaw_deg_s2", &L::acceleration, &V::yaw_rate_rad_s, kPlanDegree)};
}

std::vector<Key> loss_keys() {
  return {loss("loss_from_s", &TargetLoss::from_s),
          loss("loss_for_s", &TargetLoss::for_s),
          reaction(),
          part("hold_s", &C::failsafe, &LossOptions::hold_s),
          part("decay_s", &C::failsafe, &LossOptions::decay_s),
          part("hover_after_s", &C::failsafe, &LossOptions::hover_after_s)};
}

std::vector<Key> plant_keys() {
  using H = HelicopterOptions;
  return {part("tau_v_s", &C::plant, &H::tau_v_s), part("tau_a_s", &C::plant, &H::tau_a_s),
          part("tau_z_s", &C::plant, &H::tau_z_s), part("tau_r_s", &C::plant, &H::tau_r_s),
          part("max_tilt_deg", &C::plant, &H::max_tilt_rad, kPlanDegree)};
}

std::vector<Key> all_keys() {
  std::vector<Key> all{gain_key<C>(),
                       number_key("duration_s", &C::duration_s),
                       count_key("period_frames", &C::period_frames),
                       count_key("delay_frames", &C::delay_frames),
                       flag("predicted", &C::predicted),
                       flag("feed_forward", &C::feed_forward),
                       number_key("depth_factor", &C::depth_factor),
                       number_key("noise_px", &C::noise_px),
                       seed_key<C>(),
                       angle("roll_bias_deg", &C::roll_bias_rad),
                       angle("pitch_bias_deg", &C::pitch_bias_rad),
                       angle("yaw_bias_deg", &C::yaw_bias_rad)};
  for (const std::vector<Key>& more : {limit_keys(), loss_keys(), plant_keys()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace

template <>
const std::vector<Key>& condition_keys_of<C>() {
  static const std::vector<Key> all = all_keys();
  return all;
}

}  // namespace kestrel
