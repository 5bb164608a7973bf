#include "kestrel/io/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/markup_check.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const double kNan = std::numeric_limits<double>::quiet_NaN();

struct Vertex {
  char verb;
  double x;
  double y;
};

std::vector<Vertex> vertices(const std::string& svg) {
  std::vector<Vertex> out;
  const std::regex path("<path class=\"kl[^\"]*\" d=\"([^\"]*)\"");
  const std::regex vertex("([ML])(-?[0-9.]+) (-?[0-9.]+)");
  for (std::sregex_iterator p(svg.begin(), svg.end(), path), end; p != end; ++p) {
    const std::string d = (*p)[1];
    for (std::sregex_iterator v(d.begin(), d.end(), vertex); v != end; ++v)
      out.push_back({(*v)[1].str()[0], std::stod((*v)[2]), std::stod((*v)[3])});
  }
  return out;
}

// Where the labelled ticks of an axis are: value -> px.
std::map<double, double> tick_places(const std::string& svg, char axis) {
  std::map<double, double> out;
  const std::regex tick(std::string("class=\"kt k") + axis +
                        "\" x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*>([^<]*)<");
  for (std::sregex_iterator t(svg.begin(), svg.end(), tick), end; t != end; ++t)
    out[std::stod((*t)[3])] = axis == 'x' ? std::stod((*t)[1]) : std::stod((*t)[2]) - 4;
  return out;
}

Plot plot_of(const std::vector<double>& x, const std::vector<double>& y) {
  Plot plot;
  plot.title = "a < b & \"c\"";
  plot.x_label = "time (s)";
  plot.y_label = "error (px)";
  plot.series = {{"one <1>", x, y}};
  return plot;
}

double interpolated(const std::map<double, double>& places, double value) {
  const auto& [v0, p0] = *places.begin();
  const auto& [v1, p1] = *places.rbegin();
  return p0 + (p1 - p0) * (value - v0) / (v1 - v0);
}

TEST(SvgPlot, PutsValuesWhereTheTicksSay) {
  test::Random random("svg_plot");
  for (int i = 0; i < 10; ++i) {
    std::vector<double> x;
    std::vector<double> y;
    for (int k = 0; k < 20; ++k) {
      x.push_back(k * 0.7);
      y.push_back(random.uniform(-3, 8));
    }
    const std::string svg = svg_plot(plot_of(x, y));
    const auto at = vertices(svg);
    const auto x_places = tick_places(svg, 'x');
    const auto y_places = tick_places(svg, 'y');
    ASSERT_EQ(at.size(), x.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
      // 0.05 px of rounding in each of the three numbers compared.
      EXPECT_NEAR(at[k].x, interpolated(x_places, x[k]), 0.2);
      EXPECT_NEAR(at[k].y, interpolated(y_places, y[k]), 0.2);
    }
    EXPECT_LT(y_places.rbegin()->second, y_places.begin()->second);
  }
}

TEST(SvgPlot, EqualAxesHaveOneScale) {
  Plot plot = plot_of({0, 640, 640, 0}, {0, 0, 480, 480});
  for (const auto axes : {Plot::Axes::Equal, Plot::Axes::EqualDown}) {
    plot.axes = axes;
    const auto at = vertices(svg_plot(plot));
    ASSERT_EQ(at.size(), 4u);
    const double width = at[1].x - at[0].x;
    const double height = at[2].y - at[1].y;
    EXPECT_NEAR(std::abs(height) / width, 480. / 640, 0.002);
    EXPECT_EQ(height > 0, axes == Plot::Axes::EqualDown);
  }
}

TEST(SvgPlot, BreaksTheLineAtWhatIsNotFinite) {
  const std::string svg =
      svg_plot(plot_of({0, 1, 2, 3, 4, 5, 6}, {1, 2, kNan, 3, kNan, 1, 1 / 0.}));
  std::string verbs;
  for (const Vertex& vertex : vertices(svg)) verbs += vertex.verb;
  EXPECT_EQ(verbs, "MLMM");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(svg, HasSubstr("h0\""));  // a lone value is a dot
}

TEST(SvgPlot, LogarithmicLeavesOutWhatIsNotPositive) {
  Plot plot = plot_of({0, 1, 2, 3}, {1, 0, -1, 0.01});
  plot.y_spacing = Spacing::Logarithmic;
  std::string verbs;
  for (const Vertex& vertex : vertices(svg_plot(plot))) verbs += vertex.verb;
  EXPECT_EQ(verbs, "MM");
}

TEST(SvgPlot, ThinsButKeepsExtremes) {
  test::Random random("svg_plot.thin");
  std::vector<double> x;
  std::vector<double> y;
  for (int k = 0; k < 50000; ++k) {
    x.push_back(k);
    y.push_back(random.uniform(-1, 1));
  }
  y[12345] = 9;
  y[33333] = -7;
  const std::string svg = svg_plot(plot_of(x, y));
  const auto at = vertices(svg);
  EXPECT_LT(at.size(), 4 * 640u);
  const auto [top, bottom] = std::minmax_element(
      at.begin(), at.end(), [](const Vertex& a, const Vertex& b) { return a.y < b.y; });
  const auto places = tick_places(svg, 'y');
  EXPECT_NEAR(top->y, interpolated(places, 9), 0.2);
  EXPECT_NEAR(bottom->y, interpolated(places, -7), 0.2);
  EXPECT_LT(svg.size(), 60000u);
}

TEST(SvgPlot, DrawsLimitsThatAreNearAndNamesTheOthers) {
  Plot plot = plot_of({0, 1}, {-1, 1});
  plot.limits = {{1.5, "upper"}, {-500, "lower"}};
  const std::string svg = svg_plot(plot);
  EXPECT_THAT(svg, HasSubstr(">upper</text>"));
  EXPECT_THAT(svg, HasSubstr("not drawn: lower -500"));
  const std::regex line("class=\"km\"[^>]*y1=\"([0-9.]+)\"");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(svg, found, line));
  EXPECT_NEAR(std::stod(found[1]), interpolated(tick_places(svg, 'y'), 1.5), 0.2);
}

TEST(SvgPlot, SaysWhenThereIsNothing) {
  for (const Plot& plot : {Plot(), plot_of({}, {}), plot_of({1, 2}, {kNan, kNan})}) {
    EXPECT_THAT(svg_plot(plot), HasSubstr("no values to show"));
    EXPECT_EQ(test::markup_fault(svg_plot(plot)), "");
  }
  EXPECT_THAT(svg_plot(plot_of({1}, {2})), Not(HasSubstr("no values")));
}

TEST(SvgPlot, IsWellFormedForAnyNumbers) {
  test::Random random("svg_plot.any");
  const double odd[] = {kNan, 1 / 0., -1 / 0., 0., -0., 1e308, -1e308, 5e-324, 1e-12, 3.};
  for (int i = 0; i < 100; ++i) {
    Plot plot = plot_of({}, {});
    for (int k = 0; k < random.integer(0, 8); ++k) {
      plot.series[0].x.push_back(odd[random.integer(0, 9)]);
      plot.series[0].y.push_back(odd[random.integer(0, 9)]);
    }
    plot.series[0].y.push_back(1);  // one more y than x
    plot.limits = {{odd[random.integer(0, 9)], "limit"}};
    plot.marks = {{"mark", odd[random.integer(0, 9)], odd[random.integer(0, 9)]}};
    plot.y_spacing = i % 2 ? Spacing::Logarithmic : Spacing::Linear;
    plot.axes = i % 3 ? Plot::Axes::Free : Plot::Axes::Equal;
    const std::string svg = svg_plot(plot);
    EXPECT_EQ(test::markup_fault(svg), "");
    EXPECT_FALSE(std::regex_search(svg, std::regex("=\"-?(nan|inf)"))) << svg;
  }
}

TEST(SvgPlot, NamesBesideTheEndsDoNotCoverEachOther) {
  Plot plot = plot_of({}, {});
  plot.names = Plot::Names::LineEnds;
  plot.series.clear();
  for (int i = 0; i < 20; ++i)
    plot.series.push_back({"law" + std::to_string(i), {0, 1}, {1, 0.001 * i}});
  plot.series.push_back({"gone", {0, kNan}, {kNan, 1}});
  const std::string svg = svg_plot(plot);
  EXPECT_EQ(test::markup_fault(svg), "");
  EXPECT_THAT(svg, Not(HasSubstr(">gone<")));  // it has no end
  const std::regex name("class=\"kt ke\" x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*>law([0-9]+)<");
  std::map<double, int> rows;
  for (std::sregex_iterator n(svg.begin(), svg.end(), name), end; n != end; ++n) {
    rows[std::stod((*n)[2])] = std::stoi((*n)[3]);
    EXPECT_LT(std::stod((*n)[1]), plot.width_px - 40);
  }
  ASSERT_EQ(rows.size(), 20u);
  double last = 0;
  int place = 19;  // the largest value is the highest
  for (const auto& [y, law] : rows) {
    EXPECT_GE(y - last, 11.4);
    EXPECT_EQ(law, place--);
    last = y;
  }
}

TEST(SvgPlot, StrokesAreToldApart) {
  Plot plot = plot_of({0, 1}, {0, 1});
  plot.series[0].stroke = Stroke::Dotted;
  EXPECT_THAT(svg_plot(plot), HasSubstr("class=\"kl c0 kp\""));
  plot.series[0].stroke = Stroke::DashDot;
  EXPECT_THAT(svg_plot(plot), HasSubstr("class=\"kl c0 kq\""));
}

TEST(SvgPlot, IsTheSameEachTime) {
  const Plot plot = plot_of({0, 1, 2}, {0.1, 0.2, 0.3});
  EXPECT_EQ(svg_plot(plot), svg_plot(plot));
}

}  // namespace
}  // namespace kestrel
