#pragma once

// The sum of signed errors, for their mean: a certified one that does not depend on the order of
// its terms, as whole numbers add exactly.

#include <cstdint>
#include <optional>

#include "records/enclosure.h"

namespace rastercheck::records {

class SignedSum {
 public:
  /// Sums count in 2^-32 of the errors' unit, rounded outwards.
  static constexpr double kUnit = 0x1p-32;
  /// The largest magnitude that is summed, that of the last border of a Histogram: 2^40. What may
  /// be larger is counted in beyond(), and then there is no mean to speak of.
  static constexpr double kMost = 0x1p40;
  /// Holds kMostTerms: 2^(40 + 32 + 54) < 2^127.
  __extension__ using Units = __int128;
  static constexpr std::uint64_t kMostTerms = std::uint64_t{1} << 54;
  /// What one term is at most, in units.
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

  /// The mean of all errors; nothing of none, or where some were too large to be summed.
  std::optional<Enclosure> mean() const;

  bool operator==(const SignedSum&) const = default;

 private:
  Units lo_ = 0;
  Units hi_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t beyond_ = 0;
};

}  // namespace rastercheck::records
