// Geometry on a grid, where ties and errors at the borders of buckets are common: there the filter
// knows errors exactly, without rounding.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/number.h"
#include "tests/oracle/cascade.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/random_case.h"
#include "tests/simd_targets.h"

namespace rastercheck::oracle::exact_grid_test {
namespace {

class ExactErrors : public testing::TestWithParam<std::int64_t> {
 protected:
  OnTarget on_target_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Targets, ExactErrors, testing::ValuesIn(all_targets()), target_name);

/// A random number below 2^exponent in magnitude, with at most `bits` bits.
double short_number(Dice& dice, int bits, int exponent) {
  const double whole = dice.between(0, (1 << bits) - 1);
  return (dice.one_in(2) ? whole : -whole) * std::ldexp(1.0, exponent - bits);
}

struct Grid {
  std::array<FilterLine, 3> edges;
  int bits = 0;
};

/// Three edges whose values at samples are multiples of 2^-4; these values and their sum stay below
/// 2^(bits − 4) in a box of 16 pixels.
Grid random_grid(Dice& dice) {
  const int coefficient_bits = dice.pick({1, 1, 4, kMostExactBits - 12});
  Grid grid;
  grid.bits = coefficient_bits + 4 + 8;
  for (FilterLine& edge : grid.edges) {
    edge.a = short_number(dice, coefficient_bits, coefficient_bits);
    edge.b = short_number(dice, coefficient_bits, coefficient_bits);
    edge.c = short_number(dice, coefficient_bits, coefficient_bits);
  }
  return grid;
}

/// Numbers with few bits or many, of sizes whose differences sometimes fit a double and sometimes
/// do not.
double random_value(Dice& dice) {
  return short_number(dice, dice.pick({1, 1, 3, 24}), dice.pick({0, 0, 0, 2, 40, -120}));
}

// Kills: a sum treated as exact after its first term; a difference that is rounded; a product with
// more bits than a double has; a quotient that is not checked.
TEST_P(ExactErrors, AreWhatTheyAreSaidToBe) {
  Dice dice(1);
  int exact = 0;
  int rounded = 0;
  for (int round = 0; round < 3000; ++round) {
    const Grid grid = random_grid(dice);
    ValueFilter filter;
    for (double& s : filter.s) s = random_value(dice);
    filter.exact_bits = grid.bits;
    Batch<double> x{};
    Batch<double> y{};
    Batch<double> computed{};
    const int count = 8;
    for (std::size_t k = 0; k < count; ++k) {
      x[k] = dice.between(0, 255) / 16.0;
      y[k] = dice.between(0, 255) / 16.0;
      computed[k] = dice.one_in(3) ? filter.s[0] : random_value(dice);
    }
    BatchWeights weights;
    weigh_samples(grid.edges, x, y, count, weights);
    Batch<double> lo;
    Batch<double> hi;
    value_errors(filter, weights, computed, count, lo, hi);
    for (std::size_t k = 0; k < count; ++k) {
      if (std::isnan(lo[k])) continue;
      Field sum = 0;
      Field divisor = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const FilterLine& edge = grid.edges[i];
        const Field e = Field(edge.a) * Field(x[k]) + Field(edge.b) * Field(y[k]) + Field(edge.c);
        ASSERT_EQ(Field(weights.e[i][k]), e);
        sum += (Field(computed[k]) - Field(filter.s[i])) * e;
        divisor += e;
      }
      const Field error = sum / divisor;
      if (lo[k] == hi[k]) {
        ASSERT_EQ(Field(lo[k]), error) << round;
        ++exact;
      } else {
        ASSERT_TRUE(Field(lo[k]) < error && error < Field(hi[k])) << round;
        ++rounded;
      }
    }
  }
  EXPECT_GT(exact, 500);
  EXPECT_GT(rounded, 1000);
}

/// A number with few bits, between 0 and 1.
float short_fraction() {
  return static_cast<float>(*rc::gen::inRange(0, 65)) / static_cast<float>(one_of({4, 16, 64}));
}

/// Two triangles in 16 × 16 pixels, which may share an edge. Their vertices lie at quarters of
/// pixels or at the centres of every fourth pixel, where few different errors occur and each occurs
/// often.
cases::Case random_grid_case() {
  cases::Case c;
  c.rules = one_of({cases::Rules::vulkan, cases::Rules::d3d, cases::Rules::opengl});
  c.framebuffer.width = 16;
  c.framebuffer.height = 16;
  c.framebuffer.samples = one_of({1, 1, 4, 16});
  c.viewport.width = 16;
  c.viewport.height = 16;
  // The second attribute of a kind may have the same error as the first, at an earlier place.
  c.attributes = {{"s", cases::Interpolation::smooth, {}},
                  {"t", cases::Interpolation::smooth, {}},
                  {"n", cases::Interpolation::noperspective, {}}};
  const bool is_coarse = *rc::gen::arbitrary<bool>();
  const bool is_affine = *rc::gen::inRange(0, 4) != 0;
  for (int i = 0; i < 4; ++i) {
    const float w = is_affine ? 1 : one_of({1.0F, 2.0F});
    const auto coordinate = [w, is_coarse] {
      const float pixels = is_coarse ? 0.5F + 4.0F * static_cast<float>(*rc::gen::inRange(0, 4))
                                     : static_cast<float>(*rc::gen::inRange(0, 65)) / 4.0F;
      const float on_grid = pixels / 8 - 1;
      // A distance from the grid that is too small for doubles of the grid's size.
      return w * (on_grid == 0 && *rc::gen::inRange(0, 2) == 0 ? 0x1p-80F : on_grid);
    };
    c.positions.push_back({coordinate(), coordinate(), w * short_fraction(), w});
    for (int a = 0; a < 3; ++a) {
      c.attribute_values.push_back(one_of({short_fraction(), random_float(4)}));
    }
  }
  c.triangles = {{0, 1, 2}, {3, 2, 1}};
  // With a depth test, samples are judged pixel by pixel, so that a sample of the first triangle
  // may follow one of the second.
  if (*rc::gen::inRange(0, 3) == 0) c.depth_test = cases::DepthTest::less;
  return c;
}

// Kills: ignoring an error that equals the extreme so far but lies at an earlier place, or treating
// that error as smaller.
RC_GTEST_PROP(ExactGrid, LevelsAgree, ()) {
  const cases::Case c = random_grid_case();
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth.constant = one_of({0.5F, 0.25F});
  if (*rc::gen::inRange(0, 3) == 0) contract.basis = cases::Basis::unspecified;
  const SceneTruth scene(c, contract);
  const cases::Fragments drawn = perfect(scene);
  RC_CLASSIFY(drawn.size() > 0, "covers something");
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  const bool is_spoiled = *rc::gen::inRange(0, 3) == 0;
  const std::string difference =
      disagreement(scene, is_spoiled ? spoiled(scene, drawn, dice) : drawn);
  RC_ASSERT(difference == "");
}

// By hand: at the centre of a pixel the values exceed 1 by 2^-25 (2y + 1) and 2^-25 (2x + 1), which
// is a quarter of an ULP from a float. The first attribute is rounded upwards from row 1 on, the
// second attribute already in row 0.
TEST(ExactGrid, OfEqualErrorsTheExtremeIsThatOfTheFirstPlace) {
  const cases::Case c = small_case(cases::Rules::vulkan, 16, 16,
                                   {{{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}}},
                                   {{{1, 1}, {1, 1 + 0x1p-20F}, {1 + 0x1p-20F, 1}}});
  const SceneTruth scene(c, cases::contract_of(c));
  for (const Level level : kLevels) {
    const JudgedDrawing judged = judge(scene, perfect(scene), from(level));
    const auto& extremes =
        judged.judgement.errors.at(records::AttributeKind::smooth).excess.extremes;
    EXPECT_EQ(extremes.most_positive->error, (records::Enclosure{0.25, 0.25}));
    EXPECT_EQ(extremes.most_positive->place, (cases::SamplePlace{0, 0, 1, 0}));
    EXPECT_EQ(extremes.most_positive->attribute, 1U);
  }
}

}  // namespace
}  // namespace rastercheck::oracle::exact_grid_test
