#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "kestrel/io/svg_plot.hpp"

namespace kestrel {

/// A line in space, m; a point that is not finite leaves a gap.
struct SpaceLine {
  std::string name;  // in the legend; empty: not in it
  std::vector<Eigen::Vector3d> points_m;
  int colour = -1;  // of the palette, 0 ..; -1: by its place
  Stroke stroke = Stroke::Solid;
  /// Whether the picture is made large enough for the whole line; else it is cut at the border.
  enum class Fit { Whole, Cut } fit = Fit::Whole;
};

/// Three axes from a place, written with their letters.
struct SpaceFrame {
  std::string name;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: x, y, z in the drawn space
};

/// From where one looks; parallel projection, so that lengths along one direction compare.
struct SpaceView {
  Eigen::Vector3d up{0, -1, 0};                 // of the drawn space: upwards in the picture
  Eigen::Vector3d towards_eye{-1, -0.7, -1.4};  // any length, not along up
};

/// What svg_space draws.
struct SpacePlot {
  std::string title;
  std::vector<SpaceLine> lines;
  std::vector<SpaceFrame> frames;
  SpaceView view;
  std::string when_empty = "no values to show";
  double width_px = 640;
  double height_px = 420;
};

/// Where a point of space (m) lies in the picture's plane: x to the right, y upwards, m.
Eigen::Vector2d projected(const SpaceView& view, const Eigen::Vector3d& point_m);

/// A static SVG picture of lines and frames in space, with one scale in all directions and a bar
/// that shows it.
std::string svg_space(const SpacePlot& plot);

}  // namespace kestrel
