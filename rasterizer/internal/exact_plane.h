#pragma once

// Serves lines and points (primitive_drawing.h).
//
// Affine functions of the window whose coefficients are sums without rounding. They are evaluated
// in double first; where double cannot decide, without rounding.
//
//   f = a (2u) + b (2v) + c
//
// Twice a sample's position is a multiple of 1/8 and below 2^15, and so exact. With u = 2^-53, a
// coefficient's nearest double has a relative error of 2u, a product and each of the two sums one
// of u: so f is off by at most 8u (|a 2u| + |b 2v| + |c|), with some to spare.

#include <array>
#include <cmath>

#include "rasterizer/internal/exact_sum.h"

namespace rastercheck::rasterizer {

/// A window position in half pixels: (2u, 2v).
using HalfPixels = std::array<double, 2>;

/// A value in double, at most `error` from the exact one.
struct NearValue {
  double value = 0;
  double error = 0;

  bool has_sign() const { return std::abs(value) > error; }
};

class ExactPlane {
 public:
  ExactPlane() = default;
  ExactPlane(const ExactSum& a, const ExactSum& b, const ExactSum& c) : coefficients_{a, b, c} {
    for (std::size_t i = 0; i < 3; ++i) near_[i] = coefficients_[i].nearest();
  }

  NearValue near(const HalfPixels& p) const {
    const double along = near_[0] * p[0];
    const double across = near_[1] * p[1];
    constexpr double kError = 0x1p-50;
    return {along + across + near_[2],
            kError * (std::abs(along) + std::abs(across) + std::abs(near_[2]))};
  }
  ExactSum exact(const HalfPixels& p) const {
    ExactSum sum = coefficients_[2];
    sum.add_product(coefficients_[0], p[0]);
    sum.add_product(coefficients_[1], p[1]);
    return sum;
  }
  /// The sign of the exact value.
  int sign(const HalfPixels& p) const {
    const NearValue value = near(p);
    if (value.has_sign()) return value.value > 0 ? 1 : -1;
    return exact(p).sign();
  }
  /// a, b and c.
  const std::array<ExactSum, 3>& coefficients() const { return coefficients_; }
  const std::array<double, 3>& near_coefficients() const { return near_; }

 private:
  std::array<ExactSum, 3> coefficients_;
  std::array<double, 3> near_{};
};

/// Returns k_0 f_0 + k_1 f_1.
inline ExactPlane combine(const std::array<ExactPlane, 2>& planes, const std::array<double, 2>& k) {
  std::array<ExactSum, 3> sums;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      sums[i].add_product(planes[end].coefficients()[i], k[end]);
    }
  }
  return {sums[0], sums[1], sums[2]};
}

}  // namespace rastercheck::rasterizer
