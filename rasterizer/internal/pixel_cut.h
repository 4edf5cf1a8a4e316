#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Decides whether a pixel's open square meets a triangle, for every triangle: with vertices behind
// the eye, cut by clip planes or by the viewport, or without area (Conservative::outer).
//
// A point of the triangle is Σ λ_i p_i, with weights λ_i >= 0 of its clip positions. Each further
// condition is linear in the λ: a clip plane with distances g_i keeps Σ λ_i g_i >= 0, and a side of
// the pixel (of the viewport) at window position s keeps what lies beyond it,
//
//   Σ λ_i n_i > 0,   n_i = ± (x_i W + w_i (2 x0 + W − 2 s)),
//
// twice the distance times w_i. The two sides of a pixel along an axis together imply w > 0. So the
// pixel is met iff the cone of the λ that satisfy all conditions has inner points.
//
// The cone is kept as a convex polygon whose sides are conditions, and whose corners are the cross
// products of two conditions (Sutherland & Hodgman 1974). A polygon with inner points keeps some
// when it is cut iff the new condition is positive at some corner. That is the sign of a
// determinant of three conditions: in double if double is certain, else in a sum without rounding.
//
// Exponents. The numbers of a condition are sums of floats and of products of two floats: multiples
// of 2^-298 below 2^260. So the determinant's terms are multiples of 2^-894 below 2^785.
//
// Error in double. Let M be the sum of the magnitudes of a number's terms, and u = 2^-53. The
// number itself has an error of at most 3u M, so a product of three of them one of at most 9u + 2u
// of the product of their M; six such products are added with five roundings. 2^-48 times the sum
// of all products of the M bounds the error.

#include <array>
#include <cstddef>
#include <vector>

#include "rasterizer/internal/clip_functionals.h"
#include "rasterizer/internal/draw_setting.h"

namespace rastercheck::rasterizer {

class PixelCut {
 public:
  explicit PixelCut(const DrawSetting& setting) : setting_(setting) {}

  /// Prepares a triangle; its clip functionals must be those that may cut it. Returns false if no
  /// pixel can be met.
  bool set_up(const std::array<glm::vec4, 3>& corners, const ClipFunctionals& clips);

  /// True if the open square of pixel (x, y) meets the triangle inside the viewport.
  bool meets(int x, int y);

 private:
  /// A number as a sum of at most four doubles, with its value and magnitude in double.
  struct Number {
    std::array<double, 4> terms{};
    std::size_t size = 0;
    double value = 0;
    double magnitude = 0;

    void add(double term);
  };
  using Condition = std::array<Number, 3>;  ///< [vertex]
  struct Corner {
    std::size_t first = 0;  ///< conditions; the corner is sign · (first × second)
    std::size_t second = 0;
    std::size_t side = 0;  ///< the condition of the side from here to the next corner
    int sign = 1;
  };

  Condition side_of(int axis, double sign, double twice_at) const;
  Condition viewport_side(int axis, bool is_far) const;
  static int determinant_sign(const Condition& a, const Condition& b, const Condition& c);
  Corner corner_of(std::size_t first, std::size_t second, std::size_t side) const;
  /// Cuts the polygon by a condition; false if no inner points are left.
  bool cut(const Condition& condition);

  const DrawSetting& setting_;
  std::array<glm::vec4, 3> corners_;
  std::vector<Condition> conditions_;
  std::vector<Corner> polygon_;
  /// The conditions and the polygon that all pixels begin with.
  std::vector<Condition> first_conditions_;
  std::vector<Corner> first_polygon_;
  std::vector<int> at_;
  std::vector<Corner> kept_;
};

}  // namespace rastercheck::rasterizer
