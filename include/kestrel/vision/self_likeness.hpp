#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/vision/align.hpp"
#include "kestrel/vision/template_blocks.hpp"

namespace kestrel {

/// Where a picture is like itself.
struct SelfLikeness {
  /// The largest share of its blocks that are alike at one of the places; blocks that come to lie
  /// outside the picture are not alike. 0 for a picture nowhere like itself, above one half for a
  /// chessboard.
  double share = 0;
  std::vector<Homography> places;  // of the picture in itself, most alike first; at most kMaxPlaces

  static constexpr std::size_t kMaxPlaces = 6;
};

/// The places found when the picture is laid over itself shifted by an eighth or more of its size,
/// or turned by a quarter or a half, and aligned. picture: 8-bit grey, the one the blocks were cut
/// from.
SelfLikeness self_likeness(const cv::Mat& picture, const TemplateBlocks& blocks,
                           const AlignOptions& options);

/// The options with the share of alike blocks raised, so that what is like the template as other
/// parts of it are is not taken for it: to a quarter and half the self-likeness.
AgreementOptions beyond_self_likeness(AgreementOptions options, double share);

/// Above this share of alike blocks a place is not one of the places the picture is like itself at:
/// halfway from there to all blocks.
double sure_share(double self_likeness_share);

}  // namespace kestrel
