#include "kestrel/calibration/view_collector.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "board_views.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

const Board kBoard = parse_board("chessboard:7x5:0.03");
const Camera kCamera({500, 500, 239.5, 179.5, 480, 360});

cv::Mat picture(double depth_m, double tilt) {
  return test::board_picture(kBoard, kCamera,
                             test::board_pose_at(kBoard, {0, 0}, depth_m, {tilt, 0, 0.1}));
}

TEST(ViewCollector, KeepsEveryPictureThatSomebodyChose) {
  ViewCollector views(kBoard, Choose::All);
  EXPECT_TRUE(views.offer("a", picture(0.4, 0.3)).kept);
  EXPECT_TRUE(views.offer("b", picture(0.35, 0.3)).kept);
  EXPECT_TRUE(views.offer("a again", picture(0.4, 0.3)).kept);
  ASSERT_EQ(views.views().size(), 3u);
  EXPECT_EQ(views.views()[1].name, "b");
  EXPECT_EQ(views.views()[1].points.size(), 35u);
  EXPECT_EQ(views.size().width, 480);
  EXPECT_EQ(views.largest_view(), 1u);
  EXPECT_EQ(views.largest_picture().cols, 480);
}

TEST(ViewCollector, KeepsOfAVideoWhatShowsSomethingNew) {
  ViewCollector views(kBoard, Choose::Guided);
  const Offered first = views.offer("frame 0", picture(0.4, 0.4));
  EXPECT_TRUE(first.kept) << first.what;
  const Offered again = views.offer("frame 1", picture(0.4, 0.4));
  EXPECT_FALSE(again.kept);
  EXPECT_EQ(again.what, "like a view that is kept");
  EXPECT_EQ(again.missing, first.missing);
  EXPECT_TRUE(views.offer("frame 2", picture(0.4, -0.4)).kept);
  EXPECT_EQ(views.views().size(), 2u);
}

TEST(ViewCollector, WaitsUntilABoardBeforeALiveCameraIsStill) {
  ViewCollector views(kBoard, Choose::Live);
  const Offered first = views.offer("0", picture(0.4, 0.4));
  EXPECT_FALSE(first.kept) << "nobody knows whether it moves";
  EXPECT_EQ(first.what, "hold still");
  EXPECT_EQ(first.points.size(), 35u);
  EXPECT_FALSE(views.offer("1", picture(0.37, 0.4)).kept) << "it came 8 % nearer: some pixels";
  EXPECT_FALSE(views.offer("2", cv::Mat(360, 480, CV_8UC1, cv::Scalar(90))).kept);
  EXPECT_EQ(views.offer("3", picture(0.37, 0.4)).what, "hold still") << "it was out of sight";
  EXPECT_TRUE(views.offer("4", picture(0.37, 0.4)).kept);
  EXPECT_EQ(views.offer("5", picture(0.37, 0.4)).what, "like a view that is kept");
  EXPECT_EQ(views.views().size(), 1u);
}

TEST(ViewCollector, SaysWhyAPictureIsNotKept) {
  for (const Choose choose : {Choose::All, Choose::Guided}) {
    ViewCollector views(kBoard, choose);
    const Offered empty = views.offer("wall", cv::Mat(360, 480, CV_8UC1, cv::Scalar(90)));
    EXPECT_FALSE(empty.kept);
    EXPECT_THAT(empty.what, HasSubstr("no board"));
    const Offered small = views.offer("small", cv::Mat(100, 100, CV_8UC1, cv::Scalar(90)));
    EXPECT_THAT(small.what, HasSubstr("100 x 100 px, the first is 480 x 360"));
    EXPECT_TRUE(views.views().empty());
    EXPECT_TRUE(views.largest_picture().empty());
  }
}

TEST(ViewCollector, ChecksItsOptions) {
  Board board;
  board.columns = 0;
  EXPECT_THROW(ViewCollector(board, Choose::All), std::invalid_argument);
  GuideOptions options;
  options.views = 0;
  EXPECT_THROW(ViewCollector(kBoard, Choose::All, options), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
