#include "kestrel/calibration/guide_picture.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "board_views.hpp"

namespace kestrel {
namespace {

const Board kBoard = parse_board("chessboard:7x5:0.03");
const Camera kCamera({500, 500, 239.5, 179.5, 480, 360});

cv::Mat picture() {
  return test::board_picture(kBoard, kCamera,
                             test::board_pose_at(kBoard, {0.1, 0}, 0.5, {0.4, 0, 0.1}));
}

/// How many pixels of a part are clearly of one colour: green by much more than red, or the
/// reverse.
int coloured(const cv::Mat& bgr, int strong, int weak) {
  int count = 0;
  for (int v = 0; v < bgr.rows; ++v)
    for (int u = 0; u < bgr.cols; ++u) {
      const auto& p = bgr.at<cv::Vec3b>(v, u);
      if (p[strong] > p[weak] + 80) ++count;
    }
  return count;
}

TEST(GuidePicture, MarksTheBoardGreenWhenThePictureIsKept) {
  ViewCollector views(kBoard, Choose::Guided);
  const cv::Mat gray = picture();
  const Offered kept = views.offer("a", gray);
  ASSERT_TRUE(kept.kept) << kept.what;
  const cv::Mat shown = guide_picture(gray, kept, views);
  EXPECT_EQ(shown.cols, gray.cols);
  EXPECT_EQ(shown.rows, gray.rows + kGuideLines_px);
  const Offered again = views.offer("b", gray);
  const cv::Mat known = guide_picture(gray, again, views);
  // Of each of the 35 points a ring of 4 px radius and 2 px width has some 50 pixels.
  EXPECT_GT(coloured(shown.rowRange(0, gray.rows), 1, 2), 500);
  EXPECT_LT(coloured(shown.rowRange(0, gray.rows), 2, 1), 10);
  EXPECT_GT(coloured(known.rowRange(0, gray.rows), 2, 1), 500);
}

TEST(GuidePicture, TintsWhatIsCovered) {
  ViewCollector views(kBoard, Choose::Guided);
  const cv::Mat gray = picture();
  const Offered none{false, "no board", {}, 0};
  const cv::Mat before = guide_picture(gray, none, views);
  const Offered kept = views.offer("a", gray);
  const cv::Mat after = guide_picture(gray, none, views);
  const Pixel at = kept.points[17].in_image;
  const cv::Vec3b was = before.at<cv::Vec3b>(int(at.v), int(at.u));
  const cv::Vec3b is = after.at<cv::Vec3b>(int(at.v), int(at.u));
  EXPECT_EQ(was[1] - was[2], 0) << "grey";
  EXPECT_GT(is[1] - is[2], 20) << "greenish";
  const cv::Vec3b corner = after.at<cv::Vec3b>(2, 2);
  EXPECT_EQ(corner[1], corner[2]) << "nothing was seen there";
}

TEST(GuidePicture, WritesBelowThePicture) {
  const ViewCollector views(kBoard, Choose::Live);
  const cv::Mat gray = picture();
  const Offered a{false, "hold still", {"turn its left side away"}, 0.3};
  const Offered b{false, "hold still", {"turn its right side away"}, 0.3};
  const cv::Mat first = guide_picture(gray, a, views);
  const cv::Mat other = guide_picture(gray, b, views);
  EXPECT_GT(cv::norm(first.rowRange(gray.rows, first.rows), other.rowRange(gray.rows, first.rows)),
            100);
  EXPECT_EQ(cv::norm(first.rowRange(0, gray.rows), other.rowRange(0, gray.rows)), 0);
}

TEST(GuidePicture, IsAGreyFieldForNoPicture) {
  const ViewCollector views(kBoard, Choose::Live);
  const cv::Mat shown = guide_picture({}, {}, views);
  EXPECT_EQ(shown.size(), cv::Size(640, 480 + kGuideLines_px));
  EXPECT_EQ(shown.at<cv::Vec3b>(100, 100), cv::Vec3b(128, 128, 128));
}

}  // namespace
}  // namespace kestrel
