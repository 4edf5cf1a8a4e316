#include "records/signed_sum.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "tests/records/random_record.h"

namespace rastercheck::records::signed_sum_test {
namespace {

using Units = SignedSum::Units;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The ends of a number, counted exactly in units of 2^-64, in which 2^40 has 2^104 units.
struct Exact {
  Units lo = 0;
  Units hi = 0;
};
constexpr int kExactBits = 64;

/// An error, with the exact ends of its enclosure.
struct Term {
  Enclosure error;
  Exact exact;
};

Term random_term() {
  const auto random_end = [] {
    const auto digits = *rc::gen::inRange<std::int64_t>(-(1LL << 53), (1LL << 53) + 1);
    const auto shift = *rc::gen::inRange(0, 52);  // 2^53 · 2^51 = 2^104
    return std::pair(std::ldexp(static_cast<double>(digits), shift - kExactBits),
                     Units{digits} * (Units{1} << shift));
  };
  auto a = random_end();
  auto b = *rc::gen::arbitrary<bool>() ? a : random_end();
  if (b.second < a.second) std::swap(a, b);
  return {{a.first, b.first}, {a.second, b.second}};
}

std::vector<Term> random_terms() {
  std::vector<Term> terms;
  const auto count = *rc::gen::inRange<std::size_t>(0, 20);
  terms.reserve(count);
  for (std::size_t i = 0; i < count; ++i) terms.push_back(random_term());
  return terms;
}

SignedSum sum_of(const std::vector<Enclosure>& errors) {
  SignedSum sum;
  for (const Enclosure& error : errors) sum.add(error);
  return sum;
}

TEST(SignedSum, OfNothingHasNoMean) {
  EXPECT_EQ(SignedSum().count(), 0U);
  EXPECT_EQ(SignedSum().mean(), std::nullopt);
}

// Kills: rounding to nearest, or towards zero.
TEST(SignedSum, RoundsOutwards) {
  EXPECT_EQ(sum_of({{0x1p-33, 0x1p-33}}), SignedSum(0, 1, 1, 0));
  EXPECT_EQ(sum_of({{-0x1p-33, -0x1p-33}}), SignedSum(-1, 0, 1, 0));
  EXPECT_EQ(sum_of({{-0x3p-33, 0x5p-33}}), SignedSum(-2, 3, 1, 0));
  EXPECT_EQ(sum_of({{0x3p-32, 0x3p-32}}), SignedSum(3, 3, 1, 0));
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(sum_of({{-least, least}}), SignedSum(-1, 1, 1, 0));
}

// Kills: counting the largest allowed term as too large; checking only one end.
TEST(SignedSum, CountsWhatMayBeTooLargeApart) {
  const double above = std::nextafter(SignedSum::kMost, kInfinity);
  const Units most = SignedSum::kMostOfTerm;
  EXPECT_EQ(sum_of({{-SignedSum::kMost, SignedSum::kMost}}), SignedSum(-most, most, 1, 0));
  EXPECT_EQ(
      sum_of({{0, above}, {-above, 0}, {0, kInfinity}, {-kInfinity, 0}, {kNan, 0}, {0, kNan}}),
      SignedSum(0, 0, 0, 6));
  EXPECT_EQ(sum_of({{1, 1}, {2, kInfinity}}).mean(), std::nullopt);
}

TEST(SignedSum, TheMeanOfZerosIsZero) {
  EXPECT_EQ(sum_of({{0, 0}, {-0.0, 0}}).mean(), (Enclosure{0, 0}));
  EXPECT_TRUE(contains(sum_of({{-0.5, -0.5}, {0.5, 0.5}}).mean().value(), 0));
}

// Kills: an end rounded inwards; a sum in double, which would lose small terms beside large ones.
RC_GTEST_PROP(SignedSum, EnclosesTheExactSum, ()) {
  const std::vector<Term> terms = random_terms();
  SignedSum sum;
  Exact exact;
  for (const Term& term : terms) {
    sum.add(term.error);
    exact.lo += term.exact.lo;
    exact.hi += term.exact.hi;
  }
  const Units unit = Units{1} << (kExactBits - 32);
  const Units slack = unit * static_cast<Units>(terms.size());
  RC_ASSERT(sum.count() == terms.size());
  RC_ASSERT(sum.beyond() == 0U);
  RC_ASSERT(sum.lo() * unit <= exact.lo);
  RC_ASSERT(sum.hi() * unit >= exact.hi);
  // At either end, each term loses less than a unit.
  RC_ASSERT(exact.lo - sum.lo() * unit <= slack);
  RC_ASSERT(sum.hi() * unit - exact.hi <= slack);
}

// Kills: a sum that depends on the order of terms.
RC_GTEST_PROP(SignedSum, MergedOfAnySplitIsTheSame, ()) {
  const std::vector<Term> terms = random_terms();
  SignedSum whole;
  std::vector<SignedSum> parts(3);
  for (const Term& term : terms) {
    // Some terms are too large.
    const Enclosure error =
        *rc::gen::inRange(0, 8) == 0 ? Enclosure{term.error.lo, kInfinity} : term.error;
    whole.add(error);
    parts[*rc::gen::inRange<std::size_t>(0, parts.size())].add(error);
  }
  SignedSum forth = parts[0];
  forth.merge(parts[1]);
  forth.merge(parts[2]);
  SignedSum back = parts[2];
  back.merge(parts[1]);
  back.merge(parts[0]);
  RC_ASSERT(forth == whole);
  RC_ASSERT(back == whole);
}

/// True if x <= units · 2^-32 / count, computed only with integers. count is at most 2^54.
bool is_at_most(double x, Units units, std::uint64_t count) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const auto digits = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  // x · count = product · 2^(exponent - 53), which is compared with units · 2^-32.
  const Units product = Units{digits} * static_cast<Units>(count);
  const int shift = exponent - 53 + 32;
  if (shift >= 127) return digits <= 0;
  if (shift >= 0) return product <= (units >> shift);              // floor(units / 2^shift)
  if (shift <= -127) return product > 0 ? units > 0 : units >= 0;  // x is nearer to 0 than any unit
  return -(-product >> -shift) <= units;                           // ceil(product / 2^-shift)
}

// Kills: too few steps outwards; the ends exchanged.
RC_GTEST_PROP(SignedSum, TheMeanEnclosesTheExactOne, ()) {
  const SignedSum random = random_sum();
  const SignedSum sum(random.lo(), random.hi(), random.count(), 0);
  RC_PRE(sum.count() > 0);
  const Enclosure mean = sum.mean().value();
  RC_ASSERT(mean.lo <= mean.hi);
  RC_ASSERT(is_at_most(mean.lo, sum.lo(), sum.count()));
  RC_ASSERT(is_at_most(-mean.hi, -sum.hi(), sum.count()));
  // The enclosure is no wider than necessary: at most eight steps of doubles.
  const double size = magnitude_bound(mean);
  const double slack = 8 * (std::nextafter(size, kInfinity) - size);
  RC_ASSERT(!is_at_most(mean.lo + slack, sum.lo(), sum.count()) || sum.lo() == 0);
}

TEST(SignedSum, TheMeanIsThatOfTheTerms) {
  const Enclosure mean = sum_of({{1, 1}, {2, 2}, {-6, -6}}).mean().value();
  EXPECT_TRUE(contains(mean, -1));
  EXPECT_LT(mean.hi - mean.lo, 1e-9);
}

}  // namespace
}  // namespace rastercheck::records::signed_sum_test
