#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/video_writer.hpp"

namespace kestrel {

/// What is said of a sequence that is recorded.
struct RecordingWords {
  std::string source;  // where the pictures come from
  std::optional<PixelBox>
      template_px;  // absent: the middle of the picture, to be corrected by hand
};

/// A sequence while it is recorded: a folder with one PNG a picture (000000.png, numbered by the
/// picture's index, so lost pictures are gaps), stamps.csv and the description sequence.yaml; or a
/// video file NAME.mp4 with NAME.csv beside it. What was written stays whatever happens.
class SequenceRecorder {
 public:
  /// output: a folder to make, or a file .mp4 in a folder that is there. rate_hz: of the video, for
  /// players that do not look at the stamps. Throws std::runtime_error when the folder exists and
  /// is not empty, or cannot be made.
  SequenceRecorder(const std::filesystem::path& output, RecordingWords words, double rate_hz);

  /// Appends an 8-bit grey picture; index and stamp must increase. Throws std::runtime_error (path,
  /// cause, remedy) when the disk does not take it.
  void write(std::int64_t index, double stamp_s, const cv::Mat& gray);

  /// Completes a video. Throws std::runtime_error when it did not get whole.
  void close();

  std::int64_t pictures() const { return pictures_; }

  /// The description to give to `kestrel track`, or the video.
  const std::filesystem::path& result() const { return result_; }

 private:
  void describe(const cv::Size& size) const;

  std::filesystem::path folder_;  // empty for a video
  std::filesystem::path result_;
  RecordingWords words_;
  std::unique_ptr<VideoWriter> video_;
  std::unique_ptr<LineFile> stamps_;
  std::int64_t pictures_ = 0;
};

}  // namespace kestrel
