#include "laws.hpp"

/// Families that are not there yet refuse.
namespace kestrel::laws {

LawAnswer polar_law(const LawInput&, const LawOptions&) { return refused(LawRefusal::Singular); }
LawAnswer partition_law(const LawInput&, const LawOptions&) {
  return refused(LawRefusal::Singular);
}
LawAnswer hybrid_law(const LawInput&, const LawOptions&) { return refused(LawRefusal::Singular); }
LawAnswer homography_law(const LawInput&, const LawOptions&) {
  return refused(LawRefusal::Singular);
}
LawAnswer pose_law(const LawInput&, const LawOptions&) { return refused(LawRefusal::Singular); }
LawAnswer moments_law(const LawInput&, const LawOptions&) { return refused(LawRefusal::Singular); }
LawAnswer decoupled_law(const LawInput&, const LawOptions&) {
  return refused(LawRefusal::Singular);
}

}  // namespace kestrel::laws
