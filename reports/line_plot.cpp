#include "reports/line_plot.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/internal/html.h"
#include "reports/internal/log2.h"

namespace rastercheck::reports {
namespace {

// The layout of the drawing, in units of its view box.
constexpr double kWidth = 440;
constexpr double kLeft = 44;
constexpr double kRight = 424;
constexpr double kTop = 12;
constexpr double kBottom = 262;
constexpr double kLegendTop = 312;
constexpr double kLegendStep = 17;

double share(const PlotAxis& axis, double value) {
  const double held = std::clamp(value, axis.low, axis.high);
  if (!axis.is_logarithmic) return (held - axis.low) / (axis.high - axis.low);
  const double low = curve_log2(axis.low);
  return (curve_log2(held) - low) / (curve_log2(axis.high) - low);
}

double column(const LinePlot& plot, double x) {
  return kLeft + (kRight - kLeft) * share(plot.x, x);
}
double row(const LinePlot& plot, double y) { return kBottom - (kBottom - kTop) * share(plot.y, y); }

std::string axes(const LinePlot& plot) {
  std::string svg =
      fmt::format("<rect class=\"plot\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", kLeft,
                  kTop, kRight - kLeft, kBottom - kTop);
  for (const Tick& tick : plot.x.ticks) {
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\"/>\n"
        "<text class=\"axis\" x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
        column(plot, tick.at), kTop, kBottom, kBottom + 14, html(tick.label));
  }
  for (const Tick& tick : plot.y.ticks) {
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{1}\" y1=\"{0:.1f}\" x2=\"{2}\" y2=\"{0:.1f}\"/>\n"
        "<text class=\"axis\" x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
        row(plot, tick.at), kLeft, kRight, kLeft - 5, row(plot, tick.at) + 3.5, html(tick.label));
  }
  const double middle = (kTop + kBottom) / 2;
  return svg + fmt::format(
                   "<text class=\"axis\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n"
                   "<text class=\"axis\" transform=\"translate(10 {}) rotate(-90)\" "
                   "text-anchor=\"middle\">{}</text>\n",
                   (kLeft + kRight) / 2, kBottom + 30, html(plot.x.label), middle,
                   html(plot.y.label));
}

std::string stroke(const Curve& curve) {
  return fmt::format("style=\"stroke:var(--curve-{})\" stroke-dasharray=\"{}\"", curve.color,
                     curve.dashes.empty() ? "none" : curve.dashes);
}

std::string line(const LinePlot& plot, const Curve& curve) {
  if (curve.points.empty()) return "";
  std::string points;
  for (const PlotPoint& point : curve.points) {
    points += fmt::format("{}{:.2f},{:.2f}", points.empty() ? "" : " ", column(plot, point.x),
                          row(plot, point.y));
  }
  return fmt::format("<polyline class=\"curve\" {} points=\"{}\"/>\n", stroke(curve), points);
}

std::string legend_line(const Curve& curve, double y) {
  return fmt::format(
      "<line class=\"curve\" {} x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n"
      "<text class=\"key\" x=\"{}\" y=\"{}\">{}</text>\n",
      stroke(curve), kLeft, y, kLeft + 42, y, kLeft + 50, y + 4, html(curve.name));
}

}  // namespace

std::string line_plot_svg(const LinePlot& plot) {
  const double height = kLegendTop + kLegendStep * static_cast<double>(plot.curves.size());
  std::string svg =
      fmt::format("<svg class=\"curves\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n",
                  kWidth, height, html(plot.title));
  svg += axes(plot);
  for (const Curve& curve : plot.curves) svg += line(plot, curve);
  double y = kLegendTop;
  for (const Curve& curve : plot.curves) {
    svg += legend_line(curve, y);
    y += kLegendStep;
  }
  return svg + "</svg>\n";
}

}  // namespace rastercheck::reports
