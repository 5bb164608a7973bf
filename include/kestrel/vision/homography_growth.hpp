#pragma once

#include <optional>
#include <vector>

#include "kestrel/vision/affine_pair.hpp"
#include "kestrel/vision/affine_votes.hpp"
#include "kestrel/vision/homography_step.hpp"

namespace kestrel {

/// How an affine prediction is refined to a homography.
struct GrowthOptions {
  double max_reprojection_px = 3;   // in the image: Mt of the paper
  int min_inliers = 6;              // four fix a homography, two more confirm it: four numbers
  double first_noise_share = 0.15;  // of half the diagonal in the image: how far a prediction errs
  double perspective = 0.3;         // usual gain of depth from the template's centre to an edge
  double same_place_px = 1;         // in either image: keypoints of several angles count once

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// A homography with the pairs it was fitted to.
struct GrownHomography {
  CentredHomography image_from_scaled;
  std::vector<int> inliers;  // ascending; one for each place
  double support = 0;        // sum over inliers of 1 - (error / max_reprojection_px)^2
  int votes = 0;             // open pairs that agreed with the prediction, its own included
};

/// Local optimisation of single predictions, each on the pairs that earlier answers leave.
class HomographyGrowth {
 public:
  /// Keeps references: the pairs and their votes must outlive it.
  HomographyGrowth(const std::vector<AffinePair>& pairs, const AffineVotes& votes, double width_px,
                   double height_px, const GrowthOptions& options);

  /// The homography that a pair's affine prediction grows into, by iteratively reweighted least
  /// squares under a shrinking tolerance (graduated non-convexity, Blake & Zisserman 1987; weights
  /// of Geman & McClure 1985): nearly affine first, because a wide tolerance cannot see
  /// perspective; then least squares on its inliers alone. Empty when it finds no min_inliers, when
  /// the inliers determine nothing, or when the template would be mirrored or reach behind the
  /// camera.
  std::optional<GrownHomography> grown(std::size_t voter) const;

  /// True until an answer explains the pair.
  bool is_open(std::size_t pair) const { return open_[pair] != 0; }

  /// Closes the pairs that a homography explains: what grows later grows without them.
  void close(const CentredHomography& image_from_scaled);

 private:
  struct Place {
    Eigen::Vector2d in_template;  // scaled to [-1, 1]
    Pixel in_image;
  };
  CentredHomography predicted(std::size_t voter) const;
  std::vector<int> near(const CentredHomography& model, double reach_px) const;
  std::vector<int> open_of(std::vector<int> chosen) const;
  std::vector<int> witnesses(const CentredHomography& model) const;
  std::optional<CentredHomography> started(std::size_t voter, const std::vector<int>& chosen,
                                           double noise_px) const;
  std::optional<CentredHomography> stepped(const CentredHomography& model,
                                           const std::vector<int>& chosen, double noise_px) const;
  std::optional<GrownHomography> settled(CentredHomography model) const;

  const std::vector<AffinePair>& pairs_;
  const AffineVotes& votes_;
  double width_px_;
  double height_px_;
  GrowthOptions options_;
  std::vector<Place> places_;
  std::vector<char> open_;
};

}  // namespace kestrel
