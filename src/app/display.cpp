#include "display.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <visp3/core/vpDisplay.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpImagePoint.h>
#include <visp3/gui/vpDisplayX.h>

#include <opencv2/imgproc.hpp>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace kestrel::app {
namespace {

vpImage<vpRGBa> to_visp(const cv::Mat& bgr) {
  vpImage<vpRGBa> image(unsigned(bgr.rows), unsigned(bgr.cols));
  cv::Mat view(bgr.rows, bgr.cols, CV_8UC4, image.bitmap);
  cv::cvtColor(bgr, view, cv::COLOR_BGR2RGBA);
  return image;
}

void require_display() {
  if (!has_display()) {
    throw std::runtime_error(
        "no display: DISPLAY is not set; run without --display and give the "
        "template with --roi x,y,w,h");
  }
}

/// The next click: its place, and whether it was the left button.
bool left_click(const vpImage<vpRGBa>& image, vpImagePoint& at) {
  vpMouseButton::vpMouseButtonType button = vpMouseButton::none;
  vpDisplay::getClick(image, at, button, true);
  return button == vpMouseButton::button1;
}

}  // namespace

bool has_display() {
  const char* display = std::getenv("DISPLAY");
  return display != nullptr && *display != '\0';
}

struct Window::Impl {
  vpImage<vpRGBa> image;
  vpDisplayX display;
};

Window::Window(int width, int height, const std::string& title) {
  require_display();
  impl_ = std::make_unique<Impl>();
  impl_->image.resize(unsigned(height), unsigned(width));
  impl_->display.init(impl_->image, 0, 0, title);
}

Window::~Window() = default;

bool Window::show(const cv::Mat& bgr) {
  cv::Mat fitted = bgr;
  const cv::Size size(int(impl_->image.getWidth()), int(impl_->image.getHeight()));
  if (bgr.size() != size) cv::resize(bgr, fitted, size);
  cv::Mat view(size, CV_8UC4, impl_->image.bitmap);
  cv::cvtColor(fitted, view, cv::COLOR_BGR2RGBA);
  vpDisplay::display(impl_->image);
  vpDisplay::flush(impl_->image);
  vpImagePoint at;
  vpMouseButton::vpMouseButtonType button = vpMouseButton::none;
  const bool clicked = vpDisplay::getClick(impl_->image, at, button, false);
  return !(clicked && button == vpMouseButton::button3);
}

std::optional<PixelBox> select_rectangle(const cv::Mat& gray, const std::string& title) {
  require_display();
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

}  // namespace kestrel::app
