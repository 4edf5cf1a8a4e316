#include "rasterizer/internal/exact_sum.h"

#include <gtest/gtest.h>

#include "tests/rasterizer/exact.h"

namespace rastercheck::rasterizer::exact_sum_test {
namespace {

Rational value_of(const ExactSum& sum) {
  Rational value = 0;
  for (const double component : sum.components()) value += Rational(component);
  return value;
}

/// Compares a sum with its exact value: components, sign, and nearest double.
void expect_value(ExactSum sum, const Rational& exact) {
  EXPECT_EQ(value_of(sum), exact);
  EXPECT_EQ(sum.sign(), sgn(exact));
  const Rational error = abs(Rational(sum.nearest()) - exact);
  if (exact == 0) {
    EXPECT_EQ(error, 0);
  } else {
    EXPECT_LT(error, abs(exact) * power_of_two(-52));
  }
  // Finding the nearest double may rearrange the components but must not change their sum.
  EXPECT_EQ(value_of(sum), exact);
}

/// Shewchuk's invariant, on which the sign depends: components ascend, and no two share a bit
/// position.
void expect_no_overlap(const ExactSum& sum) {
  const auto components = sum.components();
  for (std::size_t i = 1; i < components.size(); ++i) {
    const Rational lower = abs(Rational(components[i - 1]));
    const Rational upper = abs(Rational(components[i]));
    // The lowest bit of the upper component is above all bits of the lower one.
    const Rational grain = Rational(1) / upper.get_den() * (upper.get_num() & -upper.get_num());
    ASSERT_LT(lower, grain);
  }
}

TEST(ExactSum, OfNothingIsZero) {
  expect_value(ExactSum(), 0);
  EXPECT_TRUE(ExactSum().components().empty());
}

TEST(ExactSum, OfZerosHasNoComponent) {
  ExactSum sum;
  sum.add(0.0);
  sum.add(-0.0);
  sum.add_product(0.0, 3.0);
  EXPECT_TRUE(sum.components().empty());
  EXPECT_EQ(sum.sign(), 0);
}

TEST(ExactSum, TwoSumLosesNothing) {
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double a = random.number(53, -300, 300);
    const double b =
        random.one_in(2) ? random.number(53, -300, 300) : -a * (1 + random.number(20, -50, -1));
    const TwoSum sum(a, b);
    ASSERT_EQ(sum.sum, a + b);
    ASSERT_EQ(Rational(sum.sum) + Rational(sum.error), Rational(a) + Rational(b));
  }
}

// Kills: a component that is dropped; a sum kept in one double; the sign taken from the first
// component.
TEST(ExactSum, OfRandomNumbersIsExact) {
  Random random(2);
  for (int i = 0; i < 1'500; ++i) {
    ExactSum sum;
    Rational exact = 0;
    const int width = random.pick({2, 40, 200, 900});
    for (int terms = random.between(1, 60); terms > 0; --terms) {
      const double value = random.number(random.pick({1, 24, 53}), -width, width);
      sum.add(value);
      exact += Rational(value);
    }
    expect_no_overlap(sum);
    expect_value(sum, exact);
  }
}

TEST(ExactSum, OfRandomProductsIsExact) {
  Random random(3);
  for (int i = 0; i < 1'500; ++i) {
    ExactSum sum;
    Rational exact = 0;
    const int width = random.pick({1, 60, 240});
    for (int terms = random.between(1, 30); terms > 0; --terms) {
      const double a = random.number(53, -width, width);
      const double b = random.number(random.pick({24, 48, 53}), -width, width);
      sum.add_product(a, b);
      exact += Rational(a) * Rational(b);
    }
    expect_no_overlap(sum);
    expect_value(sum, exact);
  }
}

// Adds numbers and subtracts them again: the rest is zero or a single, much smaller bit.
TEST(ExactSum, CancelsToTheLastBit) {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    ExactSum sum;
    std::vector<double> back;
    for (int terms = random.between(1, 50); terms > 0; --terms) {
      back.push_back(-random.number(53, -400, 400));
      sum.add(-back.back());
    }
    const double rest = random.pick({0.0, 1.0, -1.0}) * std::ldexp(1.0, random.between(-900, 400));
    sum.add(rest);
    for (const double value : back) sum.add(value);
    EXPECT_EQ(sum.sign(), (rest > 0) - (rest < 0));
    EXPECT_EQ(sum.nearest(), rest);
  }
}

// Single bits so far apart that none merge: far more components than the sum has room for, unless
// it merges them. Kills: writing beyond the last component.
TEST(ExactSum, PutsComponentsTogetherWhereTheyAreTooMany) {
  for (const int step : {2, 3, 7}) {
    for (const bool ascending : {true, false}) {
      ExactSum sum;
      Rational exact = 0;
      const int count = std::min(900, 1'800 / step);
      for (int i = 0; i < count; ++i) {
        const int place = ascending ? i : count - 1 - i;
        const double bit = (i % 3 == 0 ? -1 : 1) * std::ldexp(1.0, -900 + step * place);
        sum.add(bit);
        exact += Rational(bit);
        ASSERT_LE(sum.components().size(), 128U);
      }
      expect_no_overlap(sum);
      expect_value(sum, exact);
    }
  }
}

TEST(ExactSum, NeedsFewComponentsOnceItsNearestIsKnown) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    ExactSum sum;
    for (int terms = 0; terms < 300; ++terms) sum.add(random.number(1, -960, 960));
    sum.nearest();
    EXPECT_LE(sum.components().size(), 41U);
    expect_no_overlap(sum);
  }
}

// Tails around half a unit of a power of two, below which the neighbours are twice as close.
TEST(ExactSum, NearestHoldsAtPowersOfTwo) {
  for (const double tail : {-0x1p-54, -0x1p-53, -0x1.8p-54, 0x1p-53, 0x1.8p-53, -0x1p-1000}) {
    ExactSum sum;
    sum.add(1.0);
    sum.add(tail);
    expect_value(sum, 1 + Rational(tail));
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::exact_sum_test
