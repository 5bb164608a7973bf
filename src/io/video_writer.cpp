#include "kestrel/io/video_writer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <opencv2/imgproc.hpp>

#include "kestrel/io/csv.hpp"

#include "video_encoder.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

cv::Mat as_bgr(const cv::Mat& picture) {
  cv::Mat bgr;
  if (picture.type() == CV_8UC3) return picture;
  if (picture.type() != CV_8UC1)
    throw std::invalid_argument("video: a picture that is neither 8-bit BGR nor 8-bit grey");
  cv::cvtColor(picture, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

// The picture unchanged in the upper-left of a field one larger where its size is odd, or shrunk
// or grown to fit between bars.
cv::Mat fitted(const cv::Mat& picture, const cv::Size& size) {
  if (picture.size() == size) return picture;
  cv::Mat field(size, CV_8UC3, cv::Scalar::all(0));
  const cv::Size even(picture.cols + picture.cols % 2, picture.rows + picture.rows % 2);
  if (even == size) {
    picture.copyTo(field(cv::Rect(cv::Point(), picture.size())));
    return field;
  }
  const double scale =
      std::min(double(size.width) / picture.cols, double(size.height) / picture.rows);
  const cv::Size inner(std::clamp(int(std::lround(scale * picture.cols)), 1, size.width),
                       std::clamp(int(std::lround(scale * picture.rows)), 1, size.height));
  const cv::Point corner((size.width - inner.width) / 2, (size.height - inner.height) / 2);
  cv::Mat place = field(cv::Rect(corner, inner));
  cv::resize(picture, place, inner, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return field;
}

}  // namespace

struct VideoWriter::Encoder {
  cv::Size size;
  std::unique_ptr<VideoEncoder> file;
};

VideoWriter::VideoWriter(const fs::path& path, double frames_per_s, VideoTimes times)
    : path_(path), frames_per_s_(frames_per_s), times_(times) {
  if (!(frames_per_s > 0) || !std::isfinite(frames_per_s))
    throw std::invalid_argument("video: frames per second must be positive");
  write_text(path, std::string(4096, '\0'));  // says what is wrong with the path; FFmpeg would not
  if (fs::is_regular_file(path)) fs::remove(path);
}

VideoWriter::~VideoWriter() {
  if (encoder_) encoder_->file->finish();
}

void VideoWriter::open(const cv::Size& first) {
  const cv::Size size(first.width + first.width % 2, first.height + first.height % 2);
  std::unique_ptr<VideoEncoder> file;
  if (path_.extension() != ".avi")
    file = VideoEncoder::open(path_, VideoKind::H264, size, frames_per_s_, times_);
  if (!file) {
    times_ = VideoTimes::Steady;
    path_.replace_extension(".avi");
    file = VideoEncoder::open(path_, VideoKind::MotionJpeg, size, frames_per_s_, times_);
  }
  if (!file)
    throw std::runtime_error(path_.string() +
                             ": no video encoder starts; run without video, or install ffmpeg");
  encoder_ = std::make_unique<Encoder>();
  *encoder_ = {size, std::move(file)};
}

void VideoWriter::write(const cv::Mat& picture, double time_s) {
  if (picture.empty() || is_closed_) return;
  const cv::Mat bgr = as_bgr(picture);
  if (!encoder_) {
    open(bgr.size());
    first_s_ = time_s;
  }
  encoder_->file->write(fitted(bgr, encoder_->size), time_s - first_s_);
  ++frames_;
}

bool VideoWriter::is_whole() const { return !encoder_ || encoder_->file->is_whole(); }

void VideoWriter::close() {
  if (!encoder_ || is_closed_) return;
  is_closed_ = true;
  const bool is_whole = encoder_->file->finish();
  encoder_.reset();
  if (!is_whole)
    throw std::runtime_error(path_.string() +
                             ": the video is not whole; free some space on its disk");
}

}  // namespace kestrel
