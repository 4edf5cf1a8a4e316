#pragma once

// Floats as numbers of any size, not as what everyday drawing has: all finite bit patterns, the
// smallest and the largest, short mantissas, the neighbours of a number. Draw::spread has those of
// chosen exponents.

#include "properties/draw.h"

namespace rastercheck::properties {

/// Any finite float32, all bit patterns equally likely: so are all exponents, and both signs.
float float_by_bits(Draw& draw);
/// ±0.
float any_zero(Draw& draw);
/// ± one of the floats below 2^-126, short ones as likely as long ones; not 0.
float subnormal_float(Draw& draw);
/// ± a float of at least 2^120, the largest one more often.
float huge_float(Draw& draw);
/// A multiple of 2^-bits within ±most, both ends included; most · 2^bits is at most 2^24.
float dyadic_float(Draw& draw, int most, int bits);
/// A float up to 2^most_exponent floats from `target` on either side, as often the target itself
/// and its neighbours as far ones; 0 <= most_exponent <= 23, with which it is up to twice as large.
float float_near(Draw& draw, float target, int most_exponent);
/// `value` moved by at most one float, as often up as down as not at all.
float nudged(Draw& draw, float value);

/// Any of these.
float any_float(Draw& draw);

}  // namespace rastercheck::properties
