#include "kestrel/io/svg_space.hpp"

#include <limits>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "io/svg_vertices.hpp"
#include "support/markup_check.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The camera's axes as the camera sees them: x right, y down.
SpaceView from_behind() { return {{0, -1, 0}, {0, 0, -1}}; }

SpacePlot plot_of(const std::vector<Eigen::Vector3d>& points_m) {
  SpacePlot plot;
  plot.title = "a < b";
  plot.view = from_behind();
  plot.lines = {{"cur & <1>", points_m, 0}};
  return plot;
}

TEST(Projected, FromBehindACameraItIsItsImage) {
  const Eigen::Vector2d at = projected(from_behind(), {1, 2, 30});
  EXPECT_NEAR(at.x(), 1, 1e-12);
  EXPECT_NEAR(at.y(), -2, 1e-12);
}

TEST(Projected, UpIsUpAndLengthsAcrossTheViewAreKept) {
  test::Random random("svg_space");
  for (int i = 0; i < 20; ++i) {
    const auto draw = [&] {
      return Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    const SpaceView view{{0, -1, 0}, draw()};
    EXPECT_GT(projected(view, view.up).y(), 0);
    EXPECT_NEAR(projected(view, view.up).x(), 0, 1e-12);
    EXPECT_NEAR(projected(view, view.towards_eye).norm(), 0, 1e-12);
    const Eigen::Vector3d across = view.towards_eye.cross(draw());
    EXPECT_NEAR(projected(view, across).norm(), across.norm(), 1e-12);
  }
}

TEST(SvgSpace, HasOneScaleAndABarThatTellsIt) {
  const std::string svg = svg_space(plot_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}}));
  const auto at = test::first_line(svg);
  ASSERT_EQ(at.size(), 3u);
  const double two_m = (at[1] - at[0]).norm();
  EXPECT_NEAR((at[2] - at[1]).norm() / two_m, 0.5, 0.002);
  EXPECT_GT(at[2].y(), at[1].y());  // y of a camera is down
  std::smatch bar;
  ASSERT_TRUE(std::regex_search(svg, bar, std::regex("v8m0 -4h([0-9.]+)")));
  std::smatch words;
  ASSERT_TRUE(std::regex_search(svg, words, std::regex(">([0-9.]+) m<")));
  EXPECT_NEAR(std::stod(bar[1]) / std::stod(words[1]), two_m / 2, 0.5);
}

// Two frames in one place: no two of their eight words stand on one another.
TEST(SvgSpace, WordsOfFramesInOnePlaceStandApart) {
  SpacePlot plot;
  plot.view = {{0, -1, 0}, {-1, -0.7, -1.4}};
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).matrix();
  plot.frames = {{"start", {0, 0, 0}, turned}, {"goal", {0, 0, 0}, Eigen::Matrix3d::Identity()}};
  plot.lines = {{"path", {{-1, -1, 0}, {1, 1, 1}}, 0}};
  const std::string svg = svg_space(plot);
  const std::regex text("x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" text-anchor=\"middle\">([a-z]+)<");
  struct Word {
    double x, y, width;
  };
  std::vector<Word> words;
  for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end; ++at) {
    // 6 px: no letter of the page's font is narrower than it looks here.
    words.push_back({std::stod((*at)[1]), std::stod((*at)[2]), 6.0 * double((*at)[3].length())});
  }
  ASSERT_EQ(words.size(), 8u);
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool apart =
          std::abs(words[i].x - words[k].x) >= (words[i].width + words[k].width) / 2 ||
          std::abs(words[i].y - words[k].y) >= 11;
      EXPECT_TRUE(apart) << i << " on " << k;
    }
  }
}

TEST(SvgSpace, ACutLineDoesNotWidenThePicture) {
  SpacePlot plot = plot_of({{0, 0, 0}, {1, 1, 0}});
  const auto before = test::first_line(svg_space(plot));
  plot.lines.push_back({"", {{0, 0, 0}, {50, 0, 0}}, 1, Stroke::Solid, SpaceLine::Fit::Cut});
  EXPECT_EQ(test::first_line(svg_space(plot)), before);
  plot.lines.back().fit = SpaceLine::Fit::Whole;
  EXPECT_NE(test::first_line(svg_space(plot)), before);
}

TEST(SvgSpace, DrawsTheAxesOfAFrame) {
  SpacePlot plot = plot_of({{0, 0, 0}, {1, 1, 0}});
  plot.frames = {{"goal <*>", {0.5, 0.5, 0}, Eigen::Matrix3d::Identity()}};
  const std::string svg = svg_space(plot);
  EXPECT_THAT(svg, HasSubstr(">goal &lt;*&gt;<"));
  EXPECT_THAT(svg, HasSubstr(">x<"));
  EXPECT_THAT(svg, HasSubstr(">y<"));
  EXPECT_THAT(svg, Not(HasSubstr(">z<")));  // it points away from the eye
}

TEST(SvgSpace, NothingAndNonsenseAreWellFormed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(svg_space({}), HasSubstr("no values to show"));
  for (const SpacePlot& plot :
       {SpacePlot(), plot_of({}), plot_of({{nan, 0, 0}}), plot_of({{0, 0, 0}}),
        plot_of({{1e300, 0, 0}, {-1e300, 0, 0}, {1 / 0., nan, 0}})}) {
    const std::string svg = svg_space(plot);
    EXPECT_EQ(test::markup_fault(svg), "");
    EXPECT_FALSE(std::regex_search(svg, std::regex("[\" ]-?(nan|inf)"))) << svg;
  }
}

}  // namespace
}  // namespace kestrel
