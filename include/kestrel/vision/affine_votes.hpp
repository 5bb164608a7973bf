#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

#include "kestrel/vision/affine_pair.hpp"

namespace kestrel {

/// When one pair agrees with what another one predicts. A keypoint's scale and angle are known to
/// about 15 % and 10 degrees, and a tilted plane is only roughly a similarity: the bounds are wide.
/// All of them together still let a chance pair through about once in a thousand.
struct AffineVoteOptions {
  double position_px = 6;       // in the image, next to the keypoint that predicts
  double position_share = 0.5;  // of the distance from that keypoint, added in squares
  double log_scale = 0.75;      // scales by up to 2.1: noise of two keypoints, tilt, perspective
  double same_place_px = 1;     // in the template: keypoints at one place are no second witness

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// How a keypoint may turn and grow: its similarity part a + ib in a disc of the complex plane.
/// With r the ratio of two scales and t the angle between them, the disc of centre cosh(m) z and
/// radius sinh(m) |z| is cosh(log r) <= cosh(m) cos(t): |log r| up to m, and nearly as much angle
/// (40 degrees for m = 0.75), alike for both directions.
struct TurnBounds {
  float a = 0;
  float b = 0;
  float squared_radius = 0;

  /// What is left of the bound, negative where it is broken: the least of several such numbers,
  /// unlike several conditions, makes a loop that runs on vectors.
  float left(float a_there, float b_there) const {
    const float da = a_there - a;
    const float db = b_there - b;
    return squared_radius - (da * da + db * db);
  }
};

/// Which pairs agree with the affine map that each one predicts. Pairs that are not finite or
/// mirrored agree with nothing.
class AffineVotes {
 public:
  AffineVotes(const std::vector<AffinePair>& pairs, const AffineVoteOptions& options);

  /// How many other pairs agree with this one; 0 for a pair that is not usable.
  int count(std::size_t voter) const;

  /// Those pairs, ascending.
  std::vector<int> supporters(std::size_t voter) const;

  /// True for a finite pair that keeps the orientation.
  bool is_usable(std::size_t pair) const { return columns_(Eigen::Index(pair), Usable) > 0; }

  /// How far off the prediction of one pair another pair may be, px^2.
  double squared_tolerance_px2(std::size_t voter, std::size_t pair) const;

  /// What is asked of a pair's scale and angle by a linear map, template px -> image px.
  TurnBounds bounds(const Eigen::Matrix2d& image_from_template) const;

  /// The pairs, ascending, that keep the bounds and are within reach of where H sends them, in
  /// front of the camera. H takes template px to image px, scaled to depth 1 at the template's
  /// centre.
  std::vector<int> near(const Eigen::Matrix3d& H, const TurnBounds& bounds, double reach_px) const;

 private:
  enum Column {
    TemplateU,
    TemplateV,
    ImageU,
    ImageV,
    TurnA,
    TurnB,
    MapXu,
    MapXv,
    MapYu,
    MapYv,
    Usable
  };
  static constexpr int kColumns = Usable + 1;
  struct Prediction;
  struct Limits {
    explicit Limits(const AffineVoteOptions& options);
    float cosh, squared_sinh, squared_share, squared_px, squared_same_place;
  };
  TurnBounds bounds(float a, float b) const;
  Prediction prediction(std::size_t voter) const;
  template <class Left>
  std::vector<int> kept(Left left) const;

  Limits limits_;
  Eigen::Array<float, Eigen::Dynamic, kColumns> columns_;  // a column is contiguous: vector loops
};

}  // namespace kestrel
