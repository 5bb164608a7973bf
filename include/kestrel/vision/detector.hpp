#pragma once

#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track_options.hpp"
#include "kestrel/vision/vote_homography.hpp"

namespace kestrel {

/// Where keypoints say the template may be.
struct Detection {
  int keypoints = 0;                         // in the window
  std::vector<AffinePair> pairs;             // keypoints of the template seen in the image
  std::vector<FittedHomography> hypotheses;  // best supported first
};

/// Finds a template in a window by its keypoints. Keeps its memory from frame to frame.
class Detector {
 public:
  /// The model must have been learned for Detect or Hybrid. Frames are searched for the structures
  /// that options.detect.sift names; for a template whose shorter side is below 128 px, unless they
  /// are to be enlarged, for half as large ones (sigma 0.8 px) and for as many more.
  Detector(const Template& model, const TrackOptions& options);
  ~Detector();
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;

  /// Keypoints of the part of an 8-bit grey image inside window, matched with those of the model
  /// and fitted.
  Detection detect(const cv::Mat& gray, const PixelBox& window);

 private:
  struct Memory;
  struct Size {
    double width = 0;
    double height = 0;
  };
  Size size_;
  DetectOptions options_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace kestrel
