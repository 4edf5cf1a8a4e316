#pragma once

// The float32 numbers that a program may store as a given value (RULES §12). Exact, so that a
// picture's value is wrong only if no permitted number is stored as it.
//
// Nearest, to n-bit unsigned normalized integers: a program computes f (2^n − 1), adds one half and
// truncates, or rounds, in float32 or better. Two roundings, each of at most 2^-24 (k + 1), may
// take a number on one side of the middle between two codes to the other, so f may be stored as k
// if
//
//   |f (2^n − 1) − k| <= 1/2 + 2^-23 (k + 1).
//
// For srgb8, the same holds of the encoded number; its power, product and difference add six
// roundings, 2^-21 (k + 1) in all. The transfer function (IEC 61966-2-1:1999) is inverted exactly:
//
//   e <= 0.04045: f = e/12.92,    else    f^5 = ((e + 0.055)/1.055)^12.
//
// Nearest, to float16: the nearest float16, or either one if the number is midway between two.
// Numbers beyond 65520 are stored as infinity. Either: any number strictly between both neighbours.

#include <optional>

#include "cases/coverage.h"
#include "cases/picture_layout.h"
#include "oracle/rational.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// The numbers from `least` to `greatest`, inclusive; the ends may be infinite.
struct StoredNumbers {
  float least = 0;
  float greatest = 0;
};

/// The numbers that may be stored as `value`: a number itself or, for unorm and srgb8, the integer
/// k. Empty for NaN and for values that the storage does not have.
std::optional<StoredNumbers> numbers_stored_as(cases::Storage storage,
                                               cases::StoreRounding rounding, float value);

/// The least and the greatest value that some number of a range may be stored as; the range must
/// not be empty. Values are as in numbers_stored_as().
StoredNumbers values_stored_of(cases::Storage storage, cases::StoreRounding rounding,
                               const records::Enclosure& range);

/// A depth as a buffer stores it: the nearest float32 or, in a unorm format of n bits, the float32
/// nearest to k/(2^n − 1), where k is the nearest integer, the greater of two.
float stored_depth(const Rational& depth, cases::DepthFormat format);

/// The number that a stored value stands for, in doubles: k/255, and for srgb8 the decoded number
/// within 2^-48 of itself.
double number_of_stored(cases::Storage storage, float value);

/// The stored value that one more step leads to, towards `up` or down; the value itself at the
/// storage's end.
float next_stored(cases::Storage storage, float value, bool up);

/// The signed distance from one stored value to another, in steps of the storage (next_stored()).
double steps_between(cases::Storage storage, float from, float to);

}  // namespace rastercheck::oracle
