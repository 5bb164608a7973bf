#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// A picture of a video.
struct VideoPicture {
  cv::Mat gray;                  // 8-bit, turned upright as the file asks for
  std::optional<double> time_s;  // when it is shown, from the first picture on; absent: not said
};

/// Reads the first video stream of a file, picture after picture, with FFmpeg's libraries. The grey
/// values are those of cv::VideoCapture and as_gray: the same conversion to BGR, then OpenCV's
/// luma.
class VideoReader {
 public:
  /// Throws std::runtime_error (path, remedy) for what is no video or has no decoder.
  explicit VideoReader(const std::filesystem::path& path);
  ~VideoReader();
  VideoReader(const VideoReader&) = delete;
  VideoReader& operator=(const VideoReader&) = delete;

  /// The next picture; empty at the end, also where a damaged file ends.
  std::optional<VideoPicture> next();

  /// Passes over the next picture; false at the end.
  bool skip();

  /// Frames per second as the file says; empty when it says nothing sensible.
  std::optional<double> rate_hz() const;

  /// How many pictures the file promises, or its duration lets expect; 0: not known.
  std::int64_t promised() const;

  /// How many pieces could not be decoded so far: pictures that are missing.
  std::int64_t damaged() const;

 private:
  struct Decoder;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace kestrel
