#pragma once

// Serves lines and points (primitive_drawing.h).
//
// Depth and attributes of lines and points, rounded once (RULES §9, §10). With the weights E_a and
// E_b of a line's ends (line_shape.h), which are those of a triangle whose third vertex has none,
//
//   smooth         r = Σ r_k E_k / Σ E_k
//   noperspective  r = Σ r_k w_k E_k / K        K = Σ w_k E_k, the same everywhere
//   depth          z = Σ z_k E_k / K, then low + span · z (DepthRange)
//
// Numerators and denominators are affine functions of the window. Their quotient in double is taken
// if the denominator is at least 2^32 times its error (exact_plane.h), the numerator's error at
// most 2^-32 times max|r_k| times the denominator, and neither weight is within its error of 0.
// With |r| <= max|r_k| between the ends, the quotient is then off by less than 2^-31 max|r_k|,
// which is what kValueBound allows. Else both are summed without rounding and divided once, as
// beyond the ends of Bresenham's lines: a relative error of 2^-50. At an end, where the other
// weight is 0, the sums give the end's value unchanged.
//
// Of the vertices' values, equal zeros, values that are not finite and planes of equal depth are
// treated as a triangle's (exact_values.h). All values of a point are its vertex's.

#include <array>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/line_shape.h"

namespace rastercheck::rasterizer {

/// A quotient of two affine functions of the window; or a copied value.
struct PrimitiveValue {
  enum class Kind { copied, smooth, affine };
  Kind kind = Kind::copied;
  float copy = 0;  ///< of a smooth value: where it is undefined, 1/w being 0 or less
  ExactPlane numerator;
  double greatest = 0;  ///< max|r_k|
};

class PrimitiveValues {
 public:
  /// Prepares the values of a line. `weights`: of the columns that values belong to. If those are
  /// snapped, `is_snapped` is true: their w is 1, and the vertices' own w enter here.
  void set_line(const State& state, const InputTriangle& line, const LineWeights& weights,
                bool is_snapped);
  /// Prepares the values of a point.
  void set_point(const State& state, const InputTriangle& point);

  /// The depth as stored.
  float depth(const HalfPixels& p) const;
  /// The value of an attribute before rounding to float32.
  double attribute(std::size_t index, const HalfPixels& p) const;
  /// ∂r/∂u and ∂r/∂v of an attribute, per pixel. They come from quotients that are rounded to
  /// double, and so are off by some 2^-50 of the terms whose difference they are.
  WideSlopes slopes(std::size_t index, const HalfPixels& p) const;
  /// exact_floor() of `scale` times an attribute.
  double floor(std::size_t index, const HalfPixels& p, double scale, double period) const;
  /// 1/w. Of a point, that of its vertex.
  double reciprocal_w(const HalfPixels& p) const;

 private:
  void set_attribute(const State& state, const InputTriangle& line, std::size_t index);
  void set_depth(const State& state, const InputTriangle& line);
  ExactSum denominator(const PrimitiveValue& value, const HalfPixels& p) const;
  double quotient(const PrimitiveValue& value, const HalfPixels& p) const;
  bool is_between_ends(const HalfPixels& p) const;

  std::array<ExactPlane, 2> e_;  ///< in clip space, whatever the columns
  ExactPlane sum_;               ///< Σ E_k
  ExactSum constant_;            ///< K
  double near_constant_ = 0;
  double reciprocal_w_ = 0;  ///< of a point
  bool is_point_ = false;
  std::vector<PrimitiveValue> attributes_;
  DepthRange range_;
  PrimitiveValue depth_;  ///< z; low + span · z if copied
  double level_depth_ = 0;
};

}  // namespace rastercheck::rasterizer
