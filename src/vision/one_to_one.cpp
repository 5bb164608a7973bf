#include "kestrel/vision/one_to_one.hpp"

#include <algorithm>
#include <tuple>

namespace kestrel {
namespace {

/// In the place of the index of a witness that another one outdoes.
constexpr int kOutdone = -1;

/// By one side's u, then whatever else tells two witnesses apart.
void sort_along_u(std::vector<Witness>& all, Pixel PixelPair::*side) {
  std::sort(all.begin(), all.end(), [side](const Witness& a, const Witness& b) {
    const Pixel& p = a.pair.*side;
    const Pixel& q = b.pair.*side;
    if (p.u != q.u) return p.u < q.u;
    return std::tie(p.v, a.squared_error, a.index) < std::tie(q.v, b.squared_error, b.index);
  });
}

std::vector<Witness> without_repeats(std::vector<Witness> all, Pixel PixelPair::*side,
                                     double same_place_px) {
  sort_along_u(all, side);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Pixel& here = all[i].pair.*side;
    for (std::size_t j = i + 1; j < all.size() && all[i].index != kOutdone; ++j) {
      const Pixel& there = all[j].pair.*side;
      if (there.u - here.u >= same_place_px) break;
      if (all[j].index == kOutdone || distance(here, there) >= same_place_px) continue;
      (all[i].squared_error <= all[j].squared_error ? all[j] : all[i]).index = kOutdone;
    }
  }
  const auto is_outdone = [](const Witness& w) { return w.index == kOutdone; };
  all.erase(std::remove_if(all.begin(), all.end(), is_outdone), all.end());
  return all;
}

}  // namespace

std::vector<int> one_to_one(std::vector<Witness> witnesses, double same_place_px) {
  witnesses = without_repeats(std::move(witnesses), &PixelPair::in_image, same_place_px);
  witnesses = without_repeats(std::move(witnesses), &PixelPair::in_template, same_place_px);
  std::vector<int> indices;
  indices.reserve(witnesses.size());
  for (const Witness& witness : witnesses) indices.push_back(witness.index);
  std::sort(indices.begin(), indices.end());
  return indices;
}

}  // namespace kestrel
