#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/text_file.hpp"
#include "kestrel/lab/lab_plan.hpp"

#include "plan_keys.hpp"

namespace kestrel {
namespace {

struct ConditionKey {
  std::string name;
  std::function<std::optional<double>(const Conditions&)> get;
  std::function<void(Conditions&, double)> set;
};

ConditionKey plain(const std::string& name, double Conditions::*number) {
  return {name, [number](const Conditions& c) { return c.*number; },
          [number](Conditions& c, double value) { c.*number = value; }};
}

double whole(const std::string& key, double value, double largest) {
  if (value != std::floor(value) || value < 0 || value > largest) {
    throw std::invalid_argument(key + ": " + number(value) + " is no whole number from 0 to " +
                                number(largest) + "; write one");
  }
  return value;
}

ConditionKey count(const std::string& name, int Conditions::*number) {
  return {
      name, [number](const Conditions& c) { return double(c.*number); },
      [name, number](Conditions& c, double value) { c.*number = int(whole(name, value, 1e7)); }};
}

ConditionKey limit(const std::string& name, double CameraLimits::*number, double unit) {
  return {name,
          [number, unit](const Conditions& c) {
            return c.limits ? std::optional(in_unit((*c.limits).*number, unit)) : std::nullopt;
          },
          [number, unit](Conditions& c, double value) {
            if (!c.limits) c.limits.emplace();
            (*c.limits).*number = value * unit;
          }};
}

const std::vector<ConditionKey>& keys() {
  using C = Conditions;
  static const std::vector<ConditionKey> all{
      {"gain_per_s", [](const C& c) { return c.gain_per_s; },
       [](C& c, double value) { c.gain_per_s = value; }},
      plain("rate_hz", &C::rate_hz),
      count("steps", &C::steps),
      plain("depth_factor", &C::depth_factor),
      plain("focal_factor", &C::focal_factor),
      plain("principal_u_px", &C::principal_u_px),
      plain("principal_v_px", &C::principal_v_px),
      plain("noise_px", &C::noise_px),
      {"seed", [](const C& c) { return double(c.seed); },
       [](C& c, double value) { c.seed = std::uint64_t(whole("seed", value, 0x1p53)); }},
      count("delay_frames", &C::delay_frames),
      limit("limit_linear_m_s", &CameraLimits::linear_m_s, 1),
      limit("limit_angular_deg_s", &CameraLimits::angular_rad_s, kPlanDegree)};
  return all;
}

const ConditionKey& key_named(const std::string& name) {
  for (const ConditionKey& key : keys()) {
    if (key.name == name) return key;
  }
  const std::string near = nearest_word(name, condition_keys());
  throw std::invalid_argument(name + ": is no key of the conditions" +
                              (near.empty() ? "" : "; did you mean " + near + "?"));
}

}  // namespace

const std::vector<std::string>& condition_keys() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const ConditionKey& key : keys()) all.push_back(key.name);
    return all;
  }();
  return names;
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

std::optional<double> setting_of(const Conditions& conditions, const std::string& key) {
  return key_named(key).get(conditions);
}

Conditions with_setting(Conditions conditions, const ConditionSetting& setting) {
  key_named(setting.first).set(conditions, setting.second);
  conditions.check();
  return conditions;
}

}  // namespace kestrel
