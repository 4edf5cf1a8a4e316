#pragma once

// The arithmetic of float32, 24 bits of significand and rounding to nearest, without the limits of
// its exponent: what a method makes of that precision where products of clip coordinates are beyond
// 2^128 or below 2^-126.
//
// Results are computed in double and rounded once more. That second rounding is as good as one
// alone for +, −, × and ÷, because 53 >= 2 · 24 + 2. Nothing over- or underflows as long as nothing
// does in double; where nothing does in float32 either, the bits are those of float.

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
  /// To 24 bits, ties to even. A carry runs into the exponent, as it should; infinities and the NaN
  /// that arithmetic makes stay what they are.
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
