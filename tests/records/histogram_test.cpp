#include "records/histogram.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/records/random_record.h"

namespace rastercheck::records::histogram_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

Histogram histogram_of(const std::vector<double>& magnitudes) {
  Histogram histogram;
  for (const double magnitude : magnitudes) histogram.add(magnitude);
  return histogram;
}

/// Zeros, borders, neighbours of borders, and numbers of all sizes within and beyond the borders.
double random_magnitude() {
  const auto bucket = *rc::gen::inRange<std::size_t>(1, Histogram::kOverflowBucket);
  const double border = Histogram::borders(bucket).hi;
  switch (*rc::gen::inRange(0, 6)) {
    case 0:
      return 0;
    case 1:
      return border;
    case 2:
      return std::nextafter(border, 0);
    case 3:
      return std::nextafter(border, kInfinity);
    case 4:
      return std::abs(any_finite_double());
    default:
      return border * *rc::gen::inRange(1, 100) / 50;
  }
}

std::vector<double> random_magnitudes(std::size_t most) {
  std::vector<double> magnitudes;
  const auto count = *rc::gen::inRange<std::size_t>(0, most + 1);
  magnitudes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) magnitudes.push_back(random_magnitude());
  return magnitudes;
}

// Kills: any change of a border, which would change the meaning of old histograms.
TEST(HistogramBorders, AreWhatChainsOfSquareRootsGive) {
  const double half = std::sqrt(2.0);
  const double quarter = std::sqrt(half);
  const double three_quarters = std::sqrt(2 * half);
  const std::array<double, 8> powers{
      1,    std::sqrt(quarter),     quarter,        std::sqrt(three_quarters),
      half, std::sqrt(2 * quarter), three_quarters, std::sqrt(2 * three_quarters)};
  for (int k = 0; k <= 480; ++k) {
    const double border = std::ldexp(powers[static_cast<std::size_t>(k % 8)], k / 8 - 20);
    EXPECT_EQ(Histogram::borders(static_cast<std::size_t>(1 + k)).hi, border) << k;
  }
}

TEST(HistogramBorders, EachBucketBeginsWhereTheOneBelowEnds) {
  EXPECT_EQ(Histogram::borders(Histogram::kZeroBucket), (Enclosure{0, 0}));
  for (std::size_t bucket = 1; bucket < Histogram::kBucketCount; ++bucket) {
    const Enclosure borders = Histogram::borders(bucket);
    EXPECT_EQ(borders.lo, Histogram::borders(bucket - 1).hi) << bucket;
    EXPECT_LT(borders.lo, borders.hi) << bucket;
  }
  EXPECT_EQ(Histogram::borders(1).hi, 0x1p-20);
  EXPECT_EQ(Histogram::borders(Histogram::kOverflowBucket), (Enclosure{0x1p40, kInfinity}));
}

// Kills: buckets that include their lower border.
TEST(HistogramBuckets, HoldTheirUpperBorderAndNotTheirLower) {
  for (std::size_t bucket = 1; bucket < Histogram::kOverflowBucket; ++bucket) {
    const Enclosure borders = Histogram::borders(bucket);
    EXPECT_EQ(Histogram::bucket_of(borders.hi), bucket);
    EXPECT_EQ(Histogram::bucket_of(std::nextafter(borders.lo, kInfinity)), bucket);
    EXPECT_EQ(Histogram::bucket_of(std::nextafter(borders.hi, kInfinity)), bucket + 1);
  }
}

TEST(HistogramBuckets, ZeroOfEitherSignIsAloneInItsBucket) {
  EXPECT_EQ(Histogram::bucket_of(0.0), Histogram::kZeroBucket);
  EXPECT_EQ(Histogram::bucket_of(-0.0), Histogram::kZeroBucket);
  EXPECT_EQ(Histogram::bucket_of(kLeast), 1U);
  EXPECT_EQ(Histogram::bucket_of(-kLeast), 1U);
}

TEST(HistogramBuckets, TheLargestDoubleOverflows) {
  EXPECT_EQ(Histogram::bucket_of(0x1p40), Histogram::kOverflowBucket - 1);
  EXPECT_EQ(Histogram::bucket_of(std::numeric_limits<double>::max()), Histogram::kOverflowBucket);
}

RC_GTEST_PROP(HistogramBuckets, EncloseWhatIsInThem, ()) {
  const double magnitude = random_magnitude();
  const std::size_t bucket = Histogram::bucket_of(magnitude);
  RC_ASSERT(contains(Histogram::borders(bucket), magnitude));
  RC_ASSERT(Histogram::bucket_of(-magnitude) == bucket);
}

TEST(Histogram, CountsWhatIsNotFiniteApart) {
  const Histogram histogram =
      histogram_of({1, kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(histogram.count(), 1U);
  EXPECT_EQ(histogram.non_finite(), 3U);
  EXPECT_EQ(histogram.count_in(Histogram::kOverflowBucket), 0U);
}

TEST(Histogram, AddingTimesIsAddingThatOften) {
  Histogram at_once;
  at_once.add_to_bucket(Histogram::bucket_of(3), 2);
  at_once.add_non_finite(1);
  EXPECT_EQ(at_once, histogram_of({3, kInfinity, 3}));
}

// Kills: counting a border's own bucket as above it; counting 1/2 as misrounded.
TEST(HistogramCountAbove, CountsFromJustAboveTheBorder) {
  const Histogram histogram =
      histogram_of({0, 0.25, 0.5, 0.5, std::nextafter(0.5, 1), 7, 0x1p41, kInfinity});
  EXPECT_EQ(histogram.count_above(0.5), 4U);
  EXPECT_EQ(histogram.count_above(0), 7U);
  EXPECT_EQ(histogram.count_above(0x1p40), 2U);
  EXPECT_EQ(Histogram().count_above(0.5), 0U);
}

RC_GTEST_PROP(HistogramCountAbove, IsThatOfTheObservations, ()) {
  const std::vector<double> magnitudes = random_magnitudes(40);
  const auto bucket = *rc::gen::inRange<std::size_t>(0, Histogram::kOverflowBucket);
  const double border = Histogram::borders(bucket).hi;
  const auto above = std::count_if(magnitudes.begin(), magnitudes.end(),
                                   [border](double magnitude) { return magnitude > border; });
  RC_ASSERT(histogram_of(magnitudes).count_above(border) == static_cast<std::uint64_t>(above));
}

TEST(HistogramQuantile, OfNothingFiniteIsNothing) {
  EXPECT_EQ(Histogram().quantile(0.5), std::nullopt);
  EXPECT_EQ(histogram_of({kInfinity}).quantile(1), std::nullopt);
}

TEST(HistogramQuantile, IsExactWhereItIsZero) {
  const Histogram histogram = histogram_of({0, 0, 0, 5});
  EXPECT_EQ(histogram.quantile(0), (Enclosure{0, 0}));
  EXPECT_EQ(histogram.quantile(0.75), (Enclosure{0, 0}));
  EXPECT_TRUE(contains(histogram.quantile(0.76).value(), 5));
}

// Kills: buckets that include their lower border, so that correct rounding seems to exceed 1/2 ULP.
TEST(HistogramQuantile, OfCorrectlyRoundedValuesIsAtMostHalfAnUlp) {
  EXPECT_EQ(histogram_of({0, 0.25, 0.5, 0.5}).quantile(1).value().hi, 0.5);
}

TEST(HistogramQuantile, BeyondTheLastBorderHasNoUpperEnd) {
  EXPECT_EQ(histogram_of({0x1p41}).quantile(0.5), (Enclosure{0x1p40, kInfinity}));
}

TEST(HistogramQuantile, OfCountsThatNoDoubleHoldsStaysAmongThem) {
  Histogram histogram;
  histogram.add_to_bucket(1, std::numeric_limits<std::uint64_t>::max() - 1);
  histogram.add_to_bucket(2, 1);
  EXPECT_EQ(histogram.quantile(0.5), Histogram::borders(1));
  EXPECT_EQ(histogram.quantile(1), Histogram::borders(2));
}

// Kills: a rank off by one at either end or in between; non-finite counts that shift ranks.
RC_GTEST_PROP(HistogramQuantile, EnclosesTheQuantileOfTheObservations, ()) {
  std::vector<double> magnitudes = random_magnitudes(60);
  magnitudes.push_back(random_magnitude());
  Histogram histogram = histogram_of(magnitudes);
  histogram.add_non_finite(*rc::gen::inRange<std::uint64_t>(0, 5));

  const int percent = *rc::gen::inRange(0, 101);
  const double p = percent / 100.0;
  std::sort(magnitudes.begin(), magnitudes.end());
  const double rank = std::clamp(std::ceil(p * static_cast<double>(magnitudes.size())), 1.0,
                                 static_cast<double>(magnitudes.size()));
  const double quantile = magnitudes[static_cast<std::size_t>(rank) - 1];

  const Enclosure enclosure = histogram.quantile(p).value();
  RC_ASSERT(contains(enclosure, quantile));
  RC_ASSERT(enclosure == Histogram::borders(Histogram::bucket_of(quantile)));
}

// Kills: a merge that leaves out the first, the last or the non-finite count.
RC_GTEST_PROP(HistogramMerge, IsCountingTheObservationsOfBoth, ()) {
  std::vector<double> a = random_magnitudes(20);
  std::vector<double> b = random_magnitudes(20);
  if (*rc::gen::arbitrary<bool>()) a.push_back(kInfinity);
  if (*rc::gen::arbitrary<bool>()) b.push_back(kInfinity);
  Histogram merged = histogram_of(a);
  merged.merge(histogram_of(b));
  a.insert(a.end(), b.begin(), b.end());
  RC_ASSERT(merged == histogram_of(a));
  RC_ASSERT(merged.count() + merged.non_finite() == a.size());
}

// Kills: rounding to nearest where a magnitude must be rounded up.
TEST(MagnitudeBound, IsTheEndFartherFromZero) {
  EXPECT_EQ(magnitude_bound({0.25, 0.5}), 0.5);
  EXPECT_EQ(magnitude_bound({-0.5, -0.25}), 0.5);
  EXPECT_EQ(magnitude_bound({-1, 0.5}), 1);
  EXPECT_EQ(magnitude_bound({0, 0}), 0);
}

}  // namespace
}  // namespace rastercheck::records::histogram_test
