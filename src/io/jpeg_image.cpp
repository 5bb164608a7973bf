#include <csetjmp>
#include <cstdio>  // before jpeglib.h, which uses FILE
#include <cstdlib>
#include <stdexcept>

#include <jerror.h>
#include <jpeglib.h>

#include "kestrel/io/image_codec.hpp"

#include "image_formats.hpp"

namespace kestrel {
namespace {

/// libjpeg's errors are jumps, so nothing with a destructor may live in a function that calls
/// setjmp.
struct JpegErrors {
  jpeg_error_mgr base{};
  std::jmp_buf back{};
  bool is_cut = false;  // the file ended too early; libjpeg would fill the rest with grey

  JpegErrors() {
    jpeg_std_error(&base);
    base.error_exit = [](j_common_ptr info) { std::longjmp(of(info).back, 1); };
    base.emit_message = [](j_common_ptr info, int /*level*/) {
      of(info).is_cut = of(info).is_cut || info->err->msg_code == JWRN_JPEG_EOF;
    };
  }
  static JpegErrors& of(j_common_ptr info) { return *reinterpret_cast<JpegErrors*>(info->err); }
};

class JpegReader {
 public:
  JpegReader() { info_.err = &errors_.base; }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// False when it is damaged.
  bool read_header(const std::vector<unsigned char>& bytes) {
    if (setjmp(errors_.back) != 0) return false;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, bytes.data(), bytes.size());
    return jpeg_read_header(&info_, TRUE) == JPEG_HEADER_OK;
  }

  cv::Size size() const { return {int(info_.image_width), int(info_.image_height)}; }
  int components() const { return info_.num_components; }

  /// Fills a BGR or grey image of the size above; false when the file is damaged.
  bool read_rows(cv::Mat& image) {
    if (setjmp(errors_.back) != 0) return false;
    info_.out_color_space = image.channels() == 3 ? JCS_EXT_BGR : JCS_GRAYSCALE;
    jpeg_start_decompress(&info_);
    while (info_.output_scanline < info_.output_height && !errors_.is_cut) {
      JSAMPROW row = image.ptr(int(info_.output_scanline));
      jpeg_read_scanlines(&info_, &row, 1);
    }
    if (errors_.is_cut) return false;
    jpeg_finish_decompress(&info_);
    return true;
  }

 private:
  JpegErrors errors_;
  jpeg_decompress_struct info_{};
};

class JpegWriter {
 public:
  JpegWriter() { info_.err = &errors_.base; }
  ~JpegWriter() {
    jpeg_destroy_compress(&info_);
    std::free(bytes_);  // the library allocates it so
  }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;

  /// False when memory is short.
  bool write(const cv::Mat& picture, int quality) {
    if (setjmp(errors_.back) != 0) return false;
    jpeg_create_compress(&info_);
    jpeg_mem_dest(&info_, &bytes_, &size_);
    info_.image_width = JDIMENSION(picture.cols);
    info_.image_height = JDIMENSION(picture.rows);
    info_.input_components = picture.channels();
    info_.in_color_space = picture.channels() == 3 ? JCS_EXT_BGR : JCS_GRAYSCALE;
    jpeg_set_defaults(&info_);
    jpeg_set_quality(&info_, quality, TRUE);
    jpeg_start_compress(&info_, TRUE);
    while (info_.next_scanline < info_.image_height) {
      JSAMPROW row = const_cast<JSAMPROW>(picture.ptr(int(info_.next_scanline)));
      jpeg_write_scanlines(&info_, &row, 1);
    }
    jpeg_finish_compress(&info_);
    return true;
  }

  std::vector<unsigned char> bytes() const { return {bytes_, bytes_ + size_}; }

 private:
  JpegErrors errors_;
  jpeg_compress_struct info_{};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

std::optional<cv::Mat> decode_jpeg(const std::vector<unsigned char>& bytes) {
  JpegReader reader;
  if (!reader.read_header(bytes)) return cv::Mat();
  if (reader.components() != 1 && reader.components() != 3) return std::nullopt;
  if (reader.size().area() > kMostPixels) return cv::Mat();
  cv::Mat image(reader.size(), reader.components() == 3 ? CV_8UC3 : CV_8UC1);
  return reader.read_rows(image) ? image : cv::Mat();
}

std::vector<unsigned char> encode_jpeg(const cv::Mat& picture, int quality) {
  if (picture.empty() || (picture.type() != CV_8UC1 && picture.type() != CV_8UC3))
    throw std::invalid_argument("jpeg: a picture that is neither 8-bit BGR nor 8-bit grey");
  if (quality < 1 || quality > 100) throw std::invalid_argument("jpeg: quality must be 1 to 100");
  JpegWriter writer;
  if (!writer.write(picture, quality)) throw std::runtime_error("jpeg: a picture too large");
  return writer.bytes();
}

}  // namespace kestrel
