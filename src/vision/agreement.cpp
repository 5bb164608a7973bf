#include "kestrel/vision/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kestrel {
namespace {

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

}  // namespace

void AgreementOptions::check() const {
  require(alike_zncc > 0 && alike_zncc < 1, "agreement.alike_zncc: must be between 0 and 1");
  require(min_alike_share >= 0 && min_alike_share <= 1,
          "agreement.min_alike_share: must be 0 to 1");
  require(min_better_half >= 0 && min_better_half < 1,
          "agreement.min_better_half: must be at least 0 and below 1");
  require(min_visible_share >= 0 && min_visible_share <= 1,
          "agreement.min_visible_share: must be 0 to 1");
  require(min_alike >= 1, "agreement.min_alike: must be at least 1");
}

Agreement agreement(std::vector<BlockLikeness>& likeness, const AgreementOptions& options) {
  Agreement result;
  result.blocks = int(likeness.size());
  const auto end = std::partition(likeness.begin(), likeness.end(),
                                  [](const BlockLikeness& b) { return b.is_visible; });
  result.visible = int(end - likeness.begin());
  if (result.visible == 0) return result;
  const auto half = likeness.begin() + (result.visible + 1) / 2;
  std::sort(likeness.begin(), end,
            [](const BlockLikeness& a, const BlockLikeness& b) { return a.zncc > b.zncc; });
  for (auto b = likeness.begin(); b != half; ++b) result.better_half += b->zncc;
  result.better_half /= double(half - likeness.begin());
  result.alike =
      int(std::find_if(likeness.begin(), end,
                       [&](const BlockLikeness& b) { return b.zncc <= options.alike_zncc; }) -
          likeness.begin());
  return result;
}

double PlaceAgreement::alike_share() const {
  return coarse.visible > 0 ? (fine.alike_share() + coarse.alike_share()) / 2 : fine.alike_share();
}

double PlaceAgreement::evident_share() const {
  constexpr int kFree = 4;
  const auto evident = [](int alike, int visible, int free) {
    return visible > free ? std::max(alike - free, 0) / double(visible - free) : 0.0;
  };
  const double by_fine = evident(fine.alike, fine.visible, kFree);
  if (coarse.visible == 0) return by_fine;
  if (coarse.visible <= kFree) {
    return evident(fine.alike + coarse.alike, fine.visible + coarse.visible, 2 * kFree);
  }
  return (by_fine + evident(coarse.alike, coarse.visible, kFree)) / 2;
}

double PlaceAgreement::better_half() const {
  return coarse.visible > 0 ? (fine.better_half + coarse.better_half) / 2 : fine.better_half;
}

bool is_accepted(const PlaceAgreement& a, const AgreementOptions& options) {
  return a.fine.alike + a.coarse.alike >= options.min_alike &&
         a.evident_share() >= options.min_alike_share &&
         a.better_half() >= options.min_better_half &&
         a.fine.visible_share() >= options.min_visible_share;
}

}  // namespace kestrel
