#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/vision/frame.hpp"

namespace kestrel {

/// A recorded sequence and the part of it that is wanted.
struct SequenceOptions {
  /// A printf pattern (cube/image.%04d.pgm), a folder of images (natural order: 2 before 10), or a
  /// video file.
  std::string input;
  /// Instead of a pattern or folder: these images, frame 0 first. input then names them in errors.
  std::vector<std::filesystem::path> files;
  /// The file number of frame 0 of a pattern; without: the lowest there is.
  std::optional<std::int64_t> first_number;
  std::int64_t first_frame = 0;            // frames before it are passed over in silence
  std::optional<std::int64_t> last_frame;  // included; without: to the end
  /// Frames per second; without: 30 for images, the video's own times for a video.
  std::optional<double> rate_hz;
  /// For images without a rate_hz: the file that says when each was captured (see load_stamps).
  std::optional<std::filesystem::path> stamps;
  std::string package;  // the Debian package that brings the images, for the error message
};

/// Opens a sequence. Frame::index counts from 0 at the sequence's frame 0, whatever first_frame is:
/// the file number less that of frame 0, the place in the folder, or the number of decoded frames
/// before it; so truth files keep their meaning. stamp_s is that of the stamps, else index /
/// rate_hz; an image without a stamp is named in skipped(). Of a video without
/// rate_hz the time at which the frame is shown, from the first one on. A file or a piece of video
/// that is missing in the middle or cannot be decoded is named in skipped() and leaves a gap in the
/// index, as does a video that ends early. A frame of another size than the one before is passed on
/// as it is. Throws std::runtime_error with a remedy: nothing there, an empty folder, no frame in
/// the range, no video, a rate that is not positive.
std::unique_ptr<FrameSource> open_sequence(const SequenceOptions& options);

}  // namespace kestrel
