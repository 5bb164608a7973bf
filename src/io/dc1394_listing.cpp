#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/dc1394_camera.hpp"

#include "dc1394_bus.hpp"
#include "dc1394_trigger.hpp"

namespace kestrel {
namespace {

Dc1394Listing listing_of(dc1394_t& bus, std::uint64_t guid) {
  Dc1394Listing it{fmt::format("{:016x}", guid), "", {}, {}, ""};
  try {
    const iidc::Camera camera(dc1394_camera_new(&bus, guid));
    if (!camera) iidc::fail("the camera cannot be opened; check the permissions of /dev/fw*");
    if (camera->vendor != nullptr) it.name = camera->vendor;
    if (camera->model != nullptr)
      it.name += (it.name.empty() ? "" : " ") + std::string(camera->model);
    for (const iidc::Mode& mode : iidc::modes_of(*camera)) it.modes.push_back(mode.mode);
    it.trigger = iidc::trigger_ability(*camera);
  } catch (const std::runtime_error& error) {
    it.trouble = error.what();
  }
  return it;
}

}  // namespace

std::string to_string(const TriggerAbility& trigger) {
  return fmt::format("sources {}; modes {}{}", fmt::join(trigger.sources, ", "),
                     fmt::join(trigger.modes, ", "),
                     trigger.has_polarity ? "; polarity high or low" : "");
}

std::vector<Dc1394Listing> list_dc1394() {
  std::vector<Dc1394Listing> cameras;
  const iidc::Bus bus(dc1394_new());
  if (!bus) return cameras;
  const iidc::CameraList list = iidc::cameras_on(*bus);
  for (std::uint32_t i = 0; i < list->num; ++i)
    cameras.push_back(listing_of(*bus, list->ids[i].guid));
  return cameras;
}

}  // namespace kestrel
