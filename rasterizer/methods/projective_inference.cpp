// projective-inference: rational linear interpolation "the hard way" (Heckbert & Moreton 1991,
// §3.1; Heckbert, Texture Mapping Polygons in Perspective, 1983, and Fundamentals of Texture
// Mapping and Image Warping, 1989), for two attributes at a time.
//
// The mathematics, row vectors as in Heckbert & Moreton 1991. Two attributes (s, t) are texture
// coordinates.
//
//   inference      the affine parameterization that takes (s_i, t_i) to the object position P_i of
//                  the three vertices: with s_ij = s_i − s_j and so on, det = s_10 t_20 − s_20
//                  t_10,
//
//                    ∂P/∂s = (t_20 (P_1 − P_0) − t_10 (P_2 − P_0)) / det,
//                    ∂P/∂t = (s_10 (P_2 − P_0) − s_20 (P_1 − P_0)) / det,
//                    origin = P_0 − s_0 ∂P/∂s − t_0 ∂P/∂t,
//
//                  a 3 × 4 matrix with the last column (0, 0, 1)
//   concatenation  times the object-to-screen matrix, 4 × 3 without z: the matrix M_ts,
//                  (x w, y w, w) = (s q, t q, q) M_ts
//   inversion      by the adjoint, M_ts^-1 up to a factor
//   at a place     (s q, t q, q) = (x, y, 1) adj(M_ts), s = (s q)/q, t = (t q)/q.
//
// Heckbert transforms the vertices of the clipped polygon this way and interpolates; here every
// place is transformed, and nothing is clipped. A draw has no object positions, so the homogeneous
// window coordinates (X, Y, w) serve as object space; clip space and every real object space are
// linear images of them. The object-to-screen matrix is then the identity; the method multiplies by
// it all the same. The texture's origin is moved to the first vertex, s_i − s_0 and t_i − t_0 in
// place of s_i and t_i, and s_0 and t_0 are added at the place: a texture far from its origin costs
// no digits, and the drawn s does not depend on t_0.
//
// Operations. Heckbert & Moreton 1991 count 133 for a polygon and 12 for a vertex, "multiplies and
// adds", without a breakdown. With
//
//   inference      4 + 6 differences, det 3, ∂P/∂s and ∂P/∂t 9 each, origin 12     43
//                  (and 6 divisions)
//   concatenation  of a whole 3 × 4 with a whole 4 × 3 matrix, 9 (4 + 3)            63
//   adjoint        9 (2 + 1)                                                        27
//
// the total is 133 if the divisions do not count, and (x, y, 1) times a 3 × 3 matrix takes 3 (2 +
// 2) = 12. The method's own code has these counts, plus 4 for moving the origin. (A concatenation
// that uses the known last column would take 48.)
//
// Pairing. Smooth attributes are paired in order, each with the next. The inference has no inverse
// if the three (s_i, t_i) lie on a line, and is useless if they nearly do. If
//
//   κ = (|s_10| + |s_20|)(|t_10| + |t_20|) / |det|
//
// is more than 2^10, the first of the two is drawn alone, and so is the last attribute of an odd
// number. An attribute drawn alone gets a second coordinate t = (0, −s_20, s_10), which makes det =
// s_10² + s_20² and κ <= 2. An attribute with equal values at the three vertices needs no map and
// is copied.
//
// Error (internal/point_drawing.h), u = 2^-53, to first order; the rounded-up factor at the end
// covers higher orders. Let a = |s_10| + |s_20|, b = |t_10| + |t_20|, so ab = κ |det|, κ >= 1. Let
// h = (h_X, h_Y, h_w) be the greatest |X|_i, |Y|_i and |w_i|, let Π be the sum of the magnitudes of
// the terms of (h × h) · (x, y, 1), and let
//
//   R = the greatest of 2 h_α h_β / Σ_{j≠k} |α|_j |β|_k for αβ = XY, Xw, Yw,     Π <= R Σ|E|_i.
//
// The errors are at most
//
//   ∂P/∂s          12 κ u (2 b h/|det|): differences 4 u and 1 u, product and difference 2 u, det
//                  4 κ u, quotient 1 u; and for ∂P/∂t 12 κ u (2 a h/|det|)
//   origin         3 u h, for P_0
//   concatenation  0: exact, with 0 and 1
//   q              29 κ u (4 a b/det²) Π: a product of two, 2 u, and 3 u for the place. This is at
//                  most 116 κ² R u Σ|E|_i/|det|; and q = D/det
//   (s − s_0) q    20 κ u (2 a/|det|) Π <= 40 κ a R u Σ|E|_i/|det|, a <= 4 M; t likewise
//
// As |s − s_0| <= 2 M this gives 160 κ R + 232 κ² R in place of n + d. The quotient and the sum
// with s_0 add 1, which is at most 3 R because R >= 1/3. In all, this is less than 400 κ² R. R
// depends on the triangle and κ on its texture, so the promise is made per draw, with the greatest
// product. R is 1/3 if all coordinates of the vertices have the same magnitude, and κ is a few
// units if the texture's triangle is not thin. Barycentric coordinates in place of texture
// coordinates, as in q-matrix, would remove κ, but that would be another method.
//
// Range. As κ <= 2^10, neither ∂P/∂s <= 2 κ h/a nor its products come near 2^1023; the terms'
// magnitudes, if not 0, are at least 2^-860, so underflow is negligible beside their roundings.
//
// Not done here: drawing from object positions, and clipping.
//
// Operations for two attributes, and the divisions among them:
//   projective-inference: 16 (2) per pixel, 143 (6) per polygon

#include "rasterizer/methods/internal/projective_inference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "rasterizer/internal/determinant.h"
#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

/// Maximum κ for which two attributes are used as a texture.
constexpr double kMostCondition = 0x1p10;

struct Differences {
  double first = 0;
  double second = 0;

  explicit Differences(const Triple<double>& s) : first(s[1] - s[0]), second(s[2] - s[0]) {}
  double size() const { return std::abs(first) + std::abs(second); }
};

/// Returns κ; infinite or NaN if no map exists.
double texture_condition(const Differences& s, const Differences& t) {
  return s.size() * t.size() / std::abs(s.first * t.second - s.second * t.first);
}

/// How an attribute, alone or paired with the next, is drawn.
struct Part {
  enum class Kind { constant, alone, pair };
  Kind kind = Kind::constant;
  std::size_t attribute = 0;
  double condition = 1;  ///< κ

  std::size_t width() const { return kind == Kind::pair ? 2 : 1; }
};

/// Returns the part that begins with `attribute`; `values` are [attribute][vertex].
Part part_at(std::size_t attribute, std::span<const Triple<double>> values) {
  const Differences s(values[attribute]);
  if (attribute + 1 < values.size()) {
    const double condition = texture_condition(s, Differences(values[attribute + 1]));
    if (condition <= kMostCondition) return {Part::Kind::pair, attribute, condition};
  }
  if (s.size() == 0) return {Part::Kind::constant, attribute};
  const double squares = s.first * s.first + s.second * s.second;
  return {Part::Kind::alone, attribute, s.size() * s.size() / squares};
}

// --- The formula ---------------------------------------------------------------------------------

template <class T>
class TextureMaps {
 public:
  void set_vertex(std::size_t i, const PointVertex& vertex, std::size_t count) {
    positions_[i] = {T(vertex.x), T(vertex.y), T(vertex.w)};
    for (std::size_t k = 0; k < count; ++k) values_[k][i] = vertex.values[k];
  }

  void set_up(std::size_t count) {
    part_count_ = 0;
    for (std::size_t k = 0; k < count; k += maps_[part_count_++].part.width()) {
      Map& map = maps_[part_count_];
      map.part = part_at(k, std::span(values_.data(), count));
      if (map.part.kind == Part::Kind::constant) continue;
      map.planes = screen_to_texture(
          concatenate(infer_parameterization(texture_of(map.part), positions_), identity()));
    }
  }

  void at(T u, T v, std::span<T> values) const {
    for (const Map& map : std::span(maps_.data(), part_count_)) {
      const std::size_t k = map.part.attribute;
      if (map.part.kind == Part::Kind::constant) {
        values[k] = T(values_[k][0]);
      } else if (map.part.kind == Part::Kind::alone) {
        values[k] =
            T(values_[k][0]) + plane_at(map.planes[0], u, v) / plane_at(map.planes[2], u, v);
      } else {
        const Triple<T> texture = transform(map.planes, u, v);
        values[k] = T(values_[k][0]) + texture[0] / texture[2];
        values[k + 1] = T(values_[k + 1][0]) + texture[1] / texture[2];
      }
    }
  }

 private:
  struct Map {
    Part part;
    std::array<Triple<T>, 3> planes;
  };

  static ObjectToScreen<T> identity() {
    ObjectToScreen<T> matrix;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 3; ++j) matrix[i][j] = T(i == j ? 1 : 0);
    }
    return matrix;
  }

  /// s_i − s_0.
  Triple<T> moved(std::size_t attribute) const {
    const Triple<double>& s = values_[attribute];
    return {T(0), T(s[1]) - T(s[0]), T(s[2]) - T(s[0])};
  }

  TextureTriangle<T> texture_of(const Part& part) const {
    const Triple<T> s = moved(part.attribute);
    if (part.kind == Part::Kind::pair) return {s, moved(part.attribute + 1)};
    return {s, {T(0), -s[2], s[1]}};
  }

  std::array<Triple<T>, 3> positions_;
  std::array<Triple<double>, kMaxAttributes> values_;  ///< [attribute][vertex]
  std::array<Map, kMaxAttributes> maps_;
  std::size_t part_count_ = 0;
};

// --- The promise ---------------------------------------------------------------------------------

/// Returns R, computed from the magnitudes |X|, |Y| and |w| of the vertices.
double spread(const std::array<Triple<double>, 3>& sizes) {
  double greatest = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    Triple<double> h{};
    double mixed = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      h = {std::max(h[0], sizes[j][a]), std::max(h[1], sizes[j][b]), 0};
      mixed += sizes[j][a] * (sizes[(j + 1) % 3][b] + sizes[(j + 2) % 3][b]);
    }
    if (h[0] * h[1] > 0) greatest = std::max(greatest, 2 * h[0] * h[1] / mixed);
  }
  return greatest;
}

/// Returns the greatest κ of a triangle's parts; 0 if all parts are constant.
double greatest_condition(std::span<const Triple<double>> values) {
  double greatest = 0;
  for (std::size_t k = 0; k < values.size();) {
    const Part part = part_at(k, values);
    if (part.kind != Part::Kind::constant) greatest = std::max(greatest, part.condition);
    k += part.width();
  }
  return greatest;
}

/// Returns |X|, |Y| and |w| as defined in internal/point_drawing.h.
Triple<double> sizes_of(const glm::vec4& p, const Viewport& viewport) {
  Triple<double> sizes{0, 0, std::abs(double{p.w})};
  for (int axis = 0; axis < 2; ++axis) {
    const double half = std::abs(double{viewport.size[axis]}) / 2;
    sizes[static_cast<std::size_t>(axis)] =
        std::abs(double{p[axis]}) * half +
        sizes[2] * (std::abs(double{viewport.origin[axis]}) + half);
  }
  return sizes;
}

bool is_finite(const glm::vec4& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
}

/// Returns n + d for one triangle; 0 if the triangle is not drawn.
double terms(const State& state, const Mesh& mesh, const glm::uvec3& triangle) {
  const std::size_t count = state.attributes.size();
  std::array<Triple<double>, kMaxAttributes> values;
  std::array<Triple<double>, 3> sizes;
  std::size_t smooth = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (state.attributes[k].interpolation != Interpolation::smooth) continue;
    for (int i = 0; i < 3; ++i) {
      values[smooth][static_cast<std::size_t>(i)] = mesh.attributes[triangle[i] * count + k];
    }
    ++smooth;
  }
  std::array<glm::vec4, 3> corners;
  for (int i = 0; i < 3; ++i) {
    const auto vertex = static_cast<std::size_t>(i);
    corners[vertex] = mesh.positions[triangle[i]];
    if (!is_finite(corners[vertex])) return 0;
    sizes[vertex] = sizes_of(corners[vertex], state.viewport);
  }
  if (determinant_sign(corners[0], corners[1], corners[2]) == 0) return 0;
  const double kappa = greatest_condition(std::span(values.data(), smooth));
  return 400 * kappa * kappa * spread(sizes);
}

Promise promise(const State& state, const Mesh& mesh, const TargetSize& /*size*/) {
  // Nothing is promised if the bound reaches this value.
  constexpr double kNothing = 0x1p24;
  MethodBound bound = point_bound(0, 0, kDoubleRoundoff);
  for (const glm::uvec3& triangle : mesh.triangles) {
    const double here = 2 * terms(state, mesh, triangle) * 0x1p24 * kDoubleRoundoff;
    bound.per_condition = std::max(bound.per_condition, here < kNothing ? here : kNothing);
  }
  return {.smooth = bound};
}

const MethodRegistration kRegistration(
    {.name = "projective-inference",
     .source = "Heckbert & Moreton 1991, §3.1; Heckbert 1983 and 1989",
     .fails = "textures whose triangle is thin, besides where the weights cancel",
     .draw = &draw_by_formula<TextureMaps, double>,
     .promise = &promise,
     .operations = &count_formula<TextureMaps>});

}  // namespace
}  // namespace rastercheck::rasterizer
