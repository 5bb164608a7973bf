#include "kestrel/io/video_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "kestrel/io/csv.hpp"

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

// True when the boxes of an MP4 file (ISO/IEC 14496-12, 4.2: size and type, big-endian) end with
// the file and the index, moov, is among them.
bool is_whole_mp4(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const auto file_size = std::uint64_t(fs::file_size(path));
  bool has_index = false;
  std::uint64_t at = 0;
  while (at + 8 <= file_size) {
    std::array<unsigned char, 16> head{};
    file.seekg(std::streamoff(at));
    file.read(reinterpret_cast<char*>(head.data()), std::streamsize(head.size()));
    file.clear();
    const auto big_endian = [&](std::size_t begin, std::size_t count) {
      std::uint64_t value = 0;
      for (std::size_t i = begin; i < begin + count; ++i) value = value << 8 | head[i];
      return value;
    };
    const std::uint64_t size = big_endian(0, 4) == 1 ? big_endian(8, 8) : big_endian(0, 4);
    if (size < 8) return false;
    has_index = has_index || std::equal(head.begin() + 4, head.begin() + 8, "moov");
    at += size;
  }
  return has_index && at == file_size;
}

// An AVI file (RIFF: size, little-endian, at byte 4) is whole when its first chunk ends with it.
bool is_whole_avi(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<unsigned char, 8> head{};
  file.read(reinterpret_cast<char*>(head.data()), std::streamsize(head.size()));
  const std::uint64_t size = head[4] | head[5] << 8 | head[6] << 16 | std::uint64_t(head[7]) << 24;
  return file && size > 0 && size + 8 <= fs::file_size(path);
}

}  // namespace

struct VideoWriter::Encoder {
  cv::VideoWriter writer;
  cv::Size size;
};

VideoWriter::VideoWriter(const fs::path& path, double frames_per_s)
    : path_(path), frames_per_s_(frames_per_s) {
  if (!(frames_per_s > 0) || !std::isfinite(frames_per_s))
    throw std::invalid_argument("video: frames per second must be positive");
  write_text(path, std::string(4096, '\0'));  // says what is wrong with the path; OpenCV would not
  if (fs::is_regular_file(path)) fs::remove(path);
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::open(const cv::Size& size) {
  encoder_ = std::make_unique<Encoder>();
  encoder_->size = {size.width + size.width % 2, size.height + size.height % 2};
  cv::VideoWriter& writer = encoder_->writer;
  if (writer.open(path_.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                  frames_per_s_, encoder_->size))
    return;
  fs::path avi = path_;
  avi.replace_extension(".avi");
  const int motion_jpeg = cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  if (!writer.open(avi.string(), cv::CAP_OPENCV_MJPEG, motion_jpeg, frames_per_s_, encoder_->size))
    throw std::runtime_error(path_.string() +
                             ": no video encoder starts; run without video, or install ffmpeg");
  path_ = avi;
}

void VideoWriter::write(const cv::Mat& picture) {
  if (picture.empty()) return;
  const cv::Mat bgr = as_bgr(picture);
  if (!encoder_) open(bgr.size());
  encoder_->writer.write(fitted(bgr, encoder_->size));
  ++frames_;
}

void VideoWriter::close() {
  if (!encoder_ || !encoder_->writer.isOpened()) return;
  encoder_->writer.release();
  std::error_code error;
  const bool exists = fs::exists(path_, error);
  const bool is_mp4 = path_.extension() != ".avi";
  if (!exists || !(is_mp4 ? is_whole_mp4(path_) : is_whole_avi(path_)))
    throw std::runtime_error(path_.string() +
                             ": the video is not whole; free some space on its disk");
}

}  // namespace kestrel
