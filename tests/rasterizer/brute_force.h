#pragma once

// Triangles drawn by rational arithmetic alone, slowly and as simply as possible: the definition
// that the rasterizer's coverage and values are compared with. Vertices are transformed to
// homogeneous window positions, their matrix is inverted, and the three functionals of the inverse
// are evaluated at every sample. Only types are shared with the rasterizer.

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "tests/rasterizer/exact.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer {

/// One triangle as the rules define it; u and v are window coordinates in pixels.
class BruteForce {
 public:
  BruteForce(const State& state, const SmallMesh& mesh, const glm::uvec3& corners);

  /// True if the triangle is edge-on, or the viewport has no width or no height.
  bool is_degenerate() const { return determinant_ == 0; }
  bool is_culled() const;
  bool covers(const Rational& u, const Rational& v) const;
  Rational depth(const Rational& u, const Rational& v) const;
  /// The depth before it is clamped.
  Rational plane_depth(const Rational& u, const Rational& v) const;
  /// The greater |derivative| of that by u and by v.
  Rational steepness() const;
  /// The depth with State::depth_bias, clamped, before it is stored in State::depth_format.
  Rational biased_depth(const Rational& u, const Rational& v) const;

  /// 1/w.
  Rational reciprocal_w(const Rational& u, const Rational& v) const;
  /// Attribute `index`; undefined if the attribute is smooth and 1/w is not positive.
  Rational attribute(std::size_t index, const Rational& u, const Rational& v) const;
  /// The largest |r_i| of an attribute at the vertices.
  Rational scale(std::size_t index) const;

 private:
  /// The functional A u + B v + C.
  struct Functional {
    Rational a;
    Rational b;
    Rational c;
    Rational at(const Rational& u, const Rational& v) const { return a * u + b * v + c; }
  };
  std::array<Rational, 3> weights(const Rational& u, const Rational& v) const;
  Functional combined(const std::array<Rational, 3>& factors) const;
  bool owns_zero(const Functional& functional) const;
  Rational in_range(const Rational& z) const;
  Rational clamped_to_range(const Rational& depth) const;
  Rational offset() const;
  bool is_in_viewport(const Rational& u, const Rational& v) const;

  const State& state_;
  std::array<std::vector<Rational>, 3> attributes_;
  std::array<std::vector<Rational>, 3> distances_;
  std::array<Rational, 3> z_;
  std::array<Rational, 3> w_;
  Rational determinant_;
  std::array<Functional, 3> e_;
};

/// The positions of a pixel's samples, relative to the pixel's corner with the least u and v.
std::vector<std::array<Rational, 2>> brute_force_pattern(int samples);

}  // namespace rastercheck::rasterizer
