#include "motion_pairs.hpp"

#include <algorithm>

#include "kestrel/lab/logged_features.hpp"
#include "kestrel/servo/interaction.hpp"

namespace kestrel {
namespace {

constexpr double kLongestGap_s = 0.5;  // between two frames in which the target counts as seen on
/// Time between the frames of a pair: long, that the motion stands out of the noise; short, that
/// the Jacobian hardly changes.
constexpr double kPair_s = 0.25;

ChangeJacobian jacobian_of(const LogRow& row, const Task& task) {
  const Mount mount = levelled_mount(row, task);
  const auto camera_from_body = mount.inverse();
  const Matrix6d cVb = twist_matrix(camera_from_body.rotation, camera_from_body.translation);
  const Eigen::MatrixXd L = interaction_matrix(logged_levelled_features(row, task));
  Eigen::Matrix<double, 6, 4> columns;
  columns << cVb.leftCols<3>(), cVb.col(5);
  return L * columns;
}

ImageChange error_of(const LogRow& row) {
  return Eigen::Map<const ImageChange>(row.servo->error.data());
}

bool is_usable(const LogRow& row, const Task& task) {
  const std::vector<Feature> seen = logged_levelled_features(row, task);
  return !seen.empty() && is_finite(seen) &&
         std::all_of(seen.begin(), seen.end(), [](auto& f) { return f.depth_m > 1e-6; });
}

}  // namespace

std::vector<MotionPair> motion_pairs(const LogFile& log, const Task& task) {
  std::vector<MotionPair> pairs;
  const LogRow* first = nullptr;  // of the pair
  const LogRow* last = nullptr;   // seen before this one without a gap
  for (const LogRow& row : log.rows) {
    const bool usable = is_usable(row, task);
    const bool follows = last != nullptr && row.stamp_s > last->stamp_s &&
                         row.stamp_s - last->stamp_s < kLongestGap_s;
    last = usable ? &row : nullptr;
    if (!usable || !follows || first == nullptr) {
      first = last;
      continue;
    }
    if (row.stamp_s - first->stamp_s < kPair_s) continue;
    pairs.push_back({first->stamp_s, row.stamp_s, error_of(row) - error_of(*first),
                     (jacobian_of(*first, task) + jacobian_of(row, task)) / 2});
    first = &row;
  }
  return pairs;
}

}  // namespace kestrel
