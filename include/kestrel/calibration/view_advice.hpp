#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kestrel/calibration/board.hpp"
#include "kestrel/io/camera_file.hpp"

namespace kestrel {

/// Where and how a view shows the board, without any knowledge of the camera: all that guided
/// capture judges by.
struct ViewShape {
  Pixel centre;           // of the board
  PixelBox reach;         // of its points
  double size = 0;        // square root of the share of the image that the board covers
  double lean_right = 0;  // rad: its right side is farther away than its left; negative: nearer
  double lean_down = 0;   // rad: the same of its lower side
  double edge_width_px = 0;
};

/// The shape of a view: from the homography of the board, its tilt by the foreshortening at its
/// centre (cosine: ratio of the singular values), the direction by how depth grows across the
/// image. Exact for a far board; a lens bends it a little. Empty for points that no homography
/// fits.
std::optional<ViewShape> view_shape(const BoardView& view, const Board& board, ImageSize size,
                                    double edge_width_px);

/// What guided capture asks for.
struct GuideOptions {
  int views = 12;                 // how many to collect at least
  double lean_rad = 0.35;         // 20 degrees: below it focal length and distance trade off
  double border = 0.15;           // of the image: the board must reach so near to each border
  double near_size = 0.5;         // of a near view
  double largest_edge_px = 6;     // a wider one is blurred
  double largest_motion = 0.004;  // of the width, from picture to picture of a live camera
  double smallest_change = 0.08;  // of place and size; of tilt, rad, twice as much

  /// Throws std::invalid_argument that names the first option out of its range.
  void check() const;
};

/// What to do with a view, and what to show the camera next.
struct ViewAdvice {
  bool take = false;
  std::string reason;                // why it is not taken; empty when it is
  std::vector<std::string> missing;  // sentences, the most useful first; none: there is enough
  double progress = 0;               // 0 to 1, with this view if it is taken
};

/// Advice on the next view, given those that were kept; `now` empty: no board is seen. The kinds of
/// views asked for (the border on all sides, both tilts both ways, near) are those that ROS's
/// calibrator measures as X, Y, size and skew.
ViewAdvice view_advice(const std::vector<ViewShape>& kept, const std::optional<ViewShape>& now,
                       ImageSize size, const GuideOptions& options = {});

}  // namespace kestrel
