#include "image_module.hpp"

#include <opencv2/imgcodecs.hpp>

namespace kestrel {
namespace {

cv::Mat decode(const std::vector<unsigned char>& bytes) {
  return cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
}

}  // namespace

extern "C" const ImageModule kKestrelModule;
const ImageModule kKestrelModule{decode};

}  // namespace kestrel
