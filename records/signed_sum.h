#pragma once

// The sum of signed errors, for their mean. The sum is certified, and independent of the order of
// terms because integers add exactly.

#include <cstdint>
#include <optional>

#include "records/enclosure.h"

namespace rastercheck::records {

class SignedSum {
 public:
  /// Sums count in 2^-32 of the errors' unit, rounded outwards.
  static constexpr double kUnit = 0x1p-32;
  /// The largest magnitude that is summed: 2^40, the last border of a Histogram. Errors that may be
  /// larger are counted in beyond() instead, and then mean() is empty.
  static constexpr double kMost = 0x1p40;
  /// Holds the sum of kMostTerms terms: 2^(40 + 32 + 54) < 2^127.
  __extension__ using Units = __int128;
  static constexpr std::uint64_t kMostTerms = std::uint64_t{1} << 54;
  /// Upper bound of one term, in units.
  static constexpr Units kMostOfTerm = Units{1} << 72;

  SignedSum() = default;
  SignedSum(Units lo, Units hi, std::uint64_t count, std::uint64_t beyond)
      : lo_(lo), hi_(hi), count_(count), beyond_(beyond) {}

  /// Adds one error.
  void add(const Enclosure& error);
  /// Adds `count` errors whose sum is lo … hi units.
  void add(Units lo, Units hi, std::uint64_t count);
  void merge(const SignedSum& other);

  Units lo() const { return lo_; }
  Units hi() const { return hi_; }
  std::uint64_t count() const { return count_; }
  std::uint64_t beyond() const { return beyond_; }

  /// The mean of all errors; empty without errors, or if some were too large to be summed.
  std::optional<Enclosure> mean() const;

  bool operator==(const SignedSum&) const = default;

 private:
  Units lo_ = 0;
  Units hi_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t beyond_ = 0;
};

}  // namespace rastercheck::records
