#pragma once

#include <opencv2/core/mat.hpp>

#include "dc1394_bus.hpp"

namespace kestrel::iidc {

/// The brightness of a frame of any coding that formats() names, 8 bits, a copy of its own: the Y
/// of YUV as the camera sends it, OpenCV's luma of RGB and of raw pictures, whose colour pattern
/// (pattern) is decoded first; of 16 bits the upper eight of those that the camera uses
/// (data_depth). Throws std::runtime_error for another coding. libdc1394's own conversion to grey
/// knows mono8 and mono16 only.
cv::Mat gray_of(const dc1394video_frame_t& frame, dc1394color_filter_t pattern);

}  // namespace kestrel::iidc
