#include "records/histogram.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace rastercheck::records {
namespace {

/// 2^(k/8), k = 0…7, by square roots, which IEEE 754 rounds correctly: 2^(1/2) = √2, 2^(1/4) =
/// √2^(1/2), 2^(3/4) = √(2·2^(1/2)), and the odd eighths in the same way from 2^(1/4) and 2^(3/4).
/// A root halves the relative error of its argument, so less than one unit in the last place
/// remains.
constexpr std::array<double, Histogram::kBucketsPerOctave> kEighthPowers{
    1.0,
    0x1.172b83c7d517bp+0,  // √2^(1/4)
    0x1.306fe0a31b715p+0,  // √2^(1/2)
    0x1.4bfdad5362a27p+0,  // √2^(3/4)
    0x1.6a09e667f3bcdp+0,  // √2
    0x1.8ace5422aa0dbp+0,  // √(2·2^(1/4))
    0x1.ae89f995ad3aep+0,  // √(2·2^(1/2))
    0x1.d5818dcfba487p+0,  // √(2·2^(3/4))
};

using Borders = std::array<double, Histogram::kBorderCount>;

constexpr Borders make_borders() {
  double octave = 1;  // the power of two that the next eight borders are multiples of
  for (int i = 0; i > Histogram::kLeastExponent; --i) octave /= 2;
  Borders borders{};
  for (std::size_t k = 0; k < borders.size(); ++k) {
    borders[k] = octave * kEighthPowers[k % kEighthPowers.size()];
    if (k % kEighthPowers.size() == kEighthPowers.size() - 1) octave *= 2;
  }
  return borders;
}

constexpr Borders kMadeBorders = make_borders();
static_assert(kMadeBorders.front() == 0x1p-20 && kMadeBorders.back() == 0x1p40);
static_assert(std::is_sorted(kMadeBorders.begin(), kMadeBorders.end()));

/// ceil(p·count), limited to 1 … `count`; `count` must not be 0.
std::uint64_t rank_of(double p, std::uint64_t count) {
  const double rank = std::ceil(p * static_cast<double>(count));
  if (!(rank >= 1)) return 1;
  // A count beyond 2^53 may be rounded up when it becomes a double.
  if (rank >= static_cast<double>(count)) return count;
  return static_cast<std::uint64_t>(rank);
}

}  // namespace

constexpr Borders Histogram::kBorders = kMadeBorders;

Enclosure Histogram::borders(std::size_t bucket) {
  assert(bucket < kBucketCount);
  if (bucket == kZeroBucket) return {0, 0};
  return {bucket == 1 ? 0 : kBorders[bucket - 2], bucket == kOverflowBucket
                                                      ? std::numeric_limits<double>::infinity()
                                                      : kBorders[bucket - 1]};
}

void Histogram::add(double magnitude) {
  if (std::isfinite(magnitude)) {
    ++counts_[bucket_of(magnitude)];
  } else {
    ++non_finite_;
  }
}

void Histogram::add_non_finite(std::uint64_t times) { non_finite_ += times; }

void Histogram::merge(const Histogram& other) {
  for (std::size_t i = 0; i < kBucketCount; ++i) counts_[i] += other.counts_[i];
  non_finite_ += other.non_finite_;
}

std::uint64_t Histogram::count() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

std::uint64_t Histogram::count_above(double border) const {
  const std::size_t bucket = bucket_of(border);
  assert(borders(bucket).hi == border);
  const auto above = counts_.begin() + static_cast<std::ptrdiff_t>(bucket) + 1;
  return std::accumulate(above, counts_.end(), non_finite_);
}

std::optional<Enclosure> Histogram::quantile(double p) const {
  const std::uint64_t total = count();
  if (total == 0) return std::nullopt;
  const std::uint64_t rank = rank_of(p, total);
  std::uint64_t up_to_here = 0;
  for (std::size_t bucket = 0; bucket < kBucketCount; ++bucket) {
    up_to_here += counts_[bucket];
    if (up_to_here >= rank) return borders(bucket);
  }
  return borders(kOverflowBucket);
}

double magnitude_bound(const Enclosure& enclosure) {
  return std::max(std::abs(enclosure.lo), std::abs(enclosure.hi));
}

}  // namespace rastercheck::records
