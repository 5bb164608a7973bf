#include "kestrel/vision/straight_template.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace kestrel {
namespace {

const CameraParameters kNone{300, 300, 159.5, 119.5, 320, 240};
const PixelBox kBox{60, 40, 200, 160};

Camera bent() {
  CameraParameters p = kNone;
  p.lens = Lens::PlumbBob;
  p.distortion = {-0.25, 0.05, 1e-3, -1e-3, 0};
  return Camera(p);
}

/// Stripes that are straight for the camera without its lens: grey of a place on the plane.
double grey(const ImagePoint& m) {
  return 128 + 60 * std::sin(40 * m.x + 0.3) + 40 * std::cos(35 * m.y);
}

cv::Mat seen_through(const Camera& camera) {
  cv::Mat picture(240, 320, CV_8UC1);
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u)
      picture.at<uchar>(v, u) =
          cv::saturate_cast<uchar>(grey(camera.to_image_point({double(u), double(v)})));
  return picture;
}

TEST(StraightTemplate, IsThePictureWithoutALens) {
  const cv::Mat picture = seen_through(Camera(kNone));
  EXPECT_EQ(straight_template(picture, kBox, Camera(kNone)).data, picture.data);
  const Pixel first = straight_place(kBox, Camera(kNone)) * Pixel{0, 0};
  EXPECT_EQ(first.u, kBox.u);
  EXPECT_EQ(first.v, kBox.v);
}

// Each pixel of the box is the plane's grey where a straight camera of that span has it: to the two
// roundings, and what a cubic leaves of stripes of 47 px: less than 2 of 255.
TEST(StraightTemplate, HasStraightLines) {
  const Camera camera = bent();
  const cv::Mat picture = seen_through(camera);
  const cv::Mat straight = straight_template(picture, kBox, camera);
  const auto corner = [&](double u, double v) { return camera.to_image_point({u, v}); };
  const ImagePoint a = corner(59.5, 39.5);
  const ImagePoint b = corner(259.5, 39.5);
  const ImagePoint c = corner(259.5, 199.5);
  const ImagePoint d = corner(59.5, 199.5);
  const Homography place = straight_place(kBox, camera);
  const Camera pinhole(kNone);
  double most_bent = 0;
  for (int row = 0; row < 160; row += 3) {
    for (int column = 0; column < 200; column += 3) {
      const double s = (column + 0.5) / 200;
      const double t = (row + 0.5) / 160;
      const ImagePoint m{(1 - s) * (a.x + d.x) / 2 + s * (b.x + c.x) / 2,
                         (1 - t) * (a.y + b.y) / 2 + t * (c.y + d.y) / 2};
      EXPECT_NEAR(straight.at<uchar>(40 + row, 60 + column), grey(m), 2);
      const ImagePoint there = pinhole.to_image_point(place * Pixel{double(column), double(row)});
      EXPECT_NEAR(there.x, m.x, 1e-12);
      EXPECT_NEAR(there.y, m.y, 1e-12);
      most_bent = std::max(most_bent, std::abs(picture.at<uchar>(40 + row, 60 + column) - grey(m)));
    }
  }
  EXPECT_GT(most_bent, 20) << "the lens bends so little that nothing was tested";
}

TEST(StraightTemplate, LeavesWhatIsAroundItAndABoxThatIsNotInside) {
  const Camera camera = bent();
  const cv::Mat picture = seen_through(camera);
  const cv::Mat straight = straight_template(picture, kBox, camera);
  EXPECT_EQ(straight.at<uchar>(39, 100), picture.at<uchar>(39, 100));
  EXPECT_EQ(straight.at<uchar>(100, 260), picture.at<uchar>(100, 260));
  EXPECT_EQ(straight_template(picture, {300, 40, 200, 160}, camera).data, picture.data);
}

}  // namespace
}  // namespace kestrel
