#pragma once

// The numbers that a picture's target may hold after a triangle has been drawn over the background
// (RULES §12), before they are stored.
//
// With a fragment's colour c and alpha a, premultiplied targets take s = c a, straight ones s = c.
// Integer targets without blending clamp s as they store it.
//
// Ranges. The products and sums are linear in each of their numbers, so over ranges they attain
// their ends at corners. A program computes c a in float32, whose rounding is monotone: the range
// is joined with its rounded ends.

#include <vector>

#include "cases/picture_view.h"
#include "oracle/picture_truth.h"

namespace rastercheck::oracle {

/// The one number, as a range.
ValueSpan exactly(double number);

/// The numbers that a program may compute for a product, with one rounding or none.
ValueSpan product_of(const ValueSpan& a, const ValueSpan& b);

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
  const cases::PictureView* view_;
  std::vector<ValueSpan> background_;  ///< [channel]
};

}  // namespace rastercheck::oracle
