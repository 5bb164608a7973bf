#include "kestrel/servo/law.hpp"

#include <algorithm>

namespace kestrel {

const std::vector<Law>& all_laws() {
  static const std::vector<Law> laws = [] {
    std::vector<Law> all;
    for (int i = 0; i <= int(Law::Decoupled); ++i) all.push_back(Law(i));
    return all;
  }();
  return laws;
}

const char* name(Law law) {
  switch (law) {
    case Law::Cur:
      return "cur";
    case Law::CurZdes:
      return "cur_zdes";
    case Law::CurZarea:
      return "cur_zarea";
    case Law::CurZhomog:
      return "cur_zhomog";
    case Law::Des:
      return "des";
    case Law::Mean:
      return "mean";
    case Law::MeanZdes:
      return "mean_zdes";
    case Law::Mjp:
      return "mjp";
    case Law::PmjR:
      return "pmj_r";
    case Law::PmjT:
      return "pmj_t";
    case Law::Lm:
      return "lm";
    case Law::Transpose:
      return "transpose";
    case Law::TransposeRaw:
      return "transpose_raw";
    case Law::Broyden:
      return "broyden";
    case Law::BroydenRaw:
      return "broyden_raw";
    case Law::Rls:
      return "rls";
    case Law::Polar:
      return "polar";
    case Law::Partition:
      return "partition";
    case Law::TwoAndHalfD:
      return "2.5d";
    case Law::Homog:
      return "homog";
    case Law::PbvsCt:
      return "pbvs_ct";
    case Law::PbvsCo:
      return "pbvs_co";
    case Law::Screw:
      return "screw";
    case Law::Moments:
      return "moments";
    case Law::Decoupled:
      return "decoupled";
  }
  return "unknown";
}

std::optional<Law> law_named(std::string_view wanted) {
  const std::vector<Law>& laws = all_laws();
  const auto found =
      std::find_if(laws.begin(), laws.end(), [&](Law law) { return name(law) == wanted; });
  if (found == laws.end()) return std::nullopt;
  return *found;
}

}  // namespace kestrel
