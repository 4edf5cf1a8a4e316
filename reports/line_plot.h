#pragma once

// Curves over a common axis, as a drawing for a page.

#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::reports {

struct PlotPoint {
  double x = 0;
  double y = 0;
};

struct Curve {
  std::string name;
  /// Lengths of strokes and gaps as SVG's stroke-dasharray takes them; empty for a solid line.
  std::string_view dashes;
  /// Of the page's colours --curve-0, --curve-1, …
  int color = 0;
  std::vector<PlotPoint> points;  ///< by x; empty for a curve that the legend alone names
};

struct Tick {
  double at = 0;
  std::string label;
};

struct PlotAxis {
  std::string label;
  double low = 0;
  double high = 1;
  /// Powers of two at equal distances; `low` is then what is drawn of anything less.
  bool is_logarithmic = false;
  std::vector<Tick> ticks;
};

struct LinePlot {
  std::string title;  ///< what readers hear who do not see it
  PlotAxis x;
  PlotAxis y;
  std::vector<Curve> curves;
};

/// The plot as an SVG element, with its legend below. Lines and letters have the page's colours
/// (--ink, --muted, --line, --curve-…). Points beyond an axis are drawn at its end.
std::string line_plot_svg(const LinePlot& plot);

}  // namespace rastercheck::reports
