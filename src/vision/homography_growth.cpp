#include "kestrel/vision/homography_growth.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

#include "kestrel/vision/one_to_one.hpp"

namespace kestrel {
namespace {

/// Refits after which a set of inliers that still changes is taken as it is.
constexpr int kMaxRefits = 4;

/// Pairs further off than this many times the noise have no weight worth adding.
constexpr double kReach = 3;

/// Tolerances of votes are two standard deviations.
constexpr double kTolerated = 4;

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

double squared_error(const Seen& at, const Pixel& in_image) {
  const double du = at.u - in_image.u;
  const double dv = at.v - in_image.v;
  return du * du + dv * dv;
}

/// True when the whole template is in front of the camera and not mirrored.
bool is_possible(const CentredHomography& model) {
  const Eigen::Matrix3d& G = model.G;
  return G.allFinite() && std::abs(G(2, 0)) + std::abs(G(2, 1)) < 1 && G.determinant() > 0;
}

}  // namespace

void GrowthOptions::check() const {
  const auto above_0 = [](double x) { return x > 0 && std::isfinite(x); };
  require(above_0(max_reprojection_px), "growth.max_reprojection_px: must be above 0");
  require(min_inliers >= 5, "growth.min_inliers: must be at least 5");
  require(above_0(first_noise_share), "growth.first_noise_share: must be above 0");
  require(above_0(perspective), "growth.perspective: must be above 0");
  require(above_0(same_place_px), "growth.same_place_px: must be above 0");
}

HomographyGrowth::HomographyGrowth(const std::vector<AffinePair>& pairs, const AffineVotes& votes,
                                   double width_px, double height_px, const GrowthOptions& options)
    : pairs_(pairs),
      votes_(votes),
      width_px_(width_px),
      height_px_(height_px),
      options_(options),
      open_(pairs.size(), 1) {
  places_.reserve(pairs.size());
  for (const AffinePair& pair : pairs) {
    places_.push_back({centred(pair.in_template, width_px, height_px), pair.in_image});
  }
}

CentredHomography HomographyGrowth::predicted(std::size_t voter) const {
  const AffinePair& pair = pairs_[voter];
  const Eigen::Vector2d half((width_px_ - 1) / 2, (height_px_ - 1) / 2);
  const Eigen::Matrix2d A = pair.image_from_template.cast<double>() * half.asDiagonal();
  CentredHomography model;
  model.G.topLeftCorner<2, 2>() = A;
  model.G.topRightCorner<2, 1>() =
      Eigen::Vector2d(pair.in_image.u, pair.in_image.v) - A * places_[voter].in_template;
  return model;
}

std::vector<int> HomographyGrowth::near(const CentredHomography& model, double reach_px) const {
  const Eigen::Matrix3d& G = model.G;
  Eigen::Matrix2d A = G.topLeftCorner<2, 2>() - G.topRightCorner<2, 1>() * G.block<1, 2>(2, 0);
  A.col(0) *= 2 / (width_px_ - 1);
  A.col(1) *= 2 / (height_px_ - 1);
  Eigen::Matrix3d scaled_from_template;
  scaled_from_template << 2 / (width_px_ - 1), 0, -1, 0, 2 / (height_px_ - 1), -1, 0, 0, 1;
  return votes_.near(G * scaled_from_template, votes_.bounds(A), reach_px);
}

std::vector<int> HomographyGrowth::open_of(std::vector<int> chosen) const {
  const auto is_closed = [this](int i) { return open_[std::size_t(i)] == 0; };
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(), is_closed), chosen.end());
  return chosen;
}

/// One step from a prediction: the nearer to the voter, the more exactly a pair must follow it. So
/// the pairs of a neighbouring copy of the same pattern weigh little.
std::optional<CentredHomography> HomographyGrowth::started(std::size_t voter,
                                                           const std::vector<int>& chosen,
                                                           double noise_px) const {
  const CentredHomography model = predicted(voter);
  HomographyStep step(model);
  for (const int i : chosen) {
    const Place& place = places_[std::size_t(i)];
    const Seen at = seen(model, place.in_template);
    const double variance = votes_.squared_tolerance_px2(voter, std::size_t(i)) / kTolerated;
    const double root = variance / (variance + squared_error(at, place.in_image));
    step.add(place.in_template, at, place.in_image, root * root);
  }
  return step.taken(noise_px * noise_px / (options_.perspective * options_.perspective));
}

/// One step of reweighted least squares at this noise.
std::optional<CentredHomography> HomographyGrowth::stepped(const CentredHomography& model,
                                                           const std::vector<int>& chosen,
                                                           double noise_px) const {
  const double variance = noise_px * noise_px;
  HomographyStep step(model);
  for (const int i : chosen) {
    const Place& place = places_[std::size_t(i)];
    const Seen at = seen(model, place.in_template);
    const double root = variance / (variance + squared_error(at, place.in_image));
    step.add(place.in_template, at, place.in_image, root * root);
  }
  return step.taken(variance / (options_.perspective * options_.perspective));
}

/// The pairs that may become inliers of a model about to settle, one for each place.
std::vector<int> HomographyGrowth::witnesses(const CentredHomography& model) const {
  std::vector<Witness> all;
  for (const int i : near(model, 2 * options_.max_reprojection_px)) {
    const AffinePair& pair = pairs_[std::size_t(i)];
    const Place& place = places_[std::size_t(i)];
    all.push_back({{pair.in_template, pair.in_image},
                   squared_error(seen(model, place.in_template), place.in_image),
                   i});
  }
  return one_to_one(std::move(all), options_.same_place_px);
}

/// The least-squares fit to its own inliers.
std::optional<GrownHomography> HomographyGrowth::settled(CentredHomography model) const {
  const double most = options_.max_reprojection_px * options_.max_reprojection_px;
  const std::vector<int> all = witnesses(model);
  GrownHomography result;
  for (int k = 0; k < kMaxRefits; ++k) {
    std::vector<int> inliers;
    HomographyStep step(model);
    double support = 0;
    for (const int i : all) {
      const Place& place = places_[std::size_t(i)];
      const Seen at = seen(model, place.in_template);
      const double e2 = squared_error(at, place.in_image);
      if (!(e2 < most)) continue;
      inliers.push_back(i);
      support += 1 - e2 / most;
      step.add(place.in_template, at, place.in_image, 1);
    }
    if (int(inliers.size()) < options_.min_inliers) return std::nullopt;
    const auto next = step.taken(0);
    if (!next || !is_possible(*next)) return std::nullopt;
    const bool stays = inliers == result.inliers;
    result = {*next, std::move(inliers), support, 0};
    model = *next;
    if (stays) break;
  }
  return result;
}

std::optional<GrownHomography> HomographyGrowth::grown(std::size_t voter) const {
  const double scale = std::sqrt(double(pairs_[voter].image_from_template.determinant()));
  const double extent_px = scale * std::hypot(width_px_, height_px_) / 2;
  double noise_px = std::max(options_.first_noise_share * extent_px, options_.max_reprojection_px);
  std::vector<int> chosen = open_of(votes_.supporters(voter));
  chosen.push_back(int(voter));
  const auto votes = int(chosen.size());
  auto model = started(voter, chosen, kReach * noise_px);
  if (!model || !is_possible(*model)) return std::nullopt;
  chosen = open_of(near(*model, kReach * noise_px));
  if (int(chosen.size()) < options_.min_inliers) return std::nullopt;
  while (noise_px > options_.max_reprojection_px / 2) {
    model = stepped(*model, chosen, noise_px);
    noise_px /= 2;
    if (!model || !is_possible(*model)) return std::nullopt;
  }
  auto result = settled(*model);
  if (result) result->votes = votes;
  return result;
}

void HomographyGrowth::close(const CentredHomography& image_from_scaled) {
  for (const int i : near(image_from_scaled, kReach * options_.max_reprojection_px)) {
    open_[std::size_t(i)] = 0;
  }
}

}  // namespace kestrel
