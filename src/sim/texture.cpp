#include "kestrel/sim/texture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "random.hpp"
#include "texture/grain.hpp"

namespace kestrel {
namespace {

using sim_detail::clouds;
using sim_detail::grained;
using sim_detail::RandomStream;

void require_size(int width_px, int height_px) {
  if (width_px < 16 || height_px < 16) {
    throw std::invalid_argument("a texture must be at least 16x16 px");
  }
}

cv::Point point_in(const cv::Mat& picture, RandomStream& random) {
  return {random.integer(0, picture.cols - 1), random.integer(0, picture.rows - 1)};
}

/// A polygon of 3 to 7 corners about a centre.
std::vector<cv::Point> blot(cv::Point centre, double radius, RandomStream& random) {
  std::vector<cv::Point> corners;
  const int n = random.integer(3, 7);
  const double turn = random.uniform(0, 2 * M_PI);
  for (int i = 0; i < n; ++i) {
    const double angle = turn + 2 * M_PI * (i + random.uniform(-0.3, 0.3)) / n;
    const double r = radius * random.uniform(0.5, 1.2);
    corners.emplace_back(cvRound(centre.x + r * std::cos(angle)),
                         cvRound(centre.y + r * std::sin(angle)));
  }
  return corners;
}

void draw_shape(cv::Mat& picture, double radius, RandomStream& random) {
  const cv::Point at = point_in(picture, random);
  const int grey = random.integer(15, 240);
  const int line = std::max(1, int(radius * random.uniform(0.1, 0.4)));
  const cv::Size half(std::max(1, int(radius)), std::max(1, int(radius * random.uniform(0.4, 1))));
  const double angle = random.uniform(0, 360);
  switch (random.integer(0, 3)) {
    case 0:
      cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{blot(at, radius, random)}, grey,
                   cv::LINE_AA);
      break;
    case 1:
      cv::ellipse(picture, at, half, angle, 0, 360, grey, cv::FILLED, cv::LINE_AA);
      break;
    case 2:
      cv::ellipse(picture, at, half, angle, 0, random.uniform(120, 360), grey, line, cv::LINE_AA);
      break;
    default:
      cv::line(picture, at,
               at + cv::Point(int(2 * radius * std::cos(angle)), int(2 * radius * std::sin(angle))),
               grey, line, cv::LINE_AA);
  }
}

/// Shapes from a fifth of the picture down to a few pixels: as many more as they are smaller.
void draw_shapes(cv::Mat& picture, RandomStream& random) {
  const double side = std::min(picture.cols, picture.rows);
  int count = 14;
  double radius = side / 6;
  while (radius >= 2) {
    for (int i = 0; i < std::min(count, 260); ++i) {
      draw_shape(picture, radius * random.uniform(0.7, 1.3), random);
    }
    radius /= 1.7;
    count *= 2;
  }
}

/// A word over a plate of the opposite tone, height_px high, its baseline starting at (x, y).
void draw_word(cv::Mat& picture, const std::string& word, cv::Point at, double height_px,
               int grey) {
  constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
  const double scale = height_px / 22;  // capitals of the font are 22 px high
  const int line = std::max(1, int(std::lround(height_px / 7)));
  const cv::Point shadow(std::max(1, line / 2), std::max(1, line / 2));
  cv::putText(picture, word, at + shadow, kFont, scale, 255 - grey, line, cv::LINE_AA);
  cv::putText(picture, word, at, kFont, scale, grey, line, cv::LINE_AA);
}

void draw_words(cv::Mat& picture, RandomStream& random) {
  const char* const words[] = {"HOVER", "GAZE", "WIND", "FIELD", "NORTH", "0.5 m/s", "H = K[R|t]"};
  const double h = picture.rows;
  const double w = picture.cols;
  double y = 0.11;  // of the height; the middle is left to the title
  for (const char* word : words) {
    const double size = h * random.uniform(0.03, 0.06);
    const cv::Point at(int(w * random.uniform(0.03, 0.7)), int(h * y));
    draw_word(picture, word, at, size, random.integer(0, 1) ? 235 : 20);
    y += y < 0.25 || y > 0.6 ? 0.075 : 0.45;
  }
  draw_word(picture, "KESTREL", {int(w * 0.07), int(h * 0.56)}, std::min(h * 0.17, w * 0.12), 245);
}

/// One window of the facade: frame, four panes that mirror a different piece of sky each.
void draw_window(cv::Mat& picture, const cv::Rect& hole, RandomStream& random) {
  const int frame = std::max(1, hole.width / 16);
  cv::rectangle(picture, hole, 225, cv::FILLED);
  const int half_w = (hole.width - 3 * frame) / 2;
  const int half_h = (hole.height - 3 * frame) / 2;
  if (half_w < 1 || half_h < 1) return;
  for (int i = 0; i < 4; ++i) {
    const cv::Rect pane(hole.x + frame + (i % 2) * (half_w + frame),
                        hole.y + frame + (i / 2) * (half_h + frame), half_w, half_h);
    cv::rectangle(picture, pane, random.integer(40, 75), cv::FILLED);
  }
  const cv::Rect sill(hole.x - frame, hole.y + hole.height, hole.width + 2 * frame, 2 * frame);
  cv::rectangle(picture, sill, 190, cv::FILLED);
}

void draw_bricks(cv::Mat& picture, double px_per_m, RandomStream& random) {
  const double length = 0.5 * px_per_m;  // blocks of 0.50 x 0.20 m with joints of 2 cm
  const double height = 0.2 * px_per_m;
  const double joint = 0.02 * px_per_m;
  for (int row = 0; row * height < picture.rows; ++row) {
    const double y = row * height;
    const double shift = row % 2 ? -length / 2 : 0;  // every other row by half a block
    for (int column = 0; shift + column * length < picture.cols; ++column) {
      const double x = shift + column * length;
      const cv::Rect brick(cv::Point(cvRound(x + joint), cvRound(y + joint)),
                           cv::Point(cvRound(x + length), cvRound(y + height)));
      cv::rectangle(picture, brick, random.integer(112, 150), cv::FILLED);
    }
  }
}

}  // namespace

cv::Mat poster(int width_px, int height_px, std::uint64_t seed) {
  require_size(width_px, height_px);
  RandomStream random(seed);
  const cv::Mat noise = clouds({width_px, height_px}, height_px / 2.0, 0.65, random);
  cv::Mat picture = grained(cv::Mat(height_px, width_px, CV_8U, cv::Scalar(128)), noise, 190);
  draw_shapes(picture, random);
  draw_words(picture, random);
  picture = grained(picture, noise, 45);
  const int rim = std::max(1, height_px / 60);
  cv::rectangle(picture, cv::Rect(0, 0, width_px, height_px), 30, rim);
  return picture;
}

cv::Mat facade(int width_px, int height_px, double px_per_m, std::uint64_t seed) {
  require_size(width_px, height_px);
  if (!(px_per_m > 0)) throw std::invalid_argument("px_per_m: must be positive");
  RandomStream random(seed);
  cv::Mat picture(height_px, width_px, CV_8U, cv::Scalar(165));
  draw_bricks(picture, px_per_m, random);
  const double across = 3.0 * px_per_m;  // a window of 0.9 x 1.6 m every 3.0 x 3.2 m
  const double down = 3.2 * px_per_m;
  for (double y = 0.8 * px_per_m; y + 1.8 * px_per_m < height_px; y += down) {
    for (double x = 1.05 * px_per_m; x + 1.0 * px_per_m < width_px; x += across) {
      draw_window(picture,
                  {cvRound(x), cvRound(y), cvRound(0.9 * px_per_m), cvRound(1.6 * px_per_m)},
                  random);
    }
  }
  const cv::Mat noise = clouds(picture.size(), 4 * px_per_m, 0.75, random);
  return grained(picture, noise, 60);
}

cv::Mat ground(int width_px, int height_px, std::uint64_t seed) {
  require_size(width_px, height_px);
  RandomStream random(seed);
  const cv::Mat noise = clouds({width_px, height_px}, 128, 0.85, random);
  return grained(cv::Mat(height_px, width_px, CV_8U, cv::Scalar(105)), noise, 160);
}

}  // namespace kestrel
