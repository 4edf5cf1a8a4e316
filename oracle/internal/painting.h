#pragma once

// The numbers that a picture's target may hold after a triangle has been drawn over the background
// (RULES §12), before they are stored.
//
// For a fragment of colour c and alpha a, the source is s = c a in premultiplied pictures and with
// Blend::over, else s = c. The target holds d: the stored background, decoded if it is sRGB.
//
//   off: s        over: s + (1 − a) d, and for alpha itself a + (1 − a) d        additive: s + d
//
// Before blending into integers, the numbers that a program outputs are clamped to [0, 1] (OpenGL
// 4.6, §17.3.6): a, and c in straight pictures, but the product c a, not its factor c, in
// premultiplied ones.
//
// Ranges. Each formula is linear in each of c, a and d, so its extremes are at ends of the ranges.
//
// Roundings. Without blending, a program rounds the product at most once, to float32, so the range
// is widened to its rounded ends. With blending, u = 2^-24 and up to first order, a s + (1 − a) d
// in float32 rounds the source's term twice (product, sum) and the target's five times (k/255 as a
// product with a rounded reciprocal, 1 − a, product, sum). The form d + a (s − d) rounds |a| |s|
// three times, and |d| five times and |a| |d| five times. So the error is at most
//
//   5 u m < 2^-21 m,   m = |a| |s| + (1 + |a|) |d|,
//
// for any fusing of products and sums, and 2^-150 more for each of up to three products below the
// normal numbers. Decoding sRGB in float32 has a relative error below 2^-19: the exponent 2.4 turns
// the six roundings of the base into 14.4 u, and the power itself is within two ULP, 4 u; 18.4 u in
// all. A program that blends with fewer bits than float32 may be called wrong.

#include <vector>

#include "cases/picture_view.h"
#include "oracle/picture_truth.h"

namespace rastercheck::oracle {

/// The range that contains only this number.
ValueSpan exactly(double number);

/// The numbers that a program may compute for a product, with one rounding or none.
ValueSpan product_of(const ValueSpan& a, const ValueSpan& b);

/// The weighted sum of a source (the drawn colour) and the number that the target holds.
struct Mixture {
  ValueSpan source;
  ValueSpan alpha;
  ValueSpan held;
  bool multiplies = true;  ///< the source is multiplied by alpha
  bool covers = true;      ///< `held` is multiplied by 1 − alpha
};
/// The numbers that a program may compute for this sum.
ValueSpan mixed(const Mixture& mixture);

class Painting {
 public:
  /// The view must outlive the object.
  explicit Painting(const cases::PictureView& view);

  /// The background of a channel, before it is stored.
  const ValueSpan& background(std::size_t channel) const { return background_[channel]; }
  /// The numbers of a channel after drawing a fragment with this alpha that shows `shown` in the
  /// channel. `alpha` is used only if needs_alpha().
  ValueSpan painted(std::size_t channel, const ValueSpan& shown, const ValueSpan& alpha) const;
  bool needs_alpha(std::size_t channel) const;

 private:
  ValueSpan held_in(std::size_t channel) const;
  ValueSpan blended(std::size_t channel, const ValueSpan& shown, const ValueSpan& alpha) const;

  const cases::PictureView* view_;
  std::vector<ValueSpan> background_;  ///< [channel]
  std::vector<ValueSpan> held_;        ///< [channel]: the background as the target holds it
};

}  // namespace rastercheck::oracle
