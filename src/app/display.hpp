#pragma once

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel::app {

struct DisplayModule;
struct ShownWindow;

/// True when there is an X display to open a window on.
bool has_display();

/// Throws std::runtime_error, with what to do, unless there is one.
void require_display();

/// What the mouse did in a window since it was asked last.
enum class Click { None, Left, Right };

/// Lets the user draw the template's rectangle in a window: click one corner, then the opposite
/// one; a right click gives up. Empty when given up. Throws std::runtime_error without a display.
std::optional<PixelBox> select_rectangle(const cv::Mat& gray, const std::string& title);

/// A window that shows pictures (ViSP's vpDisplayX).
class Window {
 public:
  /// Throws std::runtime_error without a display.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Shows a BGR picture, fitted to the window, with a hint for the mouse over it; the oldest click
  /// that was not told yet.
  Click show(const cv::Mat& bgr, const std::string& hint = "");

  /// The oldest click that was not told yet, of what is shown.
  Click click();

 private:
  const DisplayModule& module_;
  ShownWindow* window_;
};

}  // namespace kestrel::app
