#pragma once

#include <filesystem>
#include <memory>

#include <opencv2/core/mat.hpp>

#include "kestrel/io/video_writer.hpp"

namespace kestrel {

/// What a video file is made of.
enum class VideoKind {
  H264,        // in .mp4, which browsers play
  MotionJpeg,  // in .avi
};

/// A video file while it grows. A write that fails (a full disk) is kept in mind until finish: a
/// flight does not end because its video does.
class VideoEncoder {
 public:
  /// A file that is begun; null when FFmpeg has no encoder for it that starts. size: even.
  /// frames_per_s > 0. Throws std::runtime_error (path, cause) when the file cannot be created.
  static std::unique_ptr<VideoEncoder> open(const std::filesystem::path& path, VideoKind kind,
                                            const cv::Size& size, double frames_per_s,
                                            VideoTimes times);
  ~VideoEncoder();
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;

  /// Appends a BGR picture of this size, shown at time_s (of VideoTimes::Steady: one step after the
  /// last); one that is not later than the last is shown as soon after it as the file can say.
  void write(const cv::Mat& bgr, double time_s);

  /// False once a write has failed.
  bool is_whole() const;

  /// Completes the file; true when all of it is there. Once only.
  bool finish();

 private:
  struct File;
  explicit VideoEncoder(std::unique_ptr<File> file);
  std::unique_ptr<File> file_;
};

}  // namespace kestrel
