#pragma once

// The numbers that a picture's target may hold after a triangle has been drawn over the background
// (RULES §12), before they are stored.
//
// With a fragment's colour c and alpha a, premultiplied pictures take s = c a, straight ones s = c
// or, blended over, c a. The target holds d: the background as it is stored, decoded if it is sRGB.
//
//   off: s        over: s + (1 − a) d, and for alpha itself a + (1 − a) d        additive: s + d
//
// If drawing blends into integers, c, s and a are clamped to [0, 1] before (OpenGL 4.6, §17.3.6).
//
// Ranges. All this is linear in each of c, a and d, so over ranges it has its ends at corners.
//
// Roundings. A program rounds a product that it does not blend once, to float32: the range is
// joined with its rounded ends. Blended, with u = 2^-24 and up to first order, a s + (1 − a) d in
// float32 rounds the source's term twice (product, sum) and the target's five times (k/255 as a
// product with a rounded reciprocal, 1 − a, product, sum). The form d + a (s − d) rounds |a| |s|
// three times, and |d| five times and |a| |d| five times. So the error is at most
//
//   5 u m < 2^-21 m,   m = |a| |s| + (1 + |a|) |d|,
//
// for any fusing of products and sums, and 2^-150 more for each of up to three products below the
// normal numbers. Decoding sRGB in float32 has a relative error below 2^-19: six roundings of the
// power's base count 2.4 times, and the power itself is within two ULP, 4 u; 18.4 u in all. A
// target that is blended with fewer bits than float32's is not held to be right.

#include <vector>

#include "cases/picture_view.h"
#include "oracle/picture_truth.h"

namespace rastercheck::oracle {

/// The one number, as a range.
ValueSpan exactly(double number);

/// The numbers that a program may compute for a product, with one rounding or none.
ValueSpan product_of(const ValueSpan& a, const ValueSpan& b);

/// A sum of what is drawn and what the target holds.
struct Mixture {
  ValueSpan source;
  ValueSpan alpha;
  ValueSpan held;
  bool multiplies = true;  ///< the source counts alpha times
  bool covers = true;      ///< what is held counts (1 − alpha) times
};
/// The numbers that a program may compute for it.
ValueSpan mixed(const Mixture& mixture);

class Painting {
 public:
  /// The view must outlive the object.
  explicit Painting(const cases::PictureView& view);

  /// The background of a channel.
  const ValueSpan& background(std::size_t channel) const { return background_[channel]; }
  /// A channel after drawing a fragment that shows `shown` in it, and this alpha. Alpha counts only
  /// if needs_alpha().
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
