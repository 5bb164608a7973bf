#pragma once

#include <vector>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/vision/affine_pair.hpp"
#include "kestrel/vision/affine_votes.hpp"
#include "kestrel/vision/corner_covariance.hpp"
#include "kestrel/vision/homography_growth.hpp"

namespace kestrel {

/// Parameters of the fit by votes.
struct VoteOptions {
  double max_reprojection_px = 3;  // in the image: Mt of the paper
  int min_inliers = 6;             // four fix a homography, two more confirm it: four numbers
  int max_hypotheses = 4;          // answers kept
  int max_tries = 8;               // predictions refined; with max_voters the bound on the time
  int max_voters = 64;             // the most distinctive pairs; all when there are no more
  int min_votes = 2;               // with the voter three pairs: an affine map
  double min_vote_share = 0.25;    // of the most votes: fewer are chance or a worse answer
  AffineVoteOptions agreement;
  double first_noise_share = 0.15;  // as in GrowthOptions, the next two as well
  double perspective = 0.3;
  double same_place_px = 1;
  double distinct_px = 6;       // mean corner distance; twice the tolerance: another answer
  double least_noise_px = 0.5;  // of a coordinate: a few pairs can agree better by chance

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// A homography, the pairs that agree with it, and how well they determine it.
struct FittedHomography {
  Homography image_from_template;
  std::vector<int> inliers;            // indices of pairs, ascending; one for each place
  CornerCovariance corner_covariance;  // px^2, of (u0, v0, ..., u3, v3), as template_corners()
  double support = 0;                  // sum over inliers of 1 - (error / max_reprojection_px)^2
};

/// The homographies that pairs agree with, best support first; empty when nothing agrees. Each of
/// the most distinctive pairs votes once with the affine map that it predicts (Lowe 2004, section
/// 7.3, clusters such predictions in bins); those with most votes grow into homographies. No random
/// trials: the time is bounded, and the order of the pairs does not matter. The template keeps its
/// orientation and is in front of the camera as a whole. Pairs that are not finite support nothing.
/// Several answers differ by more than distinct_px at the corners: a repetitive facade has them.
std::vector<FittedHomography> vote_homographies(const std::vector<AffinePair>& pairs,
                                                double width_px, double height_px,
                                                const VoteOptions& options);

}  // namespace kestrel
