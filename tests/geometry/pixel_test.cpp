#include "kestrel/geometry/pixel.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

void expect_box(const PixelBox& box, const PixelBox& wanted) {
  EXPECT_EQ(box.u, wanted.u);
  EXPECT_EQ(box.v, wanted.v);
  EXPECT_EQ(box.width, wanted.width);
  EXPECT_EQ(box.height, wanted.height);
}

TEST(Pixel, DistanceIsEuclidean) {
  EXPECT_EQ(distance({1, 2}, {4, 6}), 5);
  EXPECT_EQ(distance({4, 6}, {1, 2}), 5);
  EXPECT_TRUE(std::isnan(distance({kNan, 0}, {0, 0})));
}

// (0, 0) is the centre of the first pixel: two pixels have their centre between them, at 0.5.
TEST(Pixel, CentreOfABoxIsTheMeanOfItsPixels) {
  EXPECT_EQ(centre({0, 0, 2, 1}).u, 0.5);
  EXPECT_EQ(centre({0, 0, 2, 1}).v, 0);
  EXPECT_EQ(centre({10, 20, 5, 7}).u, 12);
  EXPECT_EQ(centre({10, 20, 5, 7}).v, 23);
}

TEST(Pixel, ClippedHoldsExactlyThePixelsTheBoxTouchesInTheImage) {
  test::Random random("clipped");
  for (int i = 0; i < 500; ++i) {
    const PixelBox box{random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-2, 40),
                       random.uniform(-2, 40)};
    const PixelBox part = clipped(box, 20, 16);
    const bool some = box.width > 0 && box.height > 0;
    for (int u = -2; u < 23; ++u) {
      const bool touched = u < box.u + box.width && u + 1 > box.u && some;
      const bool held = u >= part.u && u < part.u + part.width;
      EXPECT_EQ(held, touched && u >= 0 && u < 20) << box.u << ' ' << box.width << ' ' << u;
    }
    for (int v = -2; v < 19; ++v) {
      const bool touched = v < box.v + box.height && v + 1 > box.v && some;
      const bool held = v >= part.v && v < part.v + part.height;
      EXPECT_EQ(held, touched && v >= 0 && v < 16) << box.v << ' ' << box.height << ' ' << v;
    }
  }
}

TEST(Pixel, ClippedTwiceIsClippedOnce) {
  const PixelBox part = clipped({-3.5, 2.2, 10, 100}, 20, 16);
  expect_box(part, {0, 2, 7, 14});
  expect_box(clipped(part, 20, 16), part);
}

TEST(Pixel, ABoxNobodyCanPlaceHoldsNothing) {
  for (const double bad : {kNan, kInf, -kInf}) {
    expect_box(clipped({bad, 1, 5, 5}, 20, 16), {});
    expect_box(clipped({1, bad, 5, 5}, 20, 16), {});
    expect_box(clipped({1, 1, bad, 5}, 20, 16), {});
    expect_box(clipped({1, 1, 5, bad}, 20, 16), {});
  }
  expect_box(clipped({1, 1, 5, 5}, -1, -1), {0, 0, 0, 0});
}

TEST(Pixel, BoundingBoxTouchesItsOutermostPoints) {
  const PixelBox box = bounding_box({{3, 7}, {-1, 9}, {2, 8}});
  expect_box(box, {-1, 7, 5, 3});
  expect_box(bounding_box({{4, 5}}), {4, 5, 1, 1});
  expect_box(bounding_box({}), {});
}

TEST(Pixel, BoundingBoxOfAPointAtInfinityIsEmpty) {
  for (const double bad : {kNan, kInf}) {
    expect_box(bounding_box({{bad, 1}, {2, 3}}), {});
    expect_box(bounding_box({{2, 3}, {1, bad}}), {});
  }
}

}  // namespace
}  // namespace kestrel
