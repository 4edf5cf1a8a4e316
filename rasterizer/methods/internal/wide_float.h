#pragma once

// The arithmetic of float32 (24 bits of significand, rounding to nearest) without the limits of
// its exponent. For methods whose products of clip coordinates may exceed 2^128 or fall below
// 2^-126.
//
// Results are computed in double and rounded once more. This double rounding equals a single one
// for +, −, × and ÷, because 53 >= 2 · 24 + 2. A result overflows or underflows only if it does so
// in double. If no float32 operation would overflow or underflow either, the bits are those of
// float.

#include <bit>
#include <cstdint>

namespace rastercheck::rasterizer {

class WideFloat {
 public:
  WideFloat() = default;
  explicit WideFloat(double value) : value_(rounded(value)) {}
  explicit operator double() const { return value_; }

  friend WideFloat operator+(WideFloat a, WideFloat b) { return WideFloat(a.value_ + b.value_); }
  friend WideFloat operator-(WideFloat a, WideFloat b) { return WideFloat(a.value_ - b.value_); }
  friend WideFloat operator*(WideFloat a, WideFloat b) { return WideFloat(a.value_ * b.value_); }
  friend WideFloat operator/(WideFloat a, WideFloat b) { return WideFloat(a.value_ / b.value_); }
  friend WideFloat operator-(WideFloat a) { return WideFloat(-a.value_); }
  friend bool operator<(WideFloat a, WideFloat b) { return a.value_ < b.value_; }

 private:
  /// Rounds to 24 bits, ties to even. A carry into the exponent is correct. Infinities, and the NaN
  /// that arithmetic produces, are unchanged.
  static double rounded(double value) {
    constexpr int kDropped = 53 - 24;
    constexpr std::uint64_t kHalf = std::uint64_t{1} << (kDropped - 1);
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const std::uint64_t is_odd = bits >> kDropped & 1;
    const std::uint64_t sum = bits + (kHalf - 1 + is_odd);
    return std::bit_cast<double>(sum >> kDropped << kDropped);
  }

  double value_ = 0;
};

}  // namespace rastercheck::rasterizer
