#include "oracle/internal/stage_forms.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::oracle {
namespace {

template <typename... Numbers>
bool are_finite(Numbers... numbers) {
  return (std::isfinite(numbers) && ...);
}

bool is_finite(const records::TracedCorner& c) {
  return are_finite(c.x, c.y, c.z, c.w, c.share[0], c.share[1], c.share[2]);
}

/// The term a · scale (2 at − shift), split into the factor of `at` and the constant.
struct AxisTerm {
  Ring slope;
  Ring constant;
};
std::optional<AxisTerm> axis_term(double coefficient, const records::TracedAxis& axis) {
  if (!are_finite(coefficient, axis.scale, axis.shift)) return std::nullopt;
  const Ring scaled = Ring(coefficient) * Ring(axis.scale);
  return AxisTerm{scaled * Ring(2), -scaled * Ring(axis.shift)};
}

/// a U + b V + c.
std::optional<Line> functional(double a, double b, double c, double c_factor,
                               const records::TracedFrame& frame) {
  const std::optional<AxisTerm> u = axis_term(a, frame.u);
  const std::optional<AxisTerm> v = axis_term(b, frame.v);
  if (!u || !v || !are_finite(c, c_factor)) return std::nullopt;
  return Line{u->slope, v->slope, u->constant + v->constant + Ring(c) * Ring(c_factor)};
}

std::optional<Line> window_plane(const records::TracedPlane& plane,
                                 const records::TracedFrame& frame) {
  return functional(plane.a, plane.b, plane.c, 1, frame);
}

}  // namespace

cases::Case triangle_alone(const cases::Case& c, std::uint32_t triangle) {
  cases::Case alone;
  alone.framebuffer = c.framebuffer;
  alone.viewport = c.viewport;
  alone.rules = c.rules;
  alone.coverage = c.coverage;
  alone.basis = c.basis;
  alone.fill_rule = c.fill_rule;
  alone.cull = c.cull;
  alone.front_face = c.front_face;
  alone.scissor = c.scissor;
  alone.depth_clamp = c.depth_clamp;
  alone.depth_bias = c.depth_bias;
  alone.depth_format = c.depth_format;
  alone.attributes = c.attributes;
  alone.camera = c.camera;
  alone.clip_distance_count = c.clip_distance_count;
  for (const std::uint32_t vertex : c.triangles[triangle]) {
    const std::span<const float> values = c.attributes_of(vertex);
    const std::span<const float> distances = c.clip_distances_of(vertex);
    alone.positions.push_back(c.positions[vertex]);
    alone.attribute_values.insert(alone.attribute_values.end(), values.begin(), values.end());
    alone.clip_distances.insert(alone.clip_distances.end(), distances.begin(), distances.end());
  }
  alone.triangles = {{0, 1, 2}};
  return alone;
}

std::optional<cases::Case> received_case(const records::SampleTrace& trace, cases::Case alone) {
  for (std::size_t v = 0; v < 3; ++v) {
    const auto& [x, y, z, w] = trace.positions[v];
    if (!are_finite(x, y, z, w)) return std::nullopt;
    alone.positions[v] = {x, y, z, w};
  }
  return alone;
}

std::optional<Field> Terms::at(const Weights& weights) const {
  Ring numerator(0);
  Ring denominator(0);
  for (std::size_t c = 0; c < 3; ++c) {
    numerator += numerators[c] * weights[c];
    denominator += denominators[c] * weights[c];
  }
  if (sign_of(denominator) == 0) return std::nullopt;
  return quotient(numerator, denominator);
}

std::optional<Field> Terms::mean(const Weights& shares) const {
  const Ring all = shares[0] + shares[1] + shares[2];
  if (sign_of(all) == 0) return std::nullopt;
  Field sum(0);
  for (std::size_t c = 0; c < 3; ++c) {
    if (sign_of(denominators[c]) == 0) return std::nullopt;
    sum += Field(shares[c]) * quotient(numerators[c], denominators[c]);
  }
  return sum / Field(all);
}

bool Corners::are_vertices() const {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t v = 0; v < 3; ++v) {
      if (shares[c][static_cast<Eigen::Index>(v)] != Ring(c == v ? 1 : 0)) return false;
    }
  }
  return true;
}

Corners vertices_of(const TriangleSetup& triangle) {
  Corners corners;
  corners.columns = triangle.columns;
  for (std::size_t c = 0; c < 3; ++c) {
    corners.shares[c] = RingVector3(Ring(0), Ring(0), Ring(0));
    corners.shares[c][static_cast<Eigen::Index>(c)] = Ring(1);
    corners.depths[c] = triangle.scene->depth_numerator(triangle.indices[c]);
  }
  return corners;
}

std::optional<Corners> traced_corners(const std::array<records::TracedCorner, 3>& corners,
                                      const Scene& scene) {
  if (!std::all_of(corners.begin(), corners.end(), is_finite)) return std::nullopt;
  Corners exact;
  for (std::size_t c = 0; c < 3; ++c) {
    const records::TracedCorner& corner = corners[c];
    const Ring w(corner.w);
    const Ring factor = corner.is_homogeneous ? Ring(1) : w;
    exact.columns[c] = {Ring(corner.x) * factor, Ring(corner.y) * factor, w};
    exact.shares[c] = {Ring(corner.share[0]), Ring(corner.share[1]), Ring(corner.share[2])};
    exact.depths[c] = scene.depth_numerator(Ring(corner.z), w);
  }
  return exact;
}

Terms terms_of(const Corners& corners, const TriangleSetup& triangle,
               std::optional<std::uint32_t> attribute) {
  Terms terms;
  for (std::size_t c = 0; c < 3; ++c) terms.denominators[c] = corners.columns[c][2];
  if (!attribute) {
    terms.numerators = corners.depths;
    return terms;
  }
  const cases::Case& source = triangle.scene->source();
  const bool is_smooth =
      source.attributes[*attribute].interpolation == cases::Interpolation::smooth;
  for (std::size_t c = 0; c < 3; ++c) {
    terms.numerators[c] = Ring(0);
    if (is_smooth) terms.denominators[c] = Ring(1);
    for (std::size_t v = 0; v < 3; ++v) {
      const Ring value = exact_ring(source.attributes_of(triangle.indices[v])[*attribute]);
      const Ring whole = is_smooth ? value : value * triangle.columns[v][2];
      terms.numerators[c] += corners.shares[c][static_cast<Eigen::Index>(v)] * whole;
    }
  }
  return terms;
}

Form form_of(const Corners& corners, const Terms& terms) {
  const ProjectiveMap map(corners.columns);
  return [map, terms](const Point& p) -> std::optional<Field> {
    if (map.orientation() == 0) return std::nullopt;
    return terms.at({map.edge(0).at(p), map.edge(1).at(p), map.edge(2).at(p)});
  };
}

std::optional<Form> form_of(const std::array<records::TracedLine, 3>& lines,
                            const records::TracedFrame& frame, const Terms& terms) {
  std::array<Line, 3> exact;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::optional<Line> line = window_line(lines[c], frame);
    if (!line) return std::nullopt;
    exact[c] = *line;
  }
  return [exact, terms](const Point& p) {
    return terms.at({exact[0].at(p), exact[1].at(p), exact[2].at(p)});
  };
}

std::optional<Form> form_of(const records::TracedPlane& numerator,
                            const std::optional<records::TracedPlane>& denominator,
                            const records::TracedFrame& frame) {
  const std::optional<Line> above = window_plane(numerator, frame);
  const std::optional<Line> below =
      denominator ? window_plane(*denominator, frame) : Line{Ring(0), Ring(0), Ring(1)};
  if (!above || !below) return std::nullopt;
  return [n = *above, d = *below](const Point& p) -> std::optional<Field> {
    const Ring divisor = d.at(p);
    if (sign_of(divisor) == 0) return std::nullopt;
    return quotient(n.at(p), divisor);
  };
}

std::optional<Line> window_line(const records::TracedLine& line,
                                const records::TracedFrame& frame) {
  return functional(line.a, line.b, line.c, frame.t, frame);
}

std::optional<Weights> exact_weights(const std::array<double, 3>& weights) {
  if (!are_finite(weights[0], weights[1], weights[2])) return std::nullopt;
  return Weights{Ring(weights[0]), Ring(weights[1]), Ring(weights[2])};
}

std::optional<Point> exact_point(double u, double v) {
  if (!are_finite(u, v)) return std::nullopt;
  return Point{Ring(u), Ring(v)};
}

}  // namespace rastercheck::oracle
