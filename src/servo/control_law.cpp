#include "kestrel/servo/control_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SVD>

#include "kestrel/servo/interaction.hpp"

#include "laws/laws.hpp"

namespace kestrel {
namespace {

/// The pseudo-inverse on cur, des and mean, until the families are in place.
LawAnswer matrix_law(const LawInput& input, const LawOptions& options) {
  const auto n = Eigen::Index(2 * input.measured.size());
  LawAnswer answer;
  answer.error.resize(n);
  for (Eigen::Index i = 0; i < n / 2; ++i) {
    const Feature& s = input.measured[std::size_t(i)];
    const Feature& goal = input.desired[std::size_t(i)];
    answer.error.segment<2>(2 * i) << s.at.x - goal.at.x, s.at.y - goal.at.y;
  }
  Eigen::MatrixXd L = interaction_matrix(options.law == Law::Des ? input.desired : input.measured);
  if (options.law == Law::Mean) L = (L + interaction_matrix(input.desired)) / 2;
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(L, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(options.rank_tolerance);
  answer.singular_values = svd.singularValues();
  answer.rank = int(svd.rank());
  answer.smallest_singular_value = answer.singular_values.tail<1>()[0];
  answer.condition = answer.singular_values[0] / answer.smallest_singular_value;
  answer.gain_per_s = options.gain.at_zero_per_s;
  answer.twist = CameraTwist::from_vector(-answer.gain_per_s * svd.solve(answer.error));
  return answer;
}

bool is_usable(const std::vector<Feature>& features) {
  return std::all_of(features.begin(), features.end(),
                     [](const Feature& f) { return f.depth_m >= 1e-6; });
}

}  // namespace

LawAnswer control_law(const LawInput& input, const LawOptions& options, const LawState& state) {
  if (input.measured.size() != input.desired.size())
    return laws::refused(LawRefusal::Unequal, state);
  if (input.measured.size() < 3) return laws::refused(LawRefusal::FewPoints, state);
  if (!is_finite(input.measured) || !is_finite(input.desired)) {
    return laws::refused(LawRefusal::NotFinite, state);
  }
  if (!is_usable(input.measured) || !is_usable(input.desired)) {
    return laws::refused(LawRefusal::Depth, state);
  }
  return matrix_law(input, options);
}

}  // namespace kestrel
