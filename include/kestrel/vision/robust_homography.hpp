#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Parameters of the RANSAC of the paper's figure 2.
struct RansacOptions {
  double max_reprojection_px = 3;  // Mt, tolerance of the reprojection error, in the image
  int min_inliers = 8;             // Consensus for a small match table
  double min_inlier_share = 0.15;  // Consensus as a share of a large match table
  int max_trials = 2000;           // the bound on the time of one search
  double confidence = 0.999;       // of having drawn four inliers, before trials end early
  std::uint64_t seed = 1;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Consensus: how many inliers a match table of this size must give, the larger of the two bounds.
int consensus(std::size_t matches, const RansacOptions& options);

/// A homography and the pairs that agree with it.
struct RobustHomography {
  Homography image_from_template;
  std::vector<int> inliers;  // indices of the pairs within tolerance of it, ascending
  int trials = 0;            // four pairs drawn, degenerate ones included
};

/// The homography that most pairs agree with, fitted to those pairs only: four pairs a trial,
/// seeded and bounded (Fischler & Bolles 1981; each better model is refitted to its inliers at
/// once, Chum, Matas & Kittler 2003). It keeps the template's orientation: no mirror image. Empty
/// when the trials end without consensus. Pairs that are not finite support nothing. The same
/// pairs, options and seed give the same bits on every machine.
std::optional<RobustHomography> ransac_homography(const std::vector<PixelPair>& pairs,
                                                  const RansacOptions& options);

}  // namespace kestrel
