#include "kestrel/calibration/guide_picture.hpp"

#include <cmath>

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "kestrel/calibration/coverage.hpp"

namespace kestrel {
namespace {

const cv::Scalar kGreen(60, 200, 40);
const cv::Scalar kOrange(0, 140, 255);
const cv::Scalar kWhite(255, 255, 255);
constexpr double kTint = 0.25;

void tint_coverage(cv::Mat& bgr, const ViewCollector& views) {
  const ImageSize size{bgr.cols, bgr.rows};
  const Coverage seen = coverage(views.views(), size);
  for (int row = 0; row < seen.rows; ++row) {
    for (int column = 0; column < seen.columns; ++column) {
      if (seen.counts[std::size_t(row) * std::size_t(seen.columns) + std::size_t(column)] == 0)
        continue;
      const int left = column * bgr.cols / seen.columns;
      const int right = (column + 1) * bgr.cols / seen.columns;
      const int top = row * bgr.rows / seen.rows;
      const int bottom = (row + 1) * bgr.rows / seen.rows;
      cv::Mat cell = bgr(cv::Range(top, bottom), cv::Range(left, right));
      const cv::Mat green(cell.size(), CV_8UC3, kGreen);
      cv::addWeighted(cell, 1 - kTint, green, kTint, 0, cell);
    }
  }
}

void draw_points(cv::Mat& bgr, const Offered& offered) {
  const cv::Scalar& colour = offered.kept ? kGreen : kOrange;
  const auto place = [](const BoardPoint& p) {
    return cv::Point(int(std::lround(p.in_image.u)), int(std::lround(p.in_image.v)));
  };
  for (std::size_t i = 0; i < offered.points.size(); ++i) {
    cv::circle(bgr, place(offered.points[i]), 4, colour, 2, cv::LINE_AA);
    if (i > 0 && i < 4)  // where the board begins, and which way its rows run
      cv::line(bgr, place(offered.points[i - 1]), place(offered.points[i]), colour, 2, cv::LINE_AA);
  }
}

void write_line(cv::Mat& bgr, int row, const std::string& words) {
  const int base = bgr.rows - kGuideLines_px + 18 + 22 * row;
  cv::putText(bgr, words, {6, base}, cv::FONT_HERSHEY_SIMPLEX, 0.5, kWhite, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat guide_picture(const cv::Mat& gray, const Offered& offered, const ViewCollector& views) {
  const bool good = !gray.empty() && gray.type() == CV_8UC1;
  const cv::Size size = good ? gray.size() : cv::Size(640, 480);
  cv::Mat out(size.height + kGuideLines_px, size.width, CV_8UC3, cv::Scalar::all(40));
  cv::Mat field = out.rowRange(0, size.height);
  if (good) {
    cv::cvtColor(gray, field, cv::COLOR_GRAY2BGR);
    tint_coverage(field, views);
    draw_points(field, offered);
  } else {
    field.setTo(cv::Scalar::all(128));
  }
  const std::string next = offered.missing.empty() ? "enough" : offered.missing.front();
  write_line(
      out, 0,
      fmt::format("{} kept, {:.0f} %: {}", views.views().size(), 100 * offered.progress, next));
  write_line(out, 1, offered.what);
  return out;
}

}  // namespace kestrel
