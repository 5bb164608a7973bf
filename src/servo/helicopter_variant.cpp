#include "kestrel/servo/helicopter_variant.hpp"

namespace kestrel {

const std::vector<HelicopterVariant>& all_helicopter_variants() {
  static const std::vector<HelicopterVariant> all = {
      HelicopterVariant::Vp4,   HelicopterVariant::Raw4, HelicopterVariant::Drop6,
      HelicopterVariant::Vp3Hh, HelicopterVariant::Vp3,  HelicopterVariant::Mejias};
  return all;
}

const char* name(HelicopterVariant variant) {
  switch (variant) {
    case HelicopterVariant::Vp4:
      return "vp4";
    case HelicopterVariant::Raw4:
      return "raw4";
    case HelicopterVariant::Drop6:
      return "drop6";
    case HelicopterVariant::Vp3Hh:
      return "vp3_hh";
    case HelicopterVariant::Vp3:
      return "vp3";
    case HelicopterVariant::Mejias:
      return "mejias";
  }
  return "unknown";
}

std::optional<HelicopterVariant> helicopter_variant_named(std::string_view wanted) {
  for (const HelicopterVariant variant : all_helicopter_variants()) {
    if (name(variant) == wanted) return variant;
  }
  return std::nullopt;
}

}  // namespace kestrel
