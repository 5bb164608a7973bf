#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/io/csv.hpp"

namespace kestrel {

/// What a sequence's description says, see sequences/README.md.
struct SequenceHead {
  double rate_hz = 30;
  PixelBox template_px;  // whole pixels of the first frame
  Camera camera;
  std::string what;
  std::string origin;
  std::string licence;
};

/// A frame and what is true of it.
struct RecordedFrame {
  std::int64_t index = 0;
  double stamp_s = 0;
  cv::Mat gray;
  TargetPose camera_from_target;
  Homography image_from_first;   // of the target's plane, from the first frame; without the lens
  std::array<Pixel, 4> corners;  // of the template's rectangle, lens included
  bool is_labelled = true;       // false: too much is hidden for a row in the truth
};

/// Throws std::runtime_error (path, remedy) when NAME.yaml is in the folder already.
void require_new_sequence(const std::filesystem::path& folder, const std::string& name);

/// Writes a sequence with truth as `track`, `servo` and `evaluate` read it: NAME.yaml, the frames
/// NAME/000000.png ..., NAME_truth.csv; beside them NAME_homography.csv (frame, nine numbers row by
/// row), NAME_pose.csv (frame, stamp_s, translation in m, theta u in rad of camera_from_target)
/// and NAME_camera.yaml (ROS's camera_info). Every row is on the disk before the
/// next frame, so that an interrupted recording is a shorter one.
class SequenceWriter {
 public:
  /// Makes the folder where it is not there. Throws std::runtime_error with path, cause and remedy:
  /// NAME.yaml exists, or nothing can be written there.
  SequenceWriter(const std::filesystem::path& folder, const std::string& name,
                 const SequenceHead& head);

  /// Throws std::runtime_error as the constructor, std::invalid_argument for a picture that is
  /// empty or not 8-bit grey.
  void write(const RecordedFrame& frame);

 private:
  std::filesystem::path images_;
  LineFile truth_;
  LineFile homography_;
  LineFile pose_;
};

}  // namespace kestrel
