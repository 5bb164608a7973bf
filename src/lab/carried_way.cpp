#include "carried_way.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel {
namespace {

constexpr double kGrid_s = 1.0 / 120;

}  // namespace

CarriedWay::CarriedWay(const LogFile& log, Eigen::Index axis, double lag_s)
    : start_s_(log.rows[0].stamp_s) {
  double speed = 0;
  double way = 0;
  for (std::size_t i = 0; i + 1 < log.rows.size(); ++i) {
    const LogRow& row = log.rows[i];
    const double asked = row.decision ? row.decision->sent.vector()[axis] : 0;
    while (start_s_ + kGrid_s * double(ways_.size()) < log.rows[i + 1].stamp_s) {
      ways_.push_back(way);
      const double follow = lag_s > 0 ? 1 - std::exp(-kGrid_s / lag_s) : 1;
      speed += follow * (asked - speed);
      way += kGrid_s * speed;
    }
  }
  ways_.push_back(way);
}

double CarriedWay::upto(double time_s) const {
  const double place = (time_s - start_s_) / kGrid_s;
  if (!(place > 0)) return 0;
  const auto i = std::size_t(std::min(place, double(ways_.size() - 1)));
  if (i + 1 >= ways_.size()) return ways_.back();
  return ways_[i] + (place - double(i)) * (ways_[i + 1] - ways_[i]);
}

}  // namespace kestrel
