#include "kestrel/io/gray_image.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/image_codec.hpp"

namespace kestrel {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes read_bytes(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw FileError(file, 0, "", "there is no such file");
  if (std::filesystem::is_directory(file, ignored)) {
    throw FileError(file, 0, "", "is a folder, not an image; name an image in it");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file, 0, "", "cannot be read; check its permissions");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A JPEG without its end marker: libjpeg would fill the rest with grey and call it an image.
bool is_cut_jpeg(const Bytes& bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return false;
  for (std::size_t i = bytes.size() - 1; i > 0 && i + 4096 > bytes.size(); --i) {
    if (bytes[i - 1] == 0xFF && bytes[i] == 0xD9) return false;
  }
  return true;
}

}  // namespace

cv::Mat as_gray(const cv::Mat& image) {
  if (image.empty() || (image.depth() != CV_8U && image.depth() != CV_16U)) return {};
  cv::Mat gray = image;
  if (image.channels() == 3) cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  if (image.channels() == 4) cv::cvtColor(image, gray, cv::COLOR_BGRA2GRAY);
  if (gray.channels() != 1) return {};
  cv::Mat bytes;
  gray.convertTo(bytes, CV_8U, gray.depth() == CV_16U ? 1.0 / 257 : 1.0);
  return bytes;
}

cv::Mat load_gray(const std::filesystem::path& file) {
  const Bytes bytes = read_bytes(file);
  if (bytes.empty()) throw FileError(file, 0, "", "is empty, no image");
  if (is_cut_jpeg(bytes)) throw FileError(file, 0, "", "is cut short (a JPEG without an end)");
  cv::Mat gray;
  try {
    gray = as_gray(decode_image(bytes));
  } catch (const cv::Exception& error) {
    throw FileError(file, 0, "", "cannot be decoded (" + error.err + ")");
  }
  if (gray.empty()) {
    throw FileError(file, 0, "", "is damaged, cut short or no image of 8 or 16 bits");
  }
  return gray;
}

void save_png(const std::filesystem::path& file, const cv::Mat& gray) {
  const std::vector<unsigned char> bytes = encode_png(gray);
  try {
    write_text(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const std::runtime_error&) {
    std::error_code ignored;  // what is no file of ours, a device say, stays
    if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
    throw;
  }
}

}  // namespace kestrel
