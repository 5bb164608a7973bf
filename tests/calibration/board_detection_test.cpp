#include "kestrel/calibration/board_detection.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "board_views.hpp"

namespace kestrel {
namespace {

const Camera kCamera({500, 500, 239.5, 179.5, 480, 360});

/// A view with some tilt and roll, the board about 300 px wide; of a ChArUco board with its
/// markers.
TargetPose pose_of(const Board& board, double tilt = 0.3) {
  Eigen::Vector3d last = board_points(board).back();
  if (board.pattern == Pattern::Charuco) last.array() += 2 * board.spacing_m;
  const double depth_m = std::max(last.x() / 300, last.y() / 240) * 500;
  return test::board_pose_at(board, {0.01, -0.02}, depth_m, {tilt, -0.2, 0.15});
}

/// The largest distance of the points found from where they are.
double error_px(const Board& board, const std::vector<BoardPoint>& points, const TargetPose& pose) {
  const auto on_board = board_points(board);
  double largest = 0;
  for (const BoardPoint& point : points) {
    const Eigen::Vector3d p = pose * on_board.at(std::size_t(point.id));
    largest = std::max(largest,
                       distance(kCamera.to_pixel({p.x() / p.z(), p.y() / p.z()}), point.in_image));
  }
  return largest;
}

class EachBoard : public ::testing::TestWithParam<const char*> {
 protected:
  Board board_ = parse_board(GetParam());
};

INSTANTIATE_TEST_SUITE_P(FindBoard, EachBoard,
                         ::testing::Values("chessboard:7x5:0.03", "circles:7x5:0.03",
                                           "acircles:4x9:0.02", "charuco:6x5:0.04:0.03"));

// A noiseless picture: corners to a tenth of a pixel; the centre of an ellipse is not the image of
// the circle's centre, at this tilt by less than a tenth of a pixel more.
TEST_P(EachBoard, IsFoundWhereItIs) {
  const TargetPose pose = pose_of(board_);
  const auto points = find_board(test::board_picture(board_, kCamera, pose), board_);
  EXPECT_EQ(points.size(), board_points(board_).size());
  EXPECT_LT(error_px(board_, points, pose), 0.25);
}

TEST_P(EachBoard, IsFoundTwiceTheSame) {
  const cv::Mat picture = test::board_picture(board_, kCamera, pose_of(board_));
  const auto once = find_board(picture, board_);
  const auto again = find_board(picture, board_);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].in_image.u, again[i].in_image.u);
    EXPECT_EQ(once[i].in_image.v, again[i].in_image.v);
  }
}

TEST_P(EachBoard, IsNotFoundInAnEmptyPicture) {
  EXPECT_TRUE(find_board(cv::Mat(360, 480, CV_8UC1, cv::Scalar(90)), board_).empty());
}

// The lower half is grey, as of a picture that was cut short: a ChArUco board gives what is left.
TEST_P(EachBoard, HalfAPictureGivesNoWrongPoints) {
  const TargetPose pose = pose_of(board_);
  cv::Mat picture = test::board_picture(board_, kCamera, pose);
  picture.rowRange(180, 360).setTo(128);
  const auto points = find_board(picture, board_);
  if (board_.pattern == Pattern::Charuco) {
    EXPECT_LT(points.size(), board_points(board_).size());
    EXPECT_LT(error_px(board_, points, pose), 0.25);
  } else {
    EXPECT_TRUE(points.empty());
  }
}

TEST(FindBoard, RefusesWhatIsNoGreyPicture) {
  const Board board;
  EXPECT_THROW(find_board(cv::Mat(), board), std::invalid_argument);
  EXPECT_THROW(find_board(cv::Mat(100, 100, CV_8UC3, cv::Scalar(0)), board), std::invalid_argument);
  EXPECT_THROW(find_board(cv::Mat(100, 100, CV_32F, cv::Scalar(std::nan(""))), board),
               std::invalid_argument);
  Board none;
  none.rows = 0;
  EXPECT_THROW(find_board(cv::Mat(100, 100, CV_8UC1, cv::Scalar(0)), none), std::invalid_argument);
}

TEST(EdgeWidth, GrowsWithBlur) {
  const Board board = parse_board("chessboard:7x5:0.03");
  const cv::Mat sharp = test::board_picture(board, kCamera, pose_of(board));
  const auto points = find_board(sharp, board);
  cv::Mat blurred;
  cv::GaussianBlur(sharp, blurred, {0, 0}, 3);
  const double before = edge_width_px(sharp, points);
  const double after = edge_width_px(blurred, points);
  // The slope of a step under a Gaussian of s px is range / (s sqrt(2 pi)).
  EXPECT_LT(before, 3.5);
  EXPECT_NEAR(after, std::hypot(3, 0.8) * std::sqrt(2 * M_PI), 1.6);
}

TEST(EdgeWidth, IsInfiniteWithoutContrastOrPoints) {
  const cv::Mat grey(100, 100, CV_8UC1, cv::Scalar(90));
  EXPECT_TRUE(std::isinf(edge_width_px(grey, {{0, {10, 10}}, {1, {60, 60}}})));
  EXPECT_TRUE(std::isinf(edge_width_px(grey, {})));
}

}  // namespace
}  // namespace kestrel
