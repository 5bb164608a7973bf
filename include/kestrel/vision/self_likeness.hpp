#pragma once

#include <opencv2/core/mat.hpp>

#include "kestrel/vision/align.hpp"
#include "kestrel/vision/template_blocks.hpp"

namespace kestrel {

/// How much a picture is like itself somewhere else: the largest share of its blocks that are alike
/// when it is laid over itself shifted by an eighth or more of its size, or turned by a quarter or
/// a half; blocks that come to lie outside the picture are not alike. 0 when it is nowhere like
/// itself, above one half for a chessboard. picture: 8-bit grey, the one the blocks were cut from.
double self_likeness(const cv::Mat& picture, const TemplateBlocks& blocks,
                     const AlignOptions& options);

/// The options with the share of alike blocks raised so far that no place where the picture is like
/// itself is taken for the right one: halfway from there to all blocks.
AgreementOptions beyond_self_likeness(AgreementOptions options, double self_likeness);

}  // namespace kestrel
