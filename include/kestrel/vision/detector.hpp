#pragma once

#include <memory>
#include <optional>
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

/// Which structures of a frame are searched for.
enum class Structures {
  Usual,  // as options.detect.sift names them; small ones for a template that is small itself
  Small,  // half as large (sigma 0.8 px) and as many more; usual ones where those are not needed
};

/// Finds a template in a window by its keypoints. Keeps its memory from frame to frame.
class Detector {
 public:
  /// The model must have been learned for Detect or Hybrid. A template whose shorter side is below
  /// 128 px is searched for by small structures at once, one below 256 px by usual ones and, where
  /// these did not find it, by small ones, as it may be seen at half its size; unless frames are to
  /// be enlarged.
  Detector(const Template& model, const TrackOptions& options);
  ~Detector();
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;

  /// Whether small structures may tell more than the usual ones did: for a template seen with a
  /// shorter side below 128 px, by where it is expected or by the half of the size it was learned
  /// at.
  bool has_second_look(const std::optional<Homography>& expected) const;

  /// Keypoints of the part of an 8-bit grey image inside window, matched with those of the model
  /// and fitted.
  Detection detect(const cv::Mat& gray, const PixelBox& window,
                   Structures structures = Structures::Usual);

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
