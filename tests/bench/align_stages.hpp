#pragma once

namespace kestrel::test {

/// Registers the times of the stages of a frame that is followed by its pixels, "aligned/...", with
/// Google Benchmark; the frame's pyramid beside cv::resize.
void register_align_stages();

}  // namespace kestrel::test
