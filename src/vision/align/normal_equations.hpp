#pragma once

#include <optional>
#include <vector>

#include "kestrel/vision/align.hpp"
#include "kestrel/vision/template_blocks.hpp"

#include "block_kernels.hpp"

namespace kestrel {

/// Normal equations of one step, weighted by the residuals' variance and the robust weights.
struct Normal {
  Matrix8d information = Matrix8d::Zero();
  Vector8d gradient = Vector8d::Zero();
  double residual = 0;  // weighted sum of squared residuals over their variance
  double freedom = 0;   // weighted number of residuals
  int blocks = 0;       // that take part
  double shown = 0;     // share of the template's texture that the image shows, 0 to 1
};

/// From the sums over the blocks of a level, in the order of its blocks.
Normal normal_equations(const BlockLevel& level, const std::vector<kernel::BlockSums>& sums,
                        const AlignOptions& options, const BlockOptions& noise);

/// Solution for the first parameters of warp(), the others zero; empty when they are not
/// determined.
std::optional<Vector8d> solved(const Normal& n, int parameters);

/// Zero-mean normalised cross-correlation of a visible block with the image; 0 where the image
/// shows nothing.
double zncc(const TemplateBlock& block, const kernel::BlockSums& sums);

}  // namespace kestrel
