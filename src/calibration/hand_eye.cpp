#include "kestrel/calibration/hand_eye.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/io/module.hpp"

#include "hand_eye_verdict.hpp"
#include "visp_module.hpp"

namespace kestrel {
namespace {

constexpr std::size_t kGroups = 10;  // of the jackknife
const Eigen::Vector3d kNowhere = Eigen::Vector3d::Zero();

bool has_positions(const std::vector<HandEyeStation>& stations) {
  return std::all_of(stations.begin(), stations.end(),
                     [](const HandEyeStation& s) { return s.position_ned_m.has_value(); });
}

/// The mean rotation: nearest to the sum.
Eigen::Matrix3d mean_of(const std::vector<Eigen::Matrix3d>& rotations) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Matrix3d& R : rotations) sum += R;
  return nearest_rotation(sum);
}

/// Root mean squares of the attitudes about the principal axes of their spread, largest first.
Eigen::Vector3d spread_rad(const std::vector<HandEyeStation>& stations) {
  std::vector<Eigen::Matrix3d> all;
  all.reserve(stations.size());
  for (const HandEyeStation& s : stations) all.push_back(rotation_of(s.attitude));
  const Eigen::Matrix3d mean = mean_of(all);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Matrix3d& R : all) {
    const Eigen::Vector3d turn = rotation_vector(mean.transpose() * R);
    covariance += turn * turn.transpose() / double(all.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  return axes.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
}

/// ViSP's answer. Without positions all translations are zero: they say nothing then.
std::optional<Mount> solved(const std::vector<HandEyeStation>& stations) {
  const bool with_place = has_positions(stations);
  std::vector<VispStation> all;
  for (const HandEyeStation& s : stations) {
    VispStation one{{rotation_of(s.attitude), s.position_ned_m.value_or(kNowhere)},
                    s.camera_from_target};
    if (!with_place) {
      one.world_from_body.translation.setZero();
      one.camera_from_target.translation.setZero();
    }
    all.push_back(one);
  }
  auto mount = module_functions<VispModule>("visp_calibration").hand_eye(all);
  if (!mount || !mount->rotation.allFinite() || !mount->translation.allFinite())
    return std::nullopt;
  mount->rotation = nearest_rotation(mount->rotation);
  if (!with_place) mount->translation.setZero();
  return mount;
}

/// Standard deviations by leaving each group of neighbours out once; false when ViSP fails without
/// one.
bool add_deviations(const std::vector<HandEyeStation>& stations, HandEyeResult& result) {
  using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  const std::size_t groups = std::min(stations.size(), kGroups);
  const auto n = Eigen::Index(groups);
  Matrix6X change(6, n);
  for (std::size_t i = 0; i < groups; ++i) {
    const auto begin = stations.begin();
    std::vector<HandEyeStation> others(begin, begin + long(i * stations.size() / groups));
    others.insert(others.end(), begin + long((i + 1) * stations.size() / groups), stations.end());
    const auto mount = solved(others);
    if (!mount) return false;
    change.col(Eigen::Index(i)) << rotation_vector(result.body_from_camera->rotation.transpose() *
                                                   mount->rotation),
        mount->translation - result.body_from_camera->translation;
  }
  const Vector6d mean = change.rowwise().mean();
  const Vector6d variance =
      (change.colwise() - mean).rowwise().squaredNorm() * (double(n - 1) / double(n));
  const Vector6d deviation = variance.cwiseSqrt();
  result.rotation_deviation_rad = deviation.head<3>();
  if (has_positions(stations)) result.translation_deviation_m = deviation.tail<3>();
  return true;
}

/// How far apart the stations see the target in the world.
void add_residuals(const std::vector<HandEyeStation>& stations, HandEyeResult& result) {
  std::vector<Eigen::Matrix3d> turned;
  std::vector<Eigen::Vector3d> places;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const HandEyeStation& s : stations) {
    const auto body_from_target = *result.body_from_camera * s.camera_from_target;
    turned.emplace_back(rotation_of(s.attitude) * body_from_target.rotation);
    places.emplace_back(rotation_of(s.attitude) * body_from_target.translation +
                        s.position_ned_m.value_or(kNowhere));
    centre += places.back() / double(stations.size());
  }
  const Eigen::Matrix3d mean = mean_of(turned);
  double sum_rad2 = 0;
  double sum_m2 = 0;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    result.residuals_rad.push_back(rotation_vector(mean.transpose() * turned[i]).norm());
    sum_rad2 += result.residuals_rad[i] * result.residuals_rad[i];
    sum_m2 += (places[i] - centre).squaredNorm();
  }
  result.residual_rad = std::sqrt(sum_rad2 / double(turned.size()));
  if (has_positions(stations)) result.residual_m = std::sqrt(sum_m2 / double(turned.size()));
}

}  // namespace

HandEyeResult hand_eye(const std::vector<HandEyeStation>& stations, const HandEyeOptions& options) {
  options.check();
  HandEyeResult result;
  if (stations.size() > 1) result.spread_rad = spread_rad(stations);
  judge_stations(stations.size(), result, options);
  if (is_refused(result.objections)) return result;
  result.body_from_camera = solved(stations);
  if (!result.body_from_camera || !add_deviations(stations, result)) {
    result.body_from_camera.reset();
    result.objections.push_back({Gravity::Refusal, "ViSP finds no mount that explains the stations",
                                 "attitude and pictures must be of the same moments, and the "
                                 "target must stand still; or turn the vehicle further"});
    return result;
  }
  add_residuals(stations, result);
  judge_answer(result, options);
  std::stable_partition(result.objections.begin(), result.objections.end(),
                        [](const Objection& o) { return o.gravity == Gravity::Refusal; });
  return result;
}

}  // namespace kestrel
