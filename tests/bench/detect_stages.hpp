#pragma once

namespace kestrel::test {

/// Registers the times of detections and of their stages, "detected/...", with Google Benchmark: in
/// a window of 256x256 px and in the frame of 640x480 px, beside cv::SIFT, FLANN and
/// cv::findHomography in the same.
void register_detect_stages();

}  // namespace kestrel::test
