#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/attitude.hpp"

namespace kestrel {

/// One image of the camera.
struct Frame {
  std::int64_t index = 0;  // counts from 0 at the first frame of the source; gaps are lost frames
  double stamp_s = 0;      // capture time, s, on the source's clock
  cv::Mat gray;            // 8-bit, one channel
  /// The helicopter's attitude at capture time, when the source knows it.
  std::optional<Attitude> attitude;
};

/// True when the frame carries what every stage after it needs: pixels, 8-bit, one channel.
bool has_image(const Frame& frame);

/// A camera, a recorded sequence or the simulator.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame; empty at the end. Waits for a live camera. A frame that cannot be decoded is
  /// passed over and named in skipped(). Throws std::runtime_error when the source breaks.
  virtual std::optional<Frame> next() = 0;

  /// The frames passed over so far and why, one sentence each.
  virtual const std::vector<std::string>& skipped() const = 0;

  /// How many frames there will be; empty for a live camera.
  virtual std::optional<std::int64_t> frame_count() const = 0;
};

}  // namespace kestrel
