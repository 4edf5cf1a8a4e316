// subdivide-2, -4, -8, -16 and subdivide-adaptive: a triangle is cut into smaller ones, whose new
// vertices have clip positions and parameters by linear interpolation, and each of which is affine
// in the window: what the SGI VGX did for textures (seed 002 §2.1; seed 004, slide 15).
//
// The mathematics. With barycentrics (b_0, b_1, b_2) linear in clip space, the new vertices are
//
//   p_ij = ((n − i − j) p_0 + i p_1 + j p_2)/n,     r_ij alike,     i, j >= 0, i + j <= n,
//
// and the n² pieces have the corners (i, j), (i+1, j), (i, j+1), or (i+1, j+1), (i, j+1), (i+1, j).
// With β_m a place's barycentrics in its piece, w = Σ β_m w_m, and each β_m/w is affine in the
// window. So the piece's window-space barycentrics are β_m w_m/w, and what is affine on it is
//
//   r = Σ β_m w_m r_m / Σ β_m w_m.
//
// Which piece. The projective map takes clip-space lines to lines of the window: where the w_m of a
// piece are positive its image is the triangle of its vertices' images, which are the places with
// all β_m >= 0. So a place's piece follows from its own b, found from the weights E_i (RULES §1):
// i = floor(n b_1), j = floor(n b_2), and which of the two pieces the sum of the fractions says.
// Scan conversion of pieces one by one draws the same one, but for places on an edge between two,
// and those within roundings of it. There it does not matter which: the functions of both pieces
// are affine along the edge and have the same ends. Coverage is the whole triangle's, as the pieces
// leave no gap between them.
//
// A piece that the eye's plane cuts, with some w_m <= 0, has no three window positions, and what is
// left of it at w > 0 reaches to infinity. It has one value, the mean of its corners'.
//
// Places outside the triangle, as extrapolated centres are, belong to no piece. They have the value
// of the rational formula, Σ r_i E_i / Σ E_i: how far a continued piece is off has no bound.
//
// What it is off by. On a piece whose w are in the ratio ρ_p, as screen_linear.cpp derives,
//
//   f(ρ_p) (max r_m − min r_m),     f(ρ) = (√ρ − 1)/(√ρ + 1) = (ρ − 1)/(√ρ + 1)².
//
// Along edges of pieces r and w change by an n-th of what they change along the triangle's: the
// range is R/n, R = max r_i − min r_i, and with all w_i > 0, ρ = max w_i/min w_i,
//
//   ρ_p = 1 + (max w_m − min w_m)/min w_m <= 1 + (ρ − 1)/n.
//
// So a triangle is off by at most R f(1 + (ρ − 1)/n)/n; attained where the least and the greatest w
// are at the ends of an edge with the extreme r, in the piece at the least. For large n this is
// R (ρ − 1)/(4 n²), a fourth for twice as many. With some w_i <= 0 there is no bound of ρ_p, but
// what is drawn in a piece is a mean of its r_m with weights >= 0, and so is the exact value: they
// are within R/n of each other.
//
// Adaptive. The pieces of n = 1, 2, 4, …, kFinest are nested. A piece is split in four where its
// f(ρ_p)/n, or 1/n where some w_m <= 0, is above kTolerance, and n < kFinest: the budget is
// kFinest² pieces. Pieces side by side that are not of the same n may differ along their edge, by
// what both are off. A triangle is off by kTolerance of R at most where no piece of kFinest is
// above it, else by that of these; and by f(ρ) in any case.
//
// Roundings (internal/point_drawing.h), u = 2^-53. E_i is off by 11 u |E|_i and their sum by 13 u
// Σ|E|, so that |δb_1| + |δb_2| <= 25 u K; twice that takes in what is of higher order where 13 u K
// <= 1/2. n b_i and the fraction of it are exact, n being a power of two, and the β_m cost 3 u.
// Then the formula is that of the place which has these β_m, divided by their sum, in the piece
// found: negative ones, by at most what they are off, are 0. That place's b are off by at most 103
// u K therefore, and as the exact r is linear in b, it is off by 103 u K R <= 206 u K M from that
// of the place asked for, M = max|r_i|. To this come, besides what the piece is off, the roundings
// of w_ij and r_ij, 3 u each where the w_i are positive, and of r: less than 20 u M. The rational
// formula's n + d = 14 + 13. Where some w_i <= 0, a w_ij may be off by any share of itself, which
// changes nothing as long as the weights are >= 0. Only the adaptive method relies on it: a piece
// that it does not split, n < kFinest, has f(ρ_p) < 1/16, and so w_m which are more than the n-th
// of the w_i's differences, and more than max|w_i|/10: off by 30 u, which is nothing beside what
// the share is rounded up by.
//
// Operations are those of drawing the pieces one by one by screen-linear; of the adaptive ones,
// those that the triangle with w = 1, 2, 4 takes, with three new vertices for each split. To find a
// place's piece takes the place of their scan conversion, and is not among them.
//
// What it does not do: snap the new vertices' window positions to a grid, which opens gaps where
// pieces that are split differently meet.
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

/// Of the adaptive method: pieces per edge, a power of two, and a share of the values' range.
constexpr int kFinest = 32;
constexpr double kTolerance = 0x1p-8;

/// Roundings, as above.
constexpr MethodBound kRoundings{.constant = 0.5 + 20 * 0x1p-29, .per_condition = 206 * 0x1p-29};

/// What is linear in clip space at (i, j) of n: s_0, s_1, s_2 at the triangle's vertices.
template <class T>
T at_lattice(const std::array<T, 3>& s, int i, int j, int n) {
  return (T(n - i - j) * s[0] + T(i) * s[1] + T(j) * s[2]) / T(n);
}

/// f(ρ): how far affine interpolation is off, as a share of the values' range.
double affine_share(double ratio) {
  const double root = std::sqrt(ratio) + 1;
  return (ratio - 1) / (root * root);
}

/// The same of a piece with these w, n pieces per edge, of the triangle's range.
double share_of(const std::array<double, 3>& w, int n) {
  const auto [least, greatest] = std::minmax_element(w.begin(), w.end());
  return (*least > 0 ? affine_share(*greatest / *least) : 1) / n;
}

/// One of n² pieces: a place's β in it, of the corners (i, j).
struct Piece {
  struct Corner {
    int i = 0;
    int j = 0;
  };
  int n = 1;
  std::array<Corner, 3> corners;
  std::array<double, 3> beta;
};

/// The piece of a place; b_1, b_2 >= 0 and b_1 + b_2 <= 1 but for roundings.
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
  /// At least and at most that many pieces per edge, powers of two.
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

// --- What is promised ---------------------------------------------------------------------------

/// f(1 + (ρ − 1)/n)/n of a triangle with these w, 1/n where some are not positive; 0 of one that is
/// not drawn.
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
  // Rounded up: it is handed on as a float.
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

/// A new vertex: position but for z, and two attributes.
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

/// How many pieces of n per edge the adaptive method splits.
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
  return MethodRegistration({.name = name,
                             .source = "seeds 002 §2.1, 004 slide 15",
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
     .source = "seed 002 §2.1",
     .fails = "in the pieces that its budget leaves too large: those next to the eye",
     .draw = &draw<1, kFinest>,
     .promise = &promise<1, kFinest>,
     .operations = &adaptive_operations});

}  // namespace
}  // namespace rastercheck::rasterizer
