#include <csetjmp>
#include <cstring>
#include <stdexcept>

#include <png.h>

#include "kestrel/io/image_codec.hpp"

#include "image_formats.hpp"

namespace kestrel {
namespace {

/// The bytes of the file and how far they are read.
struct Input {
  const std::vector<unsigned char>& bytes;
  std::size_t at = 0;
};

void take(png_structp png, png_bytep out, png_size_t count) {
  Input& input = *static_cast<Input*>(png_get_io_ptr(png));
  if (input.bytes.size() - input.at < count) png_error(png, "cut short");
  std::memcpy(out, input.bytes.data() + input.at, count);
  input.at += count;
}

void ignore(png_structp /*png*/, png_const_charp /*warning*/) {}

/// libpng's reader. Its errors are jumps, so nothing with a destructor may live in a function that
/// calls setjmp.
class PngReader {
 public:
  explicit PngReader(const std::vector<unsigned char>& bytes) : input_{bytes} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, ignore);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// False when it is damaged.
  bool read_header() {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, &input_, take);
    png_read_info(png_, info_);
    return true;
  }

  cv::Size size() const {
    return {int(png_get_image_width(png_, info_)), int(png_get_image_height(png_, info_))};
  }

  /// OpenCV's type of the image; -1 for a kind that is not read here.
  int type() const {
    const int bits = png_get_bit_depth(png_, info_);
    const int colour = png_get_color_type(png_, info_);
    if (bits == 16 && colour == PNG_COLOR_TYPE_GRAY) return CV_16UC1;
    if (bits != 8) return -1;
    if (colour == PNG_COLOR_TYPE_GRAY) return CV_8UC1;
    if (colour == PNG_COLOR_TYPE_RGB) return CV_8UC3;
    return colour == PNG_COLOR_TYPE_RGB_ALPHA ? CV_8UC4 : -1;
  }

  /// Fills rows of the size and type above; false when the file is damaged.
  bool read_rows(std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_bgr(png_);
    if (png_get_bit_depth(png_, info_) == 16) png_set_swap(png_);  // ours is little-endian
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows.data());
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  Input input_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

std::optional<cv::Mat> decode_png(const std::vector<unsigned char>& bytes) {
  PngReader reader(bytes);
  if (!reader.read_header()) return cv::Mat();
  const cv::Size size = reader.size();
  if (reader.type() < 0) return std::nullopt;
  if (double(size.width) * size.height > kMostPixels) return cv::Mat();
  cv::Mat image(size, reader.type());
  std::vector<png_bytep> rows;
  rows.reserve(std::size_t(size.height));
  for (int v = 0; v < size.height; ++v) rows.push_back(image.ptr(v));
  return reader.read_rows(rows) ? image : cv::Mat();
}

std::vector<unsigned char> encode_png(const cv::Mat& gray) {
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("only 8-bit grey pictures are written as PNG");
  }
  png_image head{};
  head.version = PNG_IMAGE_VERSION;
  head.width = png_uint_32(gray.cols);
  head.height = png_uint_32(gray.rows);
  head.format = PNG_FORMAT_GRAY;
  head.flags = PNG_IMAGE_FLAG_FAST;
  std::vector<unsigned char> bytes(PNG_IMAGE_PNG_SIZE_MAX(head));
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&head, bytes.data(), &size, 0, gray.data, png_int_32(gray.step[0]),
                                nullptr) == 0) {
    throw std::runtime_error(std::string("PNG: ") + head.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace kestrel
