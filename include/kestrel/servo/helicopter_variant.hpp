#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace kestrel {

/// How a law for a free camera is put on a helicopter, which can be asked for four velocities only:
/// forward, right, down (of the levelled body with its heading) and the yaw rate.
enum class HelicopterVariant {
  Vp4,     // "vp4": features levelled by the attitude, all four velocities from the image
  Raw4,    // "raw4": the same on the features as they are; tilt is answered as if it were an error
  Drop6,   // "drop6": all six velocities from the image, roll and pitch rates thrown away
  Vp3Hh,   // "vp3_hh": levelled, three translations from the image, heading held by the compass
  Vp3,     // "vp3": levelled, three translations, no yaw
  Mejias,  // "mejias": levelled, centre of gravity and size (the law "decoupled"), no yaw
};

/// All variants in the order of the enumeration.
const std::vector<HelicopterVariant>& all_helicopter_variants();

/// The name a user writes, in quotes above.
const char* name(HelicopterVariant variant);

/// The variant of that name; empty when there is none.
std::optional<HelicopterVariant> helicopter_variant_named(std::string_view name);

}  // namespace kestrel
