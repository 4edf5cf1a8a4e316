// subdivide-2, -4, -8, -16 and subdivide-adaptive: cut a triangle into smaller pieces, whose new
// vertices have linearly interpolated clip positions and parameters, and draw each piece affine in
// the window, as the SGI VGX did for textures (Heckbert & Moreton 1991, §2.1; MIT 6.837 2000,
// lecture 18, slide 15).
//
// The mathematics. With barycentrics (b_0, b_1, b_2) linear in clip space, the new vertices are
//
//   p_ij = ((n − i − j) p_0 + i p_1 + j p_2)/n,     r_ij likewise,     i, j >= 0, i + j <= n,
//
// and the n² pieces have the corners (i, j), (i+1, j), (i, j+1), or (i+1, j+1), (i, j+1), (i+1, j).
// Let β_m be a place's barycentrics in its piece. Then w = Σ β_m w_m, and each β_m/w is affine in
// the window. So the piece's window-space barycentrics are β_m w_m/w, and its affine function is
//
//   r = Σ β_m w_m r_m / Σ β_m w_m.
//
// Which piece. The projective map takes clip-space lines to lines of the window: if the w_m of a
// piece are positive, its image is the triangle of its vertices' images, the places with all
// β_m >= 0. So a place's piece follows from its own b, found from the weights E_i (RULES §1):
// i = floor(n b_1), j = floor(n b_2), and the sum of the fractions selects one of the two pieces.
// Scan conversion of pieces one by one would draw the same piece, except for places on an edge
// between two pieces or within roundings of it. There the choice does not matter: the functions of
// both pieces are affine along the edge and have the same ends. Coverage is that of the whole
// triangle, because the pieces leave no gap between them.
//
// A piece cut by the eye's plane, with some w_m <= 0, has no three window positions, and its part
// at w > 0 reaches to infinity. Such a piece gets one value, the mean of its corners'.
//
// Places outside the triangle, such as extrapolated centres, belong to no piece. They get the value
// of the rational formula, Σ r_i E_i / Σ E_i, because the error of a continued piece has no bound.
//
// Approximation error. On a piece whose w have the ratio ρ_p, as screen_linear.cpp derives, it is
//
//   f(ρ_p) (max r_m − min r_m),     f(ρ) = (√ρ − 1)/(√ρ + 1) = (ρ − 1)/(√ρ + 1)².
//
// Along an edge of a piece, r and w change by 1/n of their change along the parallel edge of the
// triangle. So the range is R/n, R = max r_i − min r_i, and if all w_i > 0, with ρ = max w_i/min
// w_i,
//
//   ρ_p = 1 + (max w_m − min w_m)/min w_m <= 1 + (ρ − 1)/n.
//
// So a triangle has an error of at most R f(1 + (ρ − 1)/n)/n. It is attained, in the piece at the
// vertex of least w, if one edge joins the vertices of least and greatest w and these also have the
// extreme r. For large n this is R (ρ − 1)/(4 n²): twice as many pieces per edge give a fourth of
// the error. With some w_i <= 0, ρ_p has no bound, but a drawn value is a mean of its piece's r_m
// with weights >= 0, and so is the exact value. So the two are within R/n of each other.
//
// Adaptive. The pieces of n = 1, 2, 4, …, kFinest are nested. A piece is split in four if its
// f(ρ_p)/n, or 1/n if some w_m <= 0, is above kTolerance, and n < kFinest: the budget is kFinest²
// pieces. Adjacent pieces of different n may differ along their edge, by the sum of their errors. A
// triangle has an error of at most the greater of R kTolerance and the error of the finest pieces,
// and never more than R f(ρ), or R if some w_i <= 0.
//
// Roundings (internal/point_drawing.h), u = 2^-53. Each E_i has an error of 11 u |E|_i, and their
// sum has an error of 13 u Σ|E|, so |δb_1| + |δb_2| <= 25 u K; twice that covers higher orders if
// 13 u K <= 1/2. n b_i and its fraction are exact, n being a power of two, and the β_m cost 3 u. A
// negative β_m is set to 0 (it is negative only by its error). Apart from later roundings, the
// formula then gives the result for a nearby place: the place whose barycentrics in the chosen
// piece are β_m / Σ β_m. The b of that place differ from those of the requested place by at most
// 103 u K. As the exact r is linear in b, r there is within 103 u K R <= 206 u K M of r at the
// requested place, M = max|r_i|. The piece's approximation error comes on top, and so do the
// roundings of w_ij and r_ij, 3 u each if the w_i are positive, and of r: less than 20 u M. The
// rational formula has n + d = 14 + 13.
//
// With some w_i <= 0, a w_ij may have any relative error, which does no harm as long as the weights
// are >= 0. Only the adaptive method relies on w_ij. A piece with n < kFinest that it does not
// split has f(ρ_p) <= 1/16. So its w_m are more than 1/n of the differences of the w_i, and more
// than max|w_i|/10: their error of 30 u is negligible beside the rounding up of the share.
//
// Operations are counted as if screen-linear drew the pieces one by one. For the adaptive method
// the triangle has w = 1, 2, 4, and each split makes three new vertices. Finding a place's piece
// replaces the pieces' scan conversion, and is not counted.
//
// Window positions of new vertices are not snapped to a grid, because that would open gaps between
// pieces that are split differently.
//
// Operations for two attributes, and the divisions among them:
//   subdivide-16: 8 per pixel, 2 (2) per vertex, 18,368 (2,586) per polygon
//   subdivide-2: 8 per pixel, 2 (2) per vertex, 308 (45) per polygon
//   subdivide-4: 8 per pixel, 2 (2) per vertex, 1,232 (180) per polygon
//   subdivide-8: 8 per pixel, 2 (2) per vertex, 4,736 (678) per polygon
//   subdivide-adaptive: 8 per pixel, 2 (2) per vertex, 18,923 (2,892) per polygon

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "rasterizer/methods/internal/counted.h"
#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

/// For the adaptive method: the maximum number of pieces per edge, a power of two; and the
/// tolerated error, as a share of the values' range.
constexpr int kFinest = 32;
constexpr double kTolerance = 0x1p-8;

/// Bound of the roundings, derived above.
constexpr MethodBound kRoundings{.constant = 0.5 + 20 * 0x1p-29, .per_condition = 206 * 0x1p-29};

/// Interpolates s_0, s_1, s_2, the values at the vertices, linearly in clip space to the point (i,
/// j) of the lattice with n pieces per edge.
template <class T>
T at_lattice(const std::array<T, 3>& s, int i, int j, int n) {
  return (T(n - i - j) * s[0] + T(i) * s[1] + T(j) * s[2]) / T(n);
}

/// Returns f(ρ): the error of affine interpolation, as a share of the values' range.
double affine_share(double ratio) {
  const double root = std::sqrt(ratio) + 1;
  return (ratio - 1) / (root * root);
}

/// Returns the error in a piece with these w, of n pieces per edge, as a share of the triangle's
/// range.
double share_of(const std::array<double, 3>& w, int n) {
  const auto [least, greatest] = std::minmax_element(w.begin(), w.end());
  return (*least > 0 ? affine_share(*greatest / *least) : 1) / n;
}

/// One of n² pieces, given by its corners (i, j), and the β of a place in it.
struct Piece {
  struct Corner {
    int i = 0;
    int j = 0;
  };
  int n = 1;
  std::array<Corner, 3> corners;
  std::array<double, 3> beta;
};

/// Returns the piece that contains a place; up to roundings, b_1, b_2 >= 0 and b_1 + b_2 <= 1.
Piece piece_at(double b1, double b2, int n) {
  const double x = n * b1;
  const double y = n * b2;
  const int i = std::min(static_cast<int>(x), n - 1);
  const int j = std::min(static_cast<int>(y), n - 1 - i);
  const double f = x - i;
  const double g = y - j;
  if (f + g <= 1 || i + j == n - 1) {
    return {n, {{{i, j}, {i + 1, j}, {i, j + 1}}}, {std::max(1 - f - g, 0.0), f, g}};
  }
  return {n, {{{i + 1, j + 1}, {i, j + 1}, {i + 1, j}}}, {f + g - 1, 1 - f, 1 - g}};
}

class Subdivision : public PointFormula {
 public:
  /// The minimum and maximum number of pieces per edge; powers of two.
  Subdivision(int coarsest, int finest) : coarsest_(coarsest), finest_(finest) {}

  void set(const std::array<PointVertex, 3>& vertices, std::size_t count) override {
    for (std::size_t i = 0; i < 3; ++i) {
      const PointVertex& p = vertices[(i + 1) % 3];
      const PointVertex& q = vertices[(i + 2) % 3];
      rows_[i] = {p.y * q.w - q.y * p.w, p.w * q.x - q.w * p.x, p.x * q.y - q.x * p.y};
      w_[i] = vertices[i].w;
      for (std::size_t k = 0; k < count; ++k) values_[k][i] = vertices[i].values[k];
    }
  }

  void at(double u, double v, std::span<double> values) const override {
    std::array<double, 3> e;
    for (std::size_t i = 0; i < 3; ++i) e[i] = rows_[i].x * u + rows_[i].y * v + rows_[i].z;
    const double sum = e[0] + e[1] + e[2];
    const double b1 = e[1] / sum;
    const double b2 = e[2] / sum;
    if (b1 >= 0 && b2 >= 0 && b1 + b2 <= 1) {
      interpolate(find(b1, b2), values);
    } else {
      for (std::size_t k = 0; k < values.size(); ++k) {
        const auto& [r0, r1, r2] = values_[k];
        values[k] = (r0 * e[0] + r1 * e[1] + r2 * e[2]) / sum;
      }
    }
  }

 private:
  std::array<double, 3> at_corners(const Piece& piece, const std::array<double, 3>& s) const {
    std::array<double, 3> all;
    for (std::size_t m = 0; m < 3; ++m) {
      all[m] = at_lattice(s, piece.corners[m].i, piece.corners[m].j, piece.n);
    }
    return all;
  }

  Piece find(double b1, double b2) const {
    int n = coarsest_;
    Piece piece = piece_at(b1, b2, n);
    while (n < finest_ && share_of(at_corners(piece, w_), n) > kTolerance) {
      n *= 2;
      piece = piece_at(b1, b2, n);
    }
    return piece;
  }

  void interpolate(const Piece& piece, std::span<double> values) const {
    const std::array<double, 3> w = at_corners(piece, w_);
    const bool is_in_front = w[0] > 0 && w[1] > 0 && w[2] > 0;
    std::array<double, 3> weights{1, 1, 1};
    if (is_in_front) {
      for (std::size_t m = 0; m < 3; ++m) weights[m] = piece.beta[m] * w[m];
    }
    const double sum = weights[0] + weights[1] + weights[2];
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto [r0, r1, r2] = at_corners(piece, values_[k]);
      values[k] = (weights[0] * r0 + weights[1] * r1 + weights[2] * r2) / sum;
    }
  }

  int coarsest_;
  int finest_;
  std::array<glm::dvec3, 3> rows_;  ///< (A, B, C) of the weights
  std::array<double, 3> w_{};
  std::array<std::array<double, 3>, kMaxAttributes> values_;  ///< [attribute][vertex]
};

template <int kCoarsest, int kMost>
DrawCounts draw(const State& state, const Mesh& mesh, const TargetSize& size, Fragments& fragments,
                MethodTap* tap) {
  Subdivision formula(kCoarsest, kMost);
  return draw_points(state, mesh, size, formula, fragments, tap);
}

// --- The promise ---------------------------------------------------------------------------------

/// Returns f(1 + (ρ − 1)/n)/n for a triangle with these w; 1/n if some w are not positive; 0 if the
/// triangle is not drawn.
double greatest_share(const std::array<double, 3>& w, int n) {
  const auto [least, greatest] = std::minmax_element(w.begin(), w.end());
  if (!std::isfinite(w[0] + w[1] + w[2]) || *greatest <= 0) return 0;
  if (*least <= 0) return 1.0 / n;
  return affine_share(1 + (*greatest - *least) / *least / n) / n;
}

double greatest_share(const std::array<double, 3>& w, int coarsest, int finest) {
  const double whole = greatest_share(w, coarsest);
  if (coarsest == finest) return whole;
  return std::min(whole, std::max(greatest_share(w, finest), kTolerance));
}

template <int kCoarsest, int kMost>
Promise promise(const State& /*state*/, const Mesh& mesh, const TargetSize& /*size*/) {
  double share = 0;
  for (const glm::uvec3& corners : mesh.triangles) {
    const std::array<double, 3> w{mesh.positions[corners.x].w, mesh.positions[corners.y].w,
                                  mesh.positions[corners.z].w};
    share = std::max(share, greatest_share(w, kCoarsest, kMost));
  }
  Promise promised{.smooth = kRoundings};
  // Rounded up, because it is passed on as a float.
  promised.smooth.range_share = share * (1 + 0x1p-20);
  return promised;
}

// --- Operations ---------------------------------------------------------------------------------

Operations operator+(const Operations& a, const Operations& b) {
  return {a.additions + b.additions, a.multiplications + b.multiplications,
          a.divisions + b.divisions};
}

Operations operator*(std::size_t times, const Operations& each) {
  return {times * each.additions, times * each.multiplications, times * each.divisions};
}

/// Counts the operations of a new vertex: position without z, and two attributes.
Operations new_vertex() {
  const std::array<Counted, 3> s{Counted(1), Counted(2), Counted(4)};
  return 5 * count_operations([&] { static_cast<void>(at_lattice(s, 1, 1, 4)); });
}

OperationCounts count_pieces(std::size_t pieces, std::size_t new_vertices) {
  const Method* screen_linear = find_method("screen-linear");
  if (screen_linear == nullptr) return {};
  OperationCounts counts = screen_linear->operations();
  counts.per_polygon =
      pieces * counts.per_polygon + new_vertices * (new_vertex() + counts.per_vertex);
  return counts;
}

template <int n>
OperationCounts uniform_operations() {
  constexpr std::size_t kEdge = n;
  return count_pieces(kEdge * kEdge, (kEdge + 1) * (kEdge + 2) / 2 - 3);
}

/// Returns how many pieces the adaptive method splits at the level of n pieces per edge.
std::size_t splits(const std::array<double, 3>& w, int n) {
  std::size_t count = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const auto at = [&](int p, int q) { return at_lattice(w, p, q, n); };
      const double between = at(i + 1, j);
      if (share_of({at(i, j), between, at(i, j + 1)}, n) > kTolerance) ++count;
      if (i + j + 1 == n) continue;
      if (share_of({at(i + 1, j + 1), at(i, j + 1), between}, n) > kTolerance) ++count;
    }
  }
  return count;
}

OperationCounts adaptive_operations() {
  const std::array<PointVertex, 3> triangle = counted_triangle();
  std::size_t count = 0;
  for (int n = 1; n < kFinest; n *= 2) {
    count += splits({triangle[0].w, triangle[1].w, triangle[2].w}, n);
  }
  return count_pieces(1 + 3 * count, 3 * count);
}

template <int n>
MethodRegistration uniform(std::string_view name) {
  return MethodRegistration(
      {.name = name,
       .source = "Heckbert & Moreton 1991, §2.1; MIT 6.837 2000, lecture 18, slide 15",
       .fails = "in the pieces next to the eye, where w changes most",
       .draw = &draw<n, n>,
       .promise = &promise<n, n>,
       .operations = &uniform_operations<n>});
}

const MethodRegistration kTwo = uniform<2>("subdivide-2");
const MethodRegistration kFour = uniform<4>("subdivide-4");
const MethodRegistration kEight = uniform<8>("subdivide-8");
const MethodRegistration kSixteen = uniform<16>("subdivide-16");
const MethodRegistration kAdaptive(
    {.name = "subdivide-adaptive",
     .source = "Heckbert & Moreton 1991, §2.1",
     .fails = "in the pieces that its budget leaves too large: those next to the eye",
     .draw = &draw<1, kFinest>,
     .promise = &promise<1, kFinest>,
     .operations = &adaptive_operations});

}  // namespace
}  // namespace rastercheck::rasterizer
