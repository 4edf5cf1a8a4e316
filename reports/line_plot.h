#pragma once

// Plots curves over a common axis, for a page.

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
  /// Lengths of dashes and gaps, in the syntax of SVG's stroke-dasharray; empty for a solid line.
  std::string_view dashes;
  /// Index of one of the page's colours: --curve-0, --curve-1, …
  int color = 0;
  std::vector<PlotPoint> points;  ///< by x; empty for a curve that appears only in the legend
};

struct Tick {
  double at = 0;
  std::string label;
};

struct PlotAxis {
  std::string label;
  double low = 0;
  double high = 1;
  /// If true, powers of two are at equal distances, and anything less than `low` is drawn at `low`.
  bool is_logarithmic = false;
  std::vector<Tick> ticks;
};

struct LinePlot {
  std::string title;  ///< read aloud by screen readers
  PlotAxis x;
  PlotAxis y;
  std::vector<Curve> curves;
};

/// Returns the plot as an SVG element with its legend below. Lines and letters use the page's
/// colours (--ink, --muted, --line, --curve-…). Points beyond the end of an axis are drawn at that
/// end.
std::string line_plot_svg(const LinePlot& plot);

}  // namespace rastercheck::reports
