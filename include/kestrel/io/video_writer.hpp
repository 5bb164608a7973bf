#pragma once

#include <filesystem>
#include <memory>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// When the pictures of a video are shown.
enum class VideoTimes {
  Steady,      // one after the other at the rate
  OfPictures,  // each when it was captured; Motion JPEG knows the rate only
};

/// Writes a video while it lives: H.264 in .mp4, which browsers play, or Motion JPEG in .avi where
/// that is asked for or FFmpeg has no encoder for H.264. All frames get the size of the first one
/// (made even by a black edge); one of another size is fitted in with black bars.
class VideoWriter {
 public:
  /// path: with the extension .mp4 or .avi; path() tells what it became. frames_per_s > 0. The file
  /// appears with the first frame. Throws std::runtime_error with path, cause and remedy when the
  /// file cannot be created or the disk is full.
  VideoWriter(const std::filesystem::path& path, double frames_per_s,
              VideoTimes times = VideoTimes::Steady);
  /// Closes the video; what is wrong with it then stays unsaid (see close).
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// Appends an 8-bit BGR or grey picture; an empty one is passed over. Throws std::runtime_error
  /// when no encoder takes the first frame.
  void write(const cv::Mat& picture) { write(picture, 0); }

  /// The same; of VideoTimes::OfPictures shown time_s after the first, which must increase.
  void write(const cv::Mat& picture, double time_s);

  /// False once the file could not take all that was written (a full disk).
  bool is_whole() const;

  /// Completes the file. Throws std::runtime_error when it did not get whole (a full disk,
  /// which write keeps to itself: a flight goes on without its video). Nothing to do without frames
  /// or the second time.
  void close();

  /// Where the video is: the path asked for, or .avi in its place.
  const std::filesystem::path& path() const { return path_; }
  long frames() const { return frames_; }

 private:
  struct Encoder;
  void open(const cv::Size& first);

  std::filesystem::path path_;
  double frames_per_s_;
  VideoTimes times_;
  double first_s_ = 0;  // time of the first picture
  long frames_ = 0;
  bool is_closed_ = false;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace kestrel
