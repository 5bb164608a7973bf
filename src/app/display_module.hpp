#pragma once

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel::app {

enum class Click;

/// A window of ViSP's; only the module knows what is in it.
struct ShownWindow;

/// What kestrel_display.so gives: ViSP's windows, which come with Qt. All need a display.
struct DisplayModule {
  /// As app::select_rectangle.
  std::optional<PixelBox> (*select_rectangle)(const cv::Mat& gray, const std::string& title);
  /// A new window; its owner closes it.
  ShownWindow* (*open)(int width, int height, const std::string& title);
  /// Shows a picture with a hint over it; see Window::show.
  void (*show)(ShownWindow& window, const cv::Mat& bgr, const std::string& hint);
  /// As Window::click.
  Click (*click)(ShownWindow& window);
  void (*close)(ShownWindow* window);
};

}  // namespace kestrel::app
