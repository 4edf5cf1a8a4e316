#pragma once

// Sums of doubles without rounding, for what double precision leaves in doubt (J. R. Shewchuk,
// Adaptive Precision Floating-Point Arithmetic, 1997).
//
// A sum is kept as an expansion: doubles that do not overlap, in ascending order, whose exact sum
// is its value. Nothing here over- or underflows as long as all products of two arguments, and the
// lowest bits of these, are within 2^-1022 … 2^1023; the callers say why theirs are. All must be
// finite: an infinity or a NaN would leave more components than there is room for. Flush-to-zero
// must be off.

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

  /// −1, 0 or 1.
  int sign() const {
    if (size_ == 0) return 0;
    return components_[size_ - 1] > 0 ? 1 : -1;
  }

  /// The value with a relative error below 2^-52.
  double nearest() {
    compress();
    return size_ == 0 ? 0 : components_[size_ - 1];
  }

  std::span<const double> components() const { return {components_.data(), size_}; }

 private:
  /// Shewchuk's COMPRESS: as few components as there can be; the last is the value but for less
  /// than its unit in the last place. At most 41 are left, as no two have a bit in common among the
  /// 2,098 places of a double and each but the last is full.
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
