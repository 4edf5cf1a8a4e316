// Makes cases from the drawings in logs of dEQP (cases/deqp_log.h).

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cases/deqp_log.h"

namespace rastercheck::cases {
namespace {

/// Returns the layout of a drawing's picture. Its first row has window y = 0, which is at the
/// bottom in OpenGL. Alpha is not judged, because default framebuffers need not have it.
PictureLayout layout_of_drawing(const DeqpDrawing& drawing, bool is_vulkan) {
  const bool has_colors = drawing.vertices.front().color.has_value();
  PictureLayout layout;
  for (const char* name : {"R", "G", "B"}) {
    const std::string attribute(1, static_cast<char>(*name - 'A' + 'a'));
    layout.channels.push_back({name, has_colors ? attribute : "coverage", 0.0F});
  }
  if (drawing.image.channels == 4) layout.channels.push_back({"A", "-", std::nullopt});
  layout.storage = Storage::unorm8;
  // OpenGL ES 3.0, §2.1.6.2, prefers the nearest integer, but permits either of the two closest.
  layout.rounding = StoreRounding::either;
  layout.first_row = is_vulkan ? FirstRow::top : FirstRow::bottom;
  return layout;
}

}  // namespace

Case case_of(const DeqpTest& test, const DeqpDrawing& drawing) {
  Case c;
  c.name = test.path + (drawing.section.empty() ? "" : ", " + drawing.section);
  c.framebuffer = {drawing.image.width, drawing.image.height, 1};
  c.viewport.width = static_cast<float>(drawing.image.width);
  c.viewport.height = static_cast<float>(drawing.image.height);
  c.rules = test.is_vulkan() ? Rules::vulkan : Rules::opengl;
  c.fill_rule = default_fill_rule(c.rules);
  c.basis = default_basis(c.rules);
  const bool is_flat = test.path.find("flatshading") != std::string::npos;
  const bool has_colors = drawing.vertices.front().color.has_value();
  for (const char* name : {"r", "g", "b"}) {
    if (!has_colors) break;
    c.attributes.push_back({name, is_flat ? Interpolation::flat : Interpolation::smooth});
  }
  for (const DeqpVertex& vertex : drawing.vertices) {
    const auto& [x, y, z, w] = vertex.position;
    c.positions.push_back({x.value, y.value, z.value, w.value});
    for (std::size_t i = 0; i < c.attributes.size(); ++i) {
      c.attribute_values.push_back((*vertex.color)[i].value);
    }
  }
  c.triangles =
      triangles_of(drawing.topology, static_cast<std::uint32_t>(drawing.vertices.size()), c.rules);
  c.picture = layout_of_drawing(drawing, test.is_vulkan());
  return c;
}

// If w is off by at most e and x by at most d, x/w is off by at most (d + |x/w| e) / (|w| - e). A
// smooth value is a mean of the vertices' values with weights b/w, where b depends only on window
// positions. If every w has a relative error of at most s, weights and their sums change by factors
// of at most 1/(1 - s), so the mean changes by less than 2 s/(1 - s) of the values' range.
std::optional<DeqpUncertainty> uncertainty_of(const DeqpDrawing& drawing) {
  DeqpUncertainty all;
  const std::array<double, 2> half_sizes{drawing.image.width / 2.0, drawing.image.height / 2.0};
  for (const DeqpVertex& vertex : drawing.vertices) {
    const DeqpNumber& w = vertex.position[3];
    const double magnitude = std::fabs(double{w.value});
    const bool is_exact = w.uncertainty == 0 && vertex.position[0].uncertainty == 0 &&
                          vertex.position[1].uncertainty == 0;
    if (is_exact) continue;
    if (magnitude <= 2 * w.uncertainty) return std::nullopt;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const DeqpNumber& x = vertex.position[axis];
      const double quotient = std::fabs(double{x.value}) / magnitude;
      const double off = (x.uncertainty + quotient * w.uncertainty) / (magnitude - w.uncertainty);
      all.pixels = std::max(all.pixels, off * half_sizes[axis]);
    }
    const double share = w.uncertainty / magnitude;
    all.weights = std::max(all.weights, 2 * share / (1 - share));
  }
  return all;
}

}  // namespace rastercheck::cases
