#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/homography.hpp"
#include "kestrel/vision/agreement.hpp"
#include "kestrel/vision/image_pyramid.hpp"
#include "kestrel/vision/simd.hpp"
#include "kestrel/vision/template_blocks.hpp"

namespace kestrel {

/// Parameters of the direct alignment.
struct AlignOptions {
  int max_iterations = 10;     // of the finest level; half as many of each coarser one
  double tolerance_px = 0.02;  // a step that moves no corner farther, in the image, is the last
  double weight_scale = 0.25;  // share of a block's variance unexplained that halves its weight^0.5
  int search_radius_px = 4;    // of search(), px of the coarsest level
  AgreementOptions agreement;
  Simd simd = Simd::Auto;
  std::optional<Camera> lens;  // the images are seen through; absent: none

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Where the template is in a frame, by its pixels.
struct Alignment {
  Homography image_from_template;  // through a lens the nearest one (bent_view)
  /// The same place as the camera without its lens would have seen it, aligned through the lens; of
  /// images without one, the same.
  Homography straight_from_template;
  /// Of the template's corners in the image (u0, v0, ..., u3, v3), px^2, from the residuals.
  Matrix8d corner_covariance = Matrix8d::Identity();
  PlaceAgreement agreement;  // of the finest level used and of the next one
  bool is_accepted = false;
  int iterations = 0;  // of all levels
};

/// Aligns a template with frames. A lens is removed where it matters: each block is laid where the
/// lens bends it to, so that a homography is what the plane's view differs by. Keeps its memory:
/// allocates nothing after the first frame.
class Aligner {
 public:
  /// Throws std::invalid_argument for options that do not check.
  Aligner(TemplateBlocks blocks, const AlignOptions& options);
  ~Aligner();
  Aligner(Aligner&&) noexcept;
  Aligner& operator=(Aligner&&) noexcept;

  /// Levels an image pyramid should have so that the template can be aligned at its coarsest one.
  int levels() const;

  /// The share, 0 to 1, of the template's texture that the image shows at this place, at the
  /// coarsest level.
  double likeness(const ImagePyramid& image, const Homography& image_from_template);

  /// The same at the finest level that is used there.
  double detail(const ImagePyramid& image, const Homography& image_from_template);

  /// The start, or the place next to it, shifted by whole pixels of the coarsest level, where the
  /// image shows more of the template's texture.
  Homography search(const ImagePyramid& image, const Homography& start);

  /// Inverse-compositional alignment (Baker & Matthews 2004) from coarse to fine: gain and bias of
  /// each block are projected out, and blocks that do not fit lose their weight. Empty when less
  /// than the agreement's share of the blocks lies in the image, or the answer is no view of the
  /// template.
  std::optional<Alignment> align(const ImagePyramid& image, const Homography& start);

 private:
  struct Parts;
  AlignOptions options_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kestrel
