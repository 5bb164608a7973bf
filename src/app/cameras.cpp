#include <optional>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kestrel/io/dc1394_camera.hpp"
#include "kestrel/io/v4l2_camera.hpp"

#include "verbs.hpp"

namespace kestrel::app {
namespace {

/// A camera of either kind.
struct Listed {
  std::string address;  // for `source:`
  std::string name;
  std::string bus;
  std::vector<CameraMode> modes;
  std::optional<TriggerAbility> trigger;
  std::string trouble;
};

std::vector<Listed> connected() {
  std::vector<Listed> all;
  for (const V4l2Listing& c : list_v4l2()) {
    const std::string number = c.path.substr(std::string("/dev/video").size());
    all.push_back({"camera:" + number, c.name, c.bus, c.modes, {}, c.trouble});
  }
  for (const Dc1394Listing& c : list_dc1394())
    all.push_back({"dc1394:" + c.guid, c.name, "FireWire", c.modes, c.trigger, c.trouble});
  return all;
}

void print_text(const std::vector<Listed>& cameras) {
  for (const Listed& c : cameras) {
    fmt::print("{}  {}{}\n", c.address, c.name, c.bus.empty() ? "" : " (" + c.bus + ")");
    if (!c.trouble.empty()) fmt::print("  {}\n", c.trouble);
    for (const CameraMode& mode : c.modes) fmt::print("  {}\n", to_string(mode));
    if (c.trigger) fmt::print("  trigger: {}\n", to_string(*c.trigger));
  }
  if (cameras.empty()) {
    fmt::print(
        "no camera is connected: there is no /dev/video* that captures video, and no camera on a "
        "FireWire bus\n");
  }
}

void print_json(const std::vector<Listed>& cameras) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Listed& c : cameras) {
    nlohmann::ordered_json modes = nlohmann::ordered_json::array();
    for (const CameraMode& mode : c.modes) {
      modes.push_back({{"format", mode.format},
                       {"width_px", mode.size.width},
                       {"height_px", mode.size.height},
                       {"rates_hz", mode.rates_hz}});
    }
    list.push_back({{"source", c.address},
                    {"name", c.name},
                    {"bus", c.bus},
                    {"modes", modes},
                    {"trouble", c.trouble}});
    if (!c.trigger) continue;
    list.back()["trigger"] = {{"sources", c.trigger->sources},
                              {"modes", c.trigger->modes},
                              {"has_polarity", c.trigger->has_polarity}};
  }
  constexpr int kIndent = 2;
  // A name that is no UTF-8 is shown with its bytes replaced.
  fmt::print("{}\n", list.dump(kIndent, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

int run(const CamerasArguments& a) {
  const std::vector<Listed> cameras = connected();
  a.json ? print_json(cameras) : print_text(cameras);
  return 0;
}

}  // namespace kestrel::app
