#include "kestrel/io/image_codec.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "kestrel/io/module.hpp"

#include "image_formats.hpp"
#include "image_module.hpp"

namespace kestrel {
namespace {

using Bytes = std::vector<unsigned char>;

bool begins_with(const Bytes& bytes, std::initializer_list<unsigned char> start) {
  return bytes.size() >= start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}

/// The numbers of a Netpbm header, behind its two letters.
class NetpbmHeader {
 public:
  explicit NetpbmHeader(const Bytes& bytes) : bytes_(bytes) {}

  /// The next number; -1 for none. Before it may stand white space and comments, # to the end of
  /// the line.
  int number() {
    while (at_ < bytes_.size() && (std::isspace(bytes_[at_]) != 0 || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#')
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      else
        ++at_;
    }
    int number = -1;
    for (; at_ < bytes_.size() && std::isdigit(bytes_[at_]) != 0; ++at_) {
      if (number > 100000000) return -1;
      number = 10 * std::max(number, 0) + (bytes_[at_] - '0');
    }
    return number;
  }

  /// Where the pixels begin: one white space ends the header.
  std::size_t end() const { return at_ + 1; }

 private:
  const Bytes& bytes_;
  std::size_t at_ = 2;
};

/// A PGM (P5) or PPM (P6) image of 0 to 255, each row after row (Netpbm's pgm(5), ppm(5)); absent
/// for other ranges, and for what the header leaves unclear.
std::optional<cv::Mat> decode_netpbm(const Bytes& bytes) {
  NetpbmHeader header(bytes);
  const int width = header.number();
  const int height = header.number();
  const int range = header.number();
  if (width <= 0 || height <= 0 || range != 255) return std::nullopt;
  const std::size_t at = header.end();
  const int channels = bytes[1] == '6' ? 3 : 1;
  if (double(width) * height > kMostPixels) return cv::Mat();
  const auto size = std::size_t(width) * std::size_t(height) * std::size_t(channels);
  if (bytes.size() < at || bytes.size() - at < size) return cv::Mat();
  const cv::Mat stored(height, width, CV_8UC(channels), const_cast<unsigned char*>(&bytes[at]));
  cv::Mat image;
  if (channels == 3)
    cv::cvtColor(stored, image, cv::COLOR_RGB2BGR);
  else
    image = stored.clone();
  return image;
}

}  // namespace

cv::Mat decode_image(const Bytes& bytes) {
  std::optional<cv::Mat> image;
  if (begins_with(bytes, {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'})) image = decode_png(bytes);
  if (begins_with(bytes, {0xFF, 0xD8, 0xFF})) image = decode_jpeg(bytes);
  if (begins_with(bytes, {'P', '5'}) || begins_with(bytes, {'P', '6'}))
    image = decode_netpbm(bytes);
  return image ? *image : module_functions<ImageModule>("images").decode(bytes);
}

}  // namespace kestrel
