#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "kestrel/io/sequence.hpp"
#include "kestrel/io/video_reader.hpp"

namespace kestrel {

/// The pictures of a recorded run, in whatever order they are asked for: of the sequence that was
/// run, or of the annotated video in the run folder. Going on is cheap; going back opens the source
/// anew, and of a video decodes it from its start.
class RunPictures {
 public:
  /// No pictures.
  RunPictures() = default;
  /// Of the sequence. Throws as open_sequence.
  explicit RunPictures(SequenceOptions sequence);
  /// Of a video with a picture for each row of the log; width_px of its columns are the camera's,
  /// the rightmost of one twice as wide (a simulated flight has its view from outside beside them),
  /// else the leftmost; 0: all of them. Throws as VideoReader.
  RunPictures(std::filesystem::path video, int width_px);

  /// The picture, 8-bit grey, of a row of the log and the number of its frame; empty when there is
  /// none. One thread at a time. Does not throw: what cannot be read any more is empty.
  cv::Mat picture(std::int64_t row, std::int64_t frame);

  /// "sequence", "video" or "none".
  const char* kind() const;

 private:
  cv::Mat of_sequence(std::int64_t frame);
  cv::Mat of_video(std::int64_t row);

  std::optional<SequenceOptions> sequence_;
  std::unique_ptr<FrameSource> source_;
  std::optional<Frame> ahead_;  // taken from the source last
  std::filesystem::path video_;
  int width_px_ = 0;
  std::unique_ptr<VideoReader> reader_;
  std::int64_t next_ = 0;  // row that the reader gives next
  std::int64_t last_row_ = -1;
  cv::Mat last_;
};

}  // namespace kestrel
