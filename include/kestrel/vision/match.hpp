#pragma once

#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// Parameters of the nearest-neighbour search.
struct MatchOptions {
  double ratio = 0.8;  // nearest over second nearest distance, Lowe's test
  int trees = 4;       // randomised kd-trees
  int checks = 64;     // leaves visited best bin first, the bound on the time of one search
  int seed = 1;        // of the randomised trees

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
class Matcher {
 public:
  /// descriptors: n x 128, CV_32F, n >= 2 (std::invalid_argument otherwise).
  Matcher(const cv::Mat& descriptors, const MatchOptions& options);
  ~Matcher();
  Matcher(Matcher&&) noexcept;
  Matcher& operator=(Matcher&&) noexcept;

  /// Matches of the image's descriptors that pass the ratio test, one to one: of several image
  /// keypoints that claim one template keypoint the most distinctive (smallest ratio) stays. In the
  /// order of the image's rows; the same input gives the same matches.
  std::vector<Match> match(const cv::Mat& descriptors) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
  MatchOptions options_;
};

}  // namespace kestrel
