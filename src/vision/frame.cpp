#include "kestrel/vision/frame.hpp"

namespace kestrel {

bool has_image(const Frame& frame) { return !frame.gray.empty() && frame.gray.type() == CV_8UC1; }

}  // namespace kestrel
