#include "reports/line_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace rastercheck::reports::line_plot_test {
namespace {

using testing::HasSubstr;
using testing::Not;

LinePlot plot_of(const std::vector<PlotPoint>& points, bool is_logarithmic = false) {
  LinePlot plot;
  plot.title = "a <plot>";
  plot.x = {"x", 0, 4, false, {{2, "two"}}};
  plot.y = {"y", 0, 1, false, {}};
  if (is_logarithmic) plot.y = {"y", 0.25, 4, true, {}};
  plot.curves = {{"a & b", "3 2", 1, points}};
  return plot;
}

// The plot's area is 44…424 by 12…262. Kills: y pointing downwards; an axis that starts elsewhere.
TEST(LinePlotSvg, PutsPointsOnItsAxes) {
  const std::string svg = line_plot_svg(plot_of({{0, 0}, {2, 0.5}, {4, 1}}));
  EXPECT_THAT(svg, HasSubstr("points=\"44.00,262.00 234.00,137.00 424.00,12.00\""));
  EXPECT_THAT(svg, HasSubstr("x=\"234.0\" y=\"276\" text-anchor=\"middle\">two</text>"));
}

TEST(LinePlotSvg, HasPowersOfTwoAtEqualDistances) {
  const std::string svg = line_plot_svg(plot_of({{0, 0.25}, {1, 0.5}, {2, 1}, {3, 4}}, true));
  EXPECT_THAT(svg, HasSubstr("points=\"44.00,262.00 139.00,199.50 234.00,137.00 329.00,12.00\""));
}

// Kills: taking the logarithm of 0.
TEST(LinePlotSvg, DrawsWhatLiesBeyondAtTheEnd) {
  const std::string svg = line_plot_svg(plot_of({{-1, 0}, {9, 100}}, true));
  EXPECT_THAT(svg, HasSubstr("points=\"44.00,262.00 424.00,12.00\""));
}

TEST(LinePlotSvg, NamesCurvesThatHaveNoPoints) {
  const std::string svg = line_plot_svg(plot_of({}));
  EXPECT_THAT(svg, Not(HasSubstr("<polyline")));
  EXPECT_THAT(svg, HasSubstr(">a &amp; b</text>"));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"a &lt;plot&gt;\""));
}

}  // namespace
}  // namespace rastercheck::reports::line_plot_test
