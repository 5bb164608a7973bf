#include <limits>

#include <fmt/format.h>

#include "condition_key.hpp"
#include "plan_keys.hpp"

namespace kestrel {
namespace {

ConditionKey<Conditions> limit(const std::string& name, double CameraLimits::*number, double unit) {
  return {name,
          [number, unit](const Conditions& c) {
            return c.limits ? std::optional(in_unit((*c.limits).*number, unit)) : std::nullopt;
          },
          [number, unit](Conditions& c, double value) {
            if (!c.limits) c.limits.emplace();
            (*c.limits).*number = value * unit;
          },
          {}};
}

}  // namespace

template <>
const std::vector<ConditionKey<Conditions>>& condition_keys_of<Conditions>() {
  using C = Conditions;
  static const std::vector<ConditionKey<C>> all{
      gain_key<C>(),
      number_key("rate_hz", &C::rate_hz),
      count_key("steps", &C::steps),
      number_key("depth_factor", &C::depth_factor),
      number_key("focal_factor", &C::focal_factor),
      number_key("principal_u_px", &C::principal_u_px),
      number_key("principal_v_px", &C::principal_v_px),
      number_key("noise_px", &C::noise_px),
      seed_key<C>(),
      count_key("delay_frames", &C::delay_frames),
      limit("limit_linear_m_s", &CameraLimits::linear_m_s, 1),
      limit("limit_angular_deg_s", &CameraLimits::angular_rad_s, kPlanDegree)};
  return all;
}

double in_unit(double value, double unit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double near = value / unit;
  const double plain = std::stod(fmt::format("{:.14g}", near));  // 90, not 90.00000000000001
  for (const double written :
       {plain, near, std::nextafter(near, kInfinity), std::nextafter(near, -kInfinity)}) {
    if (written * unit == value) return written;
  }
  return near;
}

}  // namespace kestrel
