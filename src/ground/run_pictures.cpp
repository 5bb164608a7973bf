#include "kestrel/ground/run_pictures.hpp"

#include <exception>
#include <utility>

namespace kestrel {
namespace {

/// Images are opened at any frame at once; up to so many are rather passed over than opened anew.
constexpr std::int64_t kNear = 30;

/// Without the view from outside at its left, and the black edge at its right that makes it even.
cv::Mat camera_part(const cv::Mat& gray, int width_px) {
  if (width_px <= 0 || gray.cols <= width_px) return gray;
  const int from = gray.cols >= 2 * width_px ? gray.cols - width_px : 0;
  return gray.colRange(from, from + width_px).clone();
}

}  // namespace

RunPictures::RunPictures(SequenceOptions sequence) : sequence_(std::move(sequence)) {
  source_ = open_sequence(*sequence_);
}

RunPictures::RunPictures(std::filesystem::path video, int width_px)
    : video_(std::move(video)),
      width_px_(width_px),
      reader_(std::make_unique<VideoReader>(video_)) {}

const char* RunPictures::kind() const {
  if (sequence_) return "sequence";
  return video_.empty() ? "none" : "video";
}

cv::Mat RunPictures::picture(std::int64_t row, std::int64_t frame) {
  try {
    if (sequence_) return of_sequence(frame);
    if (!video_.empty()) return of_video(row);
  } catch (const std::exception&) {
    source_.reset();  // a file that went away meanwhile: the numbers are shown without it
    ahead_.reset();
    reader_.reset();
  }
  return {};
}

cv::Mat RunPictures::of_sequence(std::int64_t frame) {
  const bool is_near = source_ && ahead_ && ahead_->index <= frame && frame - ahead_->index < kNear;
  if (!is_near) {
    SequenceOptions from_here = *sequence_;
    from_here.first_frame = frame;
    source_ = open_sequence(from_here);
    ahead_ = source_->next();
  }
  while (ahead_ && ahead_->index < frame) ahead_ = source_->next();
  return ahead_ && ahead_->index == frame ? ahead_->gray : cv::Mat();
}

cv::Mat RunPictures::of_video(std::int64_t row) {
  if (row == last_row_) return last_;
  if (!reader_ || row < next_) {
    reader_ = std::make_unique<VideoReader>(video_);
    next_ = 0;
  }
  for (; next_ < row; ++next_) {
    if (!reader_->skip()) return {};
  }
  const auto read = reader_->next();
  if (!read) return {};
  ++next_;
  last_row_ = row;
  last_ = camera_part(read->gray, width_px_);
  return last_;
}

}  // namespace kestrel
