#include "dc1394_trigger.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace kestrel::iidc {
namespace {

constexpr std::array<std::pair<dc1394trigger_source_t, const char*>, 5> kSources = {{
    {DC1394_TRIGGER_SOURCE_0, "0"},
    {DC1394_TRIGGER_SOURCE_1, "1"},
    {DC1394_TRIGGER_SOURCE_2, "2"},
    {DC1394_TRIGGER_SOURCE_3, "3"},
    {DC1394_TRIGGER_SOURCE_SOFTWARE, "software"},
}};

constexpr std::array<std::pair<dc1394trigger_mode_t, int>, 8> kModes = {{
    {DC1394_TRIGGER_MODE_0, 0},
    {DC1394_TRIGGER_MODE_1, 1},
    {DC1394_TRIGGER_MODE_2, 2},
    {DC1394_TRIGGER_MODE_3, 3},
    {DC1394_TRIGGER_MODE_4, 4},
    {DC1394_TRIGGER_MODE_5, 5},
    {DC1394_TRIGGER_MODE_14, 14},
    {DC1394_TRIGGER_MODE_15, 15},
}};

/// The library's word for one of ours, and back; `list` holds both.
template <class List, class Ours>
auto library_word(const List& list, const Ours& ours) {
  return std::find_if(list.begin(), list.end(),
                      [&](const auto& pair) { return pair.second == ours; });
}

dc1394feature_info_t trigger_feature(dc1394camera_t& camera) {
  dc1394feature_info_t info{};
  info.id = DC1394_FEATURE_TRIGGER;
  require(dc1394_feature_get(&camera, &info), "asking for its trigger");
  return info;
}

bool has_trigger(dc1394camera_t& camera) {
  dc1394bool_t present = DC1394_FALSE;
  return dc1394_feature_is_present(&camera, DC1394_FEATURE_TRIGGER, &present) == DC1394_SUCCESS &&
         present == DC1394_TRUE;
}

void set_source(dc1394camera_t& camera, const TriggerSettings& t, const TriggerAbility& can) {
  if (std::find(can.sources.begin(), can.sources.end(), t.source) == can.sources.end())
    fail(fmt::format("trigger.source: the camera has no source {}; it has {}", t.source,
                     fmt::join(can.sources, ", ")));
  require(dc1394_external_trigger_set_source(&camera, library_word(kSources, t.source)->first),
          "setting the trigger's source");
}

void set_mode(dc1394camera_t& camera, const TriggerSettings& t, const TriggerAbility& can) {
  if (std::find(can.modes.begin(), can.modes.end(), t.mode) == can.modes.end())
    fail(fmt::format("trigger.mode: the camera has no mode {}; it has {}", t.mode,
                     fmt::join(can.modes, ", ")));
  require(dc1394_external_trigger_set_mode(&camera, library_word(kModes, t.mode)->first),
          "setting the trigger's mode");
}

void set_polarity(dc1394camera_t& camera, const TriggerSettings& t, const TriggerAbility& can) {
  if (t.polarity.empty()) return;
  if (!can.has_polarity)
    fail("trigger.polarity: that of this camera cannot be chosen; remove the key");
  const auto wanted = t.polarity == "high" ? DC1394_TRIGGER_ACTIVE_HIGH : DC1394_TRIGGER_ACTIVE_LOW;
  require(dc1394_external_trigger_set_polarity(&camera, wanted), "setting the trigger's polarity");
}

}  // namespace

std::optional<TriggerAbility> trigger_ability(dc1394camera_t& camera) {
  if (!has_trigger(camera)) return std::nullopt;
  const dc1394feature_info_t info = trigger_feature(camera);
  TriggerAbility can;
  for (const auto& [theirs, ours] : kSources) {
    const auto* const end = info.trigger_sources.sources + info.trigger_sources.num;
    if (std::find(info.trigger_sources.sources, end, theirs) != end) can.sources.emplace_back(ours);
  }
  for (const auto& [theirs, ours] : kModes) {
    const auto* const end = info.trigger_modes.modes + info.trigger_modes.num;
    if (std::find(info.trigger_modes.modes, end, theirs) != end) can.modes.push_back(ours);
  }
  can.has_polarity = info.polarity_capable == DC1394_TRUE;
  return can;
}

void set_trigger(dc1394camera_t& camera, const std::optional<TriggerSettings>& wanted) {
  if (!wanted) {
    if (has_trigger(camera))
      require(dc1394_external_trigger_set_power(&camera, DC1394_OFF), "switching off its trigger");
    return;
  }
  const auto can = trigger_ability(camera);
  if (!can) fail("trigger: the camera has none; remove the key");
  set_source(camera, *wanted, *can);
  set_mode(camera, *wanted, *can);
  set_polarity(camera, *wanted, *can);
  require(dc1394_external_trigger_set_power(&camera, DC1394_ON), "switching on its trigger");
}

void SoftwareTrigger::ask(dc1394camera_t& camera, double now_s) {
  const double since_s = now_s - asked_s_;
  if (since_s < (is_asked_ ? longest_s_ : period_s_)) return;
  require(dc1394_software_trigger_set_power(&camera, DC1394_ON), "triggering a picture");
  asked_s_ = now_s;
  is_asked_ = true;
}

std::string no_trigger(const TriggerSettings& trigger, double seconds) {
  const std::string way = trigger.polarity.empty() ? "" : ", active " + trigger.polarity;
  return fmt::format(
      "no trigger within {} s (source {}, mode {}{}); check its cable and what sends it, or remove "
      "the key trigger",
      seconds, trigger.source, trigger.mode, way);
}

}  // namespace kestrel::iidc
