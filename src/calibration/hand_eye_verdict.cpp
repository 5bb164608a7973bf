#include "hand_eye_verdict.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

void object(HandEyeResult& result, Gravity gravity, std::string what, std::string remedy) {
  result.objections.push_back({gravity, std::move(what), std::move(remedy)});
}

}  // namespace

void HandEyeOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(fewest_stations >= 4, "fewest_stations: at least 4");
  require(enough_stations >= fewest_stations, "enough_stations: at least fewest_stations");
  require(smallest_spread_rad > 0, "smallest_spread_rad: more than 0");
  require(residual_refused_rad > 0, "residual_refused_rad: more than 0");
  require(deviation_doubted_rad > 0, "deviation_doubted_rad: more than 0");
  require(deviation_doubted_m > 0, "deviation_doubted_m: more than 0");
}

void judge_stations(std::size_t count, HandEyeResult& result, const HandEyeOptions& o) {
  if (count < std::size_t(o.fewest_stations)) {
    return object(
        result, Gravity::Refusal,
        fmt::format("there are {} different attitudes, {} are needed", count, o.fewest_stations),
        "hold the vehicle still in many attitudes while the camera sees the target: "
        "rolled, pitched and turned by 10 degrees and more");
  }
  if (result.spread_rad[1] < o.smallest_spread_rad) {
    return object(result, Gravity::Refusal,
                  fmt::format("the vehicle was turned about one axis only: {:.1f} degrees (rms) "
                              "about the first, {:.1f} about the second",
                              result.spread_rad[0] / kDegree, result.spread_rad[1] / kDegree),
                  "turn it about two axes at least: roll it and pitch it by hand, 10 degrees and "
                  "more either way");
  }
  if (count < std::size_t(o.enough_stations)) {
    object(result, Gravity::Doubt, fmt::format("there are {} different attitudes only", count),
           fmt::format("take {} and more", o.enough_stations));
  }
}

void judge_answer(HandEyeResult& result, const HandEyeOptions& o) {
  if (result.residual_rad > o.residual_refused_rad) {
    object(result, Gravity::Refusal,
           fmt::format("the target seems to turn by {:.1f} degrees (rms) in the world",
                       result.residual_rad / kDegree),
           "the target must stand still; attitude and pictures must be of the same moment; look at "
           "the camera's calibration and for a pose that flips");
  }
  const double deviation = result.rotation_deviation_rad.maxCoeff();
  if (deviation > o.deviation_doubted_rad) {
    object(result, Gravity::Doubt,
           fmt::format("the rotation is known to {:.1f} degrees only", deviation / kDegree),
           "more stations, larger angles, a larger target or a nearer one");
  }
  if (result.translation_deviation_m &&
      result.translation_deviation_m->maxCoeff() > o.deviation_doubted_m) {
    object(result, Gravity::Doubt,
           fmt::format("the translation is known to {:.2f} m only",
                       result.translation_deviation_m->maxCoeff()),
           "measure it with a ruler: --translation x,y,z");
  }
}

}  // namespace kestrel
