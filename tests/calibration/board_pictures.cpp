#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

#include "board_views.hpp"

namespace kestrel::test {
namespace {

constexpr int kTexels = 40;  // of the drawn board for each unit of spacing
constexpr int kMargin = 2;   // units of light paper around the points

/// The printed board, kTexels a unit; the first point of board_points lies kMargin units from its
/// left and upper edge.
cv::Mat printed(const Board& board) {
  const std::vector<Eigen::Vector3d> points = board_points(board);
  const Eigen::Vector3d last = points.back() / board.spacing_m;
  const int width = kTexels * int(std::lround(last.x() + 1 + 2 * kMargin));
  const int height = kTexels * int(std::lround(last.y() + 2 * kMargin));
  cv::Mat paper(height, width, CV_8UC1, cv::Scalar(220));
  const auto texel = [](double unit) { return int(std::lround((unit + kMargin) * kTexels)); };
  if (board.pattern == Pattern::Chessboard) {
    for (int row = -1; row < board.rows; ++row)
      for (int column = -1; column < board.columns; ++column)
        if ((row + column) % 2 == 0)
          paper(cv::Rect(texel(column), texel(row), kTexels, kTexels)).setTo(30);
  } else if (board.pattern == Pattern::Charuco) {
    cv::Mat drawn;
    cv::aruco::CharucoBoard::create(board.columns, board.rows, float(board.spacing_m),
                                    float(board.marker_m),
                                    cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50))
        ->draw({board.columns * kTexels, board.rows * kTexels}, drawn, 0, 1);
    drawn.convertTo(drawn, CV_8U, 190.0 / 255, 30);
    drawn.copyTo(paper(cv::Rect(texel(-1), texel(-1), drawn.cols, drawn.rows)));
  } else {
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Vector3d unit = p / board.spacing_m;
      // (texel - 0.5): pixel centres are whole numbers.
      const cv::Point2d centre((unit.x() + kMargin) * kTexels - 0.5,
                               (unit.y() + kMargin) * kTexels - 0.5);
      constexpr int kShift = 8;
      const cv::Point fixed(int(std::lround(centre.x * (1 << kShift))),
                            int(std::lround(centre.y * (1 << kShift))));
      cv::circle(paper, fixed, int(0.3 * kTexels * (1 << kShift)), 30, cv::FILLED, cv::LINE_AA,
                 kShift);
    }
  }
  return paper;
}

}  // namespace

cv::Mat board_picture(const Board& board, const Camera& camera, const TargetPose& pose) {
  constexpr int kOver = 3;  // supersampling along each axis
  const CameraParameters& p = camera.parameters();
  // Texel (i, j) is the place ((i + 0.5) / kTexels - kMargin) * spacing on the board.
  Eigen::Matrix3d metres;
  const double scale = board.spacing_m / kTexels;
  const double shift = 0.5 * scale - kMargin * board.spacing_m;
  metres << scale, 0, shift, 0, scale, shift, 0, 0, 1;
  Eigen::Matrix3d plane;
  plane << pose.rotation.col(0), pose.rotation.col(1), pose.translation;
  Eigen::Matrix3d finer;
  const double half = (kOver - 1) / 2.0;
  finer << kOver, 0, half, 0, kOver, half, 0, 0, 1;
  const Eigen::Matrix3d H = finer * camera.K() * plane * metres;
  cv::Matx33d warp;
  for (int i = 0; i < 9; ++i) warp(i / 3, i % 3) = H(i / 3, i % 3);
  cv::Mat fine;
  cv::warpPerspective(printed(board), fine, warp, {p.width * kOver, p.height * kOver},
                      cv::INTER_LINEAR, cv::BORDER_CONSTANT, 120);
  cv::Mat picture;
  cv::resize(fine, picture, {p.width, p.height}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(picture, picture, {0, 0}, 0.7);  // a sharp lens
  return picture;
}

}  // namespace kestrel::test
