#pragma once

// Counts errors by size. The buckets are the same in every histogram, so that any two merge by
// adding counts, exactly and in any order.
//
// Borders. With b_k = 2^(k/8 - 20), k = 0…480, eight to an octave from 2^-20 to 2^40:
//
//   bucket 0       exactly 0
//   bucket 1       0 < m <= b_0
//   bucket 1 + k   b_(k-1) < m <= b_k      k = 1…480
//   bucket 482     b_480 < m
//
// and a separate count of non-finite values. A border that is not a power of two is a double
// obtained by chains of correctly rounded square roots, within one unit in the last place of the
// true border. A table holds the eight borders of one octave; all others are these times a power of
// two, which is exact. No library pow or log is used, so the borders are the same on all machines.
//
// A bucket includes its upper border, not its lower one, so that for correctly rounded values the
// quantiles end at 1/2 ULP, as the errors do. This also makes counting exact: because borders are
// doubles, a magnitude and the least double not below it lie in the same bucket.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "records/enclosure.h"

namespace rastercheck::records {

/// A histogram of magnitudes |error|, in the unit that its owner names (ULP for floats).
class Histogram {
 public:
  static constexpr int kBucketsPerOctave = 8;
  static constexpr int kLeastExponent = -20;    ///< b_0 = 2^kLeastExponent
  static constexpr int kGreatestExponent = 40;  ///< the last border is 2^kGreatestExponent
  static constexpr std::size_t kBorderCount =
      1 + std::size_t{kBucketsPerOctave} * (kGreatestExponent - kLeastExponent);
  static constexpr std::size_t kZeroBucket = 0;
  static constexpr std::size_t kOverflowBucket = 1 + kBorderCount;
  static constexpr std::size_t kBucketCount = kOverflowBucket + 1;

  /// For the steps used by bucket_of: the number of a double's bits below a step's bits, and the
  /// step that begins at 2^kLeastExponent.
  static constexpr int kBitsBelowStep = std::numeric_limits<double>::digits - 1 - 3;
  static constexpr std::uint64_t kFirstStep =
      std::bit_cast<std::uint64_t>(0x1p-20) >> kBitsBelowStep;
  static_assert(kLeastExponent == -20 && kBucketsPerOctave == 8);
  /// Points to b_0; the other borders follow.
  static const double* borders_begin() { return kBorders.data(); }

  /// The bucket of a finite magnitude; its sign is ignored.
  static std::size_t bucket_of(double magnitude) {
    const double size = std::abs(magnitude);
    if (size == 0) return kZeroBucket;
    if (size <= kBorders.front()) return 1;
    if (size > kBorders.back()) return kOverflowBucket;
    // The exponent and the first three bits of the fraction cut each octave into eight equal steps,
    // which exclude their lower ends. As 2^(i/8) <= 1 + i/8 <= 2^((i+1)/8) for i = 0…8, step i
    // reaches from bucket i of the octave at most into the next, so a comparison with the border
    // between these two buckets decides.
    const std::uint64_t from_zero = (std::bit_cast<std::uint64_t>(size) - 1) >> kBitsBelowStep;
    const auto step = static_cast<std::size_t>(from_zero - kFirstStep);
    return size <= kBorders[step + 1] ? step + 2 : step + 3;
  }
  /// True if two magnitudes share a bucket. Needs less <= more.
  static bool share_bucket(double less, double more) {
    const std::size_t bucket = bucket_of(more);
    return bucket < 2 ? less == more || (bucket == 1 && less > 0) : less > kBorders[bucket - 2];
  }
  /// A bucket's borders. Magnitudes in the bucket are at most `hi` and, except in the zero bucket,
  /// above `lo`; `hi` of the overflow bucket is infinite.
  static Enclosure borders(std::size_t bucket);

  /// Counts one magnitude, given exactly or rounded up (magnitude_bound of an error's enclosure);
  /// its sign is ignored. NaN and infinities go to non_finite().
  void add(double magnitude);
  /// Adds `times` magnitudes to a bucket (below kBucketCount), or to the non-finite count.
  void add_to_bucket(std::size_t bucket, std::uint64_t times) { counts_[bucket] += times; }
  void add_non_finite(std::uint64_t times);

  /// Adds the counts of the other histogram.
  void merge(const Histogram& other);

  /// How many finite magnitudes were counted.
  std::uint64_t count() const;
  std::uint64_t count_in(std::size_t bucket) const { return counts_[bucket]; }
  /// Number of counted non-finite magnitudes. Quantiles ignore these, because they have no size.
  std::uint64_t non_finite() const { return non_finite_; }
  /// Number of magnitudes above `border`, which must be 0 or a bucket's upper border. Exact,
  /// because no bucket lies on both sides of the border. Includes non-finite magnitudes, which are
  /// not known to be at most the border.
  std::uint64_t count_above(double border) const;

  /// The borders of the bucket that holds the p-quantile of the finite magnitudes; [0, 0] if the
  /// quantile is 0; empty if no finite magnitude was counted. p is in [0, 1]; 1 asks for the
  /// largest. The p-quantile is the magnitude of rank max(1, ceil(p·count())), with the product
  /// rounded to double: the least magnitude that a share p of all magnitudes does not exceed.
  std::optional<Enclosure> quantile(double p) const;

  bool operator==(const Histogram&) const = default;

 private:
  static const std::array<double, kBorderCount> kBorders;

  std::array<std::uint64_t, kBucketCount> counts_{};
  std::uint64_t non_finite_ = 0;
};

/// The least double known to be at least |x| for the enclosed x: the argument for Histogram::add.
double magnitude_bound(const Enclosure& enclosure);

}  // namespace rastercheck::records
