#include "display.hpp"

#include <cstdlib>
#include <stdexcept>

#include "kestrel/io/module.hpp"

#include "display_module.hpp"

namespace kestrel::app {
namespace {

/// Throws without a display; loads the module else.
const DisplayModule& display_module() {
  require_display();
  return module_functions<DisplayModule>("display");
}

}  // namespace

bool has_display() {
  const char* display = std::getenv("DISPLAY");
  return display != nullptr && *display != '\0';
}

void require_display() {
  if (has_display()) return;
  throw std::runtime_error(
      "no display: DISPLAY is not set; run without --display, and where a template is "
      "wanted give it with --roi x,y,w,h");
}

Window::Window(int width, int height, const std::string& title)
    : module_(display_module()), window_(module_.open(width, height, title)) {}

Window::~Window() { module_.close(window_); }

Click Window::show(const cv::Mat& bgr, const std::string& hint) {
  module_.show(*window_, bgr, hint);
  return click();
}

Click Window::click() { return module_.click(*window_); }

std::optional<PixelBox> select_rectangle(const cv::Mat& gray, const std::string& title) {
  return display_module().select_rectangle(gray, title);
}

}  // namespace kestrel::app
