#pragma once

// Random floats over the full range, beyond everyday drawing: all finite bit patterns, the smallest
// and the largest, short mantissas, neighbours of a number. Draw::spread makes floats with chosen
// exponents.

#include "properties/draw.h"

namespace rastercheck::properties {

/// Any finite float32, all bit patterns equally likely.
float float_by_bits(Draw& draw);
/// ±0.
float any_zero(Draw& draw);
/// A nonzero float of magnitude below 2^-126; short mantissas are as likely as long ones.
float subnormal_float(Draw& draw);
/// A float of magnitude at least 2^120; the largest finite float is especially likely.
float huge_float(Draw& draw);
/// A multiple of 2^-bits within ±most, both ends included; most · 2^bits is at most 2^24.
float dyadic_float(Draw& draw, int most, int bits);
/// A float at most 2^most_exponent floats from `target` on either side; the target and its
/// neighbours are as likely as far ones. 0 <= most_exponent <= 23; at 23 the result may be twice
/// the target.
float float_near(Draw& draw, float target, int most_exponent);
/// `value` moved by at most one float: up, down and unchanged are equally likely.
float nudged(Draw& draw, float value);

/// A float from any of the above.
float any_float(Draw& draw);

}  // namespace rastercheck::properties
