#pragma once

#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/keypoints.hpp"

namespace kestrel {

/// Parameters of the nearest-neighbour search.
struct MatchOptions {
  double ratio = 0.8;  // nearest over second nearest distance, Lowe's test
  int checks = 200;    // leaves visited best bin first (Lowe 2004, section 7.2): bounds the time
  int seed = 1;        // of the tree's choice among the dimensions of largest variance

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Row i of the template's descriptors looks like row j of the image's.
struct Match {
  int in_template = 0;
  int in_image = 0;
  double ratio = 0;  // nearest over second nearest distance
};

/// kd-tree over the template's descriptors, built once; searched best bin first (Beis & Lowe 1997).
///
/// One tree, not a forest: FLANN of OpenCV 4.6 keeps one queue of branches per thread, as long as
/// the longest tree searched there before, and drops branches that find it full. One tree of n
/// leaves has n - 1 branches and always fits; the branches of several do not, and what is found
/// depends on what the thread searched earlier.
class Matcher {
 public:
  /// descriptors: n x 128, CV_32F, finite, n >= 2 (std::invalid_argument otherwise).
  Matcher(const cv::Mat& descriptors, const MatchOptions& options);
  ~Matcher();
  Matcher(Matcher&&) noexcept;
  Matcher& operator=(Matcher&&) noexcept;

  /// Matches of the image's descriptors that pass the ratio test, one to one: of several image
  /// keypoints that claim one template keypoint the most distinctive (smallest ratio) stays. In the
  /// order of the image's rows; the same input gives the same matches, on any thread and several at
  /// once. None for no rows; throws std::invalid_argument for rows that are not 128 finite floats.
  std::vector<Match> match(const cv::Mat& descriptors) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
  MatchOptions options_;
};

/// The matches as pairs of places, in the order given. SIFT describes one place several times (one
/// keypoint for each dominant orientation, and again at the next scale); counted several times it
/// would pass for the agreement of independent points. Of matches closer than 1 px to each other in
/// the template or in the image the most distinctive (smallest ratio) stays.
std::vector<PixelPair> distinct_pairs(const std::vector<Match>& matches,
                                      const Keypoints& in_template, const Keypoints& in_image);

}  // namespace kestrel
