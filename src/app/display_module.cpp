#include "display_module.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <visp3/core/vpDisplay.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpImagePoint.h>
#include <visp3/gui/vpDisplayX.h>

#include <opencv2/imgproc.hpp>

#include "display.hpp"

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace kestrel::app {

struct ShownWindow {
  vpImage<vpRGBa> image;
  vpDisplayX display;
};

namespace {

vpImage<vpRGBa> to_visp(const cv::Mat& bgr) {
  vpImage<vpRGBa> image(unsigned(bgr.rows), unsigned(bgr.cols));
  cv::Mat view(bgr.rows, bgr.cols, CV_8UC4, image.bitmap);
  cv::cvtColor(bgr, view, cv::COLOR_BGR2RGBA);
  return image;
}

/// The next click: its place, and whether it was the left button.
bool left_click(const vpImage<vpRGBa>& image, vpImagePoint& at) {
  vpMouseButton::vpMouseButtonType button = vpMouseButton::none;
  vpDisplay::getClick(image, at, button, true);
  return button == vpMouseButton::button1;
}

ShownWindow* open_window(int width, int height, const std::string& title) {
  auto window = std::make_unique<ShownWindow>();
  window->image.resize(unsigned(height), unsigned(width));
  window->display.init(window->image, 0, 0, title);
  return window.release();
}

void show(ShownWindow& window, const cv::Mat& bgr, const std::string& hint) {
  cv::Mat fitted = bgr;
  const cv::Size size(int(window.image.getWidth()), int(window.image.getHeight()));
  if (bgr.size() != size) cv::resize(bgr, fitted, size);
  cv::Mat view(size, CV_8UC4, window.image.bitmap);
  cv::cvtColor(fitted, view, cv::COLOR_BGR2RGBA);
  vpDisplay::display(window.image);
  // Twice, so that it is read on any picture.
  if (!hint.empty()) {
    vpDisplay::displayText(window.image, 21, 11, hint, vpColor::black);
    vpDisplay::displayText(window.image, 20, 10, hint, vpColor::yellow);
  }
  vpDisplay::flush(window.image);
}

Click click(ShownWindow& window) {
  vpImagePoint at;
  vpMouseButton::vpMouseButtonType button = vpMouseButton::none;
  if (!vpDisplay::getClick(window.image, at, button, false)) return Click::None;
  if (button == vpMouseButton::button1) return Click::Left;
  return button == vpMouseButton::button3 ? Click::Right : Click::None;
}

void close_window(ShownWindow* window) { delete window; }

std::optional<PixelBox> draw_rectangle(const cv::Mat& gray, const std::string& title) {
  cv::Mat bgr;
  cv::cvtColor(gray, bgr, cv::COLOR_GRAY2BGR);
  vpImage<vpRGBa> image = to_visp(bgr);
  vpDisplayX display(image, 0, 0, title);
  vpDisplay::display(image);
  vpDisplay::displayText(image, 20, 10, "Click two opposite corners of the object (right: give up)",
                         vpColor::red);
  vpDisplay::flush(image);
  vpImagePoint a;
  vpImagePoint b;
  if (!left_click(image, a)) return std::nullopt;
  vpDisplay::displayCross(image, a, 15, vpColor::green, 2);
  vpDisplay::flush(image);
  if (!left_click(image, b)) return std::nullopt;
  const double left = std::round(std::min(a.get_u(), b.get_u()));
  const double top = std::round(std::min(a.get_v(), b.get_v()));
  return PixelBox{left, top, std::round(std::max(a.get_u(), b.get_u())) - left + 1,
                  std::round(std::max(a.get_v(), b.get_v())) - top + 1};
}

}  // namespace

extern "C" const DisplayModule kKestrelModule;
const DisplayModule kKestrelModule{draw_rectangle, open_window, show, click, close_window};

}  // namespace kestrel::app
