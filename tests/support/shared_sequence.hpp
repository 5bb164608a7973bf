#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"

namespace kestrel::test {

/// One sequence of the developers' data folder: its images and where the target truly is.
struct SharedSequence {
  std::vector<cv::Mat> frames;  // grey, in order; frames[0] is frame number first_frame
  std::int64_t first_frame = 0;
  PixelBox template_box;                               // in frames[0]
  std::map<std::int64_t, std::array<Pixel, 4>> truth;  // corners by frame number
};

/// The folder of that name in the data folder (KESTREL_DATA_DIR, or shared/data beside the source
/// tree); why it cannot be read, in plain words, when images or truth are not installed.
struct SharedData {
  std::optional<SharedSequence> sequence;
  std::string why_not;
};
SharedData load_shared(const std::string& name);

/// The data folder's rule: corners of the first row of truth mapped by the homography between the
/// first frame and this one, mean distance to the row of this frame, px; empty without a row.
std::optional<double> corner_error_px(const SharedSequence& sequence, std::int64_t frame,
                                      const Homography& image_from_template);

}  // namespace kestrel::test
