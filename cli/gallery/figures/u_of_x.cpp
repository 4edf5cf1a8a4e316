// Figure 4 of Heckbert & Moreton 1991: a texture coordinate along a row, exact and as approximated
// by methods.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/gallery/figure.h"
#include "cli/gallery/internal/drawn.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::gallery::u_of_x_figure {
namespace {

/// Three rows; the samples of the middle one lie on the triangle's axis.
constexpr int kRows = 3;
constexpr int kRow = 1;
/// Ratio of the right end's distance from the eye to the left end's.
constexpr float kRatio = 8;

/// A triangle with an upright left edge, where u = 0 and w = 1, and a vertex on the right, where u
/// = 1 and w = kRatio. So u runs from 0 to 1 along the axis of a single triangle.
cases::Case wedge(const Canvas& canvas) {
  cases::Case scene = empty_scene(canvas, std::array<std::string, 1>{"u"});
  scene.name = "a wedge";
  scene.framebuffer = {canvas.size, kRows, 1};
  scene.viewport.height = kRows;
  constexpr float kEnd = 0.9375F;
  scene.positions = {{-kEnd, kEnd, 0.5, 1}, {-kEnd, -kEnd, 0.5, 1}, {kEnd * kRatio, 0, 4, kRatio}};
  scene.attribute_values = {0, 0, 1};
  scene.triangles = {{0, 1, 2}};
  return scene;
}

struct Series {
  std::string_view method;
  std::string_view name;
  std::string_view dashes;
};

/// Dash patterns of the curves. In the paper the first curve is solid, the second dashed, the third
/// dotted.
constexpr std::array<Series, 4> kSeries{{{"method:screen-linear", "linear, one polygon", "9 4"},
                                         {"method:subdivide-2", "linear, two polygons", "2 3"},
                                         {"method:polynomial-quadratic", "quadratic", "11 3 2 3"},
                                         {"method:polynomial-cubic", "cubic", "5 2"}}};

/// Returns the places of the row's samples, and the exact u there.
std::vector<reports::PlotPoint> exact_points(const cases::Case& scene) {
  const oracle::SceneTruth truth(scene, cases::contract_of(scene));
  const oracle::TriangleTruth triangle(truth, 0);
  std::vector<reports::PlotPoint> points;
  for (int x = 0; x < scene.framebuffer.width; ++x) {
    if (triangle.judge(x, kRow, 0).verdict != records::Verdict::required) continue;
    if (const auto u = triangle.attribute(0, x, kRow, 0)) {
      points.push_back({x + 0.5, u->lo.enclosure().lo});
    }
  }
  return points;
}

std::vector<reports::PlotPoint> drawn_points(const DrawnScene& drawn) {
  std::vector<reports::PlotPoint> points;
  for (std::size_t i = 0; i < drawn.fragments.size(); ++i) {
    if (drawn.fragments.y[i] != kRow) continue;
    points.push_back({drawn.fragments.x[i] + 0.5, double{drawn.fragments.attributes_of(i)[0]}});
  }
  return points;
}

/// Returns the error of each point, in texels, where both lists have a point.
std::vector<reports::PlotPoint> errors_of(const std::vector<reports::PlotPoint>& points,
                                          const std::vector<reports::PlotPoint>& exact) {
  std::vector<reports::PlotPoint> errors;
  for (const reports::PlotPoint& point : points) {
    const auto at = std::find_if(exact.begin(), exact.end(),
                                 [&point](const auto& other) { return other.x == point.x; });
    if (at != exact.end()) errors.push_back({point.x, std::abs(point.y - at->y) * kTexels});
  }
  return errors;
}

double largest(const std::vector<reports::PlotPoint>& points) {
  double most = 0;
  for (const reports::PlotPoint& point : points) most = std::max(most, point.y);
  return most;
}

reports::LinePlot empty_plot(const Canvas& canvas, std::string title) {
  reports::LinePlot plot;
  plot.title = std::move(title);
  plot.x.label = "window x, pixels";
  plot.x.high = canvas.size;
  for (int i = 0; i <= 4; ++i) {
    const int at = canvas.size * i / 4;
    plot.x.ticks.push_back({static_cast<double>(at), std::to_string(at)});
  }
  return plot;
}

reports::LinePlot value_plot(const Canvas& canvas) {
  reports::LinePlot plot = empty_plot(canvas, "u along the row, exact and by method");
  plot.y.label = "u";
  plot.y.low = -0.125;  // a parabola falls below 0
  for (const std::string_view label : {"0", "0.25", "0.5", "0.75", "1"}) {
    plot.y.ticks.push_back({std::stod(std::string(label)), std::string(label)});
  }
  return plot;
}

reports::LinePlot error_plot(const Canvas& canvas) {
  reports::LinePlot plot = empty_plot(canvas, "Error of u along the row, by method");
  const reports::ErrorScale& scale = reports::texel_scale();
  plot.y.label = fmt::format("error of u, {} of {}", scale.unit, kTexels);
  plot.y.is_logarithmic = true;
  plot.y.low = std::ldexp(1.0, scale.least_exponent);
  plot.y.high = std::ldexp(1.0, scale.greatest_exponent);
  double at = plot.y.low;
  for (const std::string_view label : scale.labels) {
    plot.y.ticks.push_back({at, std::string(label)});
    at *= 4;  // every second octave
  }
  return plot;
}

Result<reports::GalleryFigure> draw(const Canvas& canvas) {
  reports::GalleryFigure figure;
  figure.title = "Approximations of u along a row";
  figure.source =
      "P. S. Heckbert and H. P. Moreton, Interpolation for Polygon Texture Mapping "
      "and Shading, 1991, figure 4; quadratic and cubic: §2.1.";
  figure.sentences = {
      "A texture coordinate that is linear on an object is rational linear along a row of the "
      "picture. Here the right end is eight times as far away as the left one, so u stays small "
      "for a long way and rises steeply at the end.",
      "One straight line misses that by half the texture. Two polygons, a parabola or a cubic come "
      "closer, but each is exact only at the points that it goes through."};
  const cases::Case scene = wedge(canvas);
  const std::vector<reports::PlotPoint> exact = exact_points(scene);
  reports::LinePlot values = value_plot(canvas);
  reports::LinePlot errors = error_plot(canvas);
  values.curves.push_back({"exact (oracle)", "", 0, exact});
  int color = 1;
  for (const Series& series : kSeries) {
    const Result<DrawnScene> drawn = draw_by(series.method, scene);
    if (!drawn) return tl::unexpected(drawn.error());
    const std::vector<reports::PlotPoint> points = drawn_points(*drawn);
    const std::vector<reports::PlotPoint> off = errors_of(points, exact);
    const std::string name = fmt::format("{} ({})", series.name, series.method);
    const bool is_there = drawn->missing.empty();
    values.curves.push_back({is_there ? name : drawn->missing, series.dashes, color, points});
    errors.curves.push_back({is_there ? fmt::format("{}, worst {} texels", series.name,
                                                    reports::gallery_error_text(largest(off)))
                                      : drawn->missing,
                             series.dashes, color, off});
    ++color;
  }
  figure.plots.push_back({std::move(values), "u at the samples of one row, as drawn."});
  figure.plots.push_back({std::move(errors), "The absolute errors of these values."});
  return figure;
}

const FigureRegistration kRegistration({"002-4", &draw});

}  // namespace
}  // namespace rastercheck::gallery::u_of_x_figure
