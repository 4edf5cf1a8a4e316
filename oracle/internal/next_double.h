#pragma once

// std::nextafter() towards an infinity, inline: ranges of values take four for each sample.

#include <bit>
#include <cstdint>
#include <limits>

namespace rastercheck::oracle {

/// The least double above x; x itself if it is +infinity or NaN.
inline double next_above(double x) {
  if (!(x < std::numeric_limits<double>::infinity())) return x;
  if (x == 0) return std::numeric_limits<double>::denorm_min();
  // As integers, doubles of one sign are in the order of their magnitudes.
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return std::bit_cast<double>(x > 0 ? bits + 1 : bits - 1);
}

/// The greatest double below x; x itself if it is -infinity or NaN.
inline double next_below(double x) { return -next_above(-x); }

}  // namespace rastercheck::oracle
