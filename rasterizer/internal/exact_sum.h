#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Sums of doubles without rounding, for cases that double precision cannot decide (J. R. Shewchuk,
// Adaptive Precision Floating-Point Arithmetic, 1997).
//
// A sum is kept as an expansion: doubles that do not overlap, in ascending order of magnitude,
// whose exact sum is the value. No over- or underflow occurs if all products of two arguments, and
// the products' lowest bits, are within 2^-1022 … 2^1023; callers must ensure this. All arguments
// must be finite: an infinity or a NaN would leave more components than there is room for.
// Flush-to-zero must be off.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace rastercheck::rasterizer {

/// sum + error = a + b, exactly (Knuth).
struct TwoSum {
  TwoSum(double a, double b) : sum(a + b) {
    const double b_shadow = sum - a;
    error = (a - (sum - b_shadow)) + (b - b_shadow);
  }
  double sum;
  double error = 0;
};

class ExactSum {
 public:
  void add(double value) {
    if (size_ == kCapacity) compress();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {  // GROW-EXPANSION, without zeros
      const TwoSum next(value, components_[i]);
      value = next.sum;
      if (next.error != 0) components_[kept++] = next.error;
    }
    if (value != 0) components_[kept++] = value;
    size_ = kept;
  }

  void add_product(double a, double b) {
    const double high = a * b;
    if (high == 0) return;
    add(std::fma(a, b, -high));
    add(high);
  }

  /// Adds `factor` times another sum.
  void add_product(const ExactSum& sum, double factor) {
    for (const double component : sum.components()) add_product(component, factor);
  }
  void add_product(const ExactSum& a, const ExactSum& b) {
    for (const double component : b.components()) add_product(a, component);
  }

  /// Returns the sign: −1, 0 or 1.
  int sign() const {
    if (size_ == 0) return 0;
    return components_[size_ - 1] > 0 ? 1 : -1;
  }

  /// Returns the value with a relative error below 2^-52.
  double nearest() {
    compress();
    return size_ == 0 ? 0 : components_[size_ - 1];
  }

  std::span<const double> components() const { return {components_.data(), size_}; }

 private:
  /// Shewchuk's COMPRESS: minimizes the number of components. The last component then differs from
  /// the value by less than a unit in its last place. At most 41 components are left, because no
  /// two share a bit among the 2,098 places of a double and each except the last is full.
  void compress() {
    if (size_ < 2) return;
    std::array<double, kCapacity> from_the_top{};
    std::size_t count = 0;
    double carried = components_[size_ - 1];
    for (std::size_t i = size_ - 1; i-- > 0;) {
      const TwoSum next(carried, components_[i]);
      carried = next.sum;
      if (next.error != 0) {
        from_the_top[count++] = next.sum;
        carried = next.error;
      }
    }
    from_the_top[count++] = carried;
    size_ = 0;
    carried = from_the_top[count - 1];
    for (std::size_t i = count - 1; i-- > 0;) {
      const TwoSum next(from_the_top[i], carried);
      carried = next.sum;
      if (next.error != 0) components_[size_++] = next.error;
    }
    if (carried != 0) components_[size_++] = carried;
  }

  static constexpr std::size_t kCapacity = 128;
  std::array<double, kCapacity> components_;
  std::size_t size_ = 0;
};

}  // namespace rastercheck::rasterizer
