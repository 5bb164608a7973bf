#include "kestrel/vision/window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kWidth = 640;
constexpr int kHeight = 480;

void expect_inside(const PixelBox& box) {
  EXPECT_GE(box.u, 0);
  EXPECT_GE(box.v, 0);
  EXPECT_LE(box.u + box.width, kWidth + 1e-9);
  EXPECT_LE(box.v + box.height, kHeight + 1e-9);
  EXPECT_GT(box.width, 0);
  EXPECT_GT(box.height, 0);
}

void expect_whole(const PixelBox& box) {
  EXPECT_EQ(box.u, 0);
  EXPECT_EQ(box.v, 0);
  EXPECT_EQ(box.width, kWidth);
  EXPECT_EQ(box.height, kHeight);
}

std::array<Pixel, 4> square(double u, double v, double side) {
  return {{{u, v}, {u + side, v}, {u + side, v + side}, {u, v + side}}};
}

TEST(Window, FirstIsTwiceTheTemplateAboutItsCentre) {
  const PixelBox box{300, 200, 80, 60};
  const PixelBox window = first_window(box, kWidth, kHeight);
  EXPECT_EQ(window.width, 160);
  EXPECT_EQ(window.height, 120);
  EXPECT_EQ(centre(window).u, centre(box).u);
  EXPECT_EQ(centre(window).v, centre(box).v);
}

TEST(Window, AroundAnOutlineIsTwiceItsBoundingBox) {
  const std::array<Pixel, 4> outline{{{300, 210}, {390, 200}, {399, 279}, {305, 270}}};
  const PixelBox window = window_around(outline, kWidth, kHeight);
  EXPECT_EQ(window.width, 200);   // columns 300 to 399
  EXPECT_EQ(window.height, 160);  // rows 200 to 279
  EXPECT_EQ(centre(window).u, 349.5);
  EXPECT_EQ(centre(window).v, 239.5);
}

TEST(Window, FollowsTheOutline) {
  const PixelBox here = window_around(square(200, 150, 99), kWidth, kHeight);
  const PixelBox there = window_around(square(217, 141, 99), kWidth, kHeight);
  EXPECT_EQ(there.u - here.u, 17);
  EXPECT_EQ(there.v - here.v, -9);
  EXPECT_EQ(there.width, here.width);
}

TEST(Window, StaysInTheImageAndKeepsItsSizeAtTheEdge) {
  test::Random random("edge");
  for (int i = 0; i < 200; ++i) {
    const double side = random.uniform(1, 400);
    const auto outline = square(random.uniform(-500, 900), random.uniform(-500, 900), side);
    const PixelBox window = window_around(outline, kWidth, kHeight);
    expect_inside(window);
    EXPECT_NEAR(window.width, std::min(std::max(2 * (side + 1), 64.0), double(kWidth)), 1e-9);
    EXPECT_NEAR(window.height, std::min(std::max(2 * (side + 1), 64.0), double(kHeight)), 1e-9);
  }
}

TEST(Window, IsNeverTooSmallToHoldKeypoints) {
  EXPECT_EQ(window_around(square(100, 100, 0), kWidth, kHeight).width, 64);
  EXPECT_EQ(first_window({100, 100, 16, 20}, kWidth, kHeight).height, 64);
  const PixelBox in_tiny_image = window_around(square(10, 10, 3), 40, 30);
  EXPECT_EQ(in_tiny_image.width, 40);
  EXPECT_EQ(in_tiny_image.height, 30);
}

TEST(Window, DoublesItsAreaAboutItsCentre) {
  const PixelBox window{250, 200, 100, 60};
  const PixelBox doubled = doubled_window(window, kWidth, kHeight);
  EXPECT_NEAR(doubled.width * doubled.height, 2 * 100 * 60, 1e-6);
  EXPECT_NEAR(doubled.width / doubled.height, 100.0 / 60, 1e-9);
  EXPECT_NEAR(centre(doubled).u, centre(window).u, 1e-9);
  EXPECT_NEAR(centre(doubled).v, centre(window).v, 1e-9);
}

TEST(Window, DoublesUntilItIsTheWholeImage) {
  test::Random random("doubling");
  for (int i = 0; i < 100; ++i) {
    PixelBox window{random.uniform(0, 400), random.uniform(0, 300), random.uniform(8, 240),
                    random.uniform(8, 180)};
    for (int k = 0; k < 14; ++k) {  // 640 x 480 over 8 x 8 is less than 2^13
      const double area = window.width * window.height;
      window = doubled_window(window, kWidth, kHeight);
      expect_inside(window);
      EXPECT_NEAR(window.width * window.height, std::min(2 * area, double(kWidth) * kHeight), 1e-6);
    }
    expect_whole(window);
  }
}

TEST(Window, IsTheWholeImageWhenNothingIsKnown) {
  expect_whole(doubled_window({0, 0, kNaN, 10}, kWidth, kHeight));
  expect_whole(doubled_window({kInfinity, 0, 10, 10}, kWidth, kHeight));
  expect_whole(doubled_window({5, 5, 0, 10}, kWidth, kHeight));
  expect_whole(doubled_window({0, 0, 1e6, 1e6}, kWidth, kHeight));
  expect_whole(first_window({}, kWidth, kHeight));
  expect_whole(first_window({0, kNaN, 20, 20}, kWidth, kHeight));
  for (std::size_t corner = 0; corner < 4; ++corner) {
    auto outline = square(100, 100, 50);
    outline[corner].v = kNaN;
    expect_whole(window_around(outline, kWidth, kHeight));
    outline[corner].v = -kInfinity;
    expect_whole(window_around(outline, kWidth, kHeight));
  }
  expect_whole(window_around(square(-1e12, -1e12, 2e12), kWidth, kHeight));
}

}  // namespace
}  // namespace kestrel
