// Rounding to the subpixel grid, compared with rationals.

#include "rasterizer/internal/grid_position.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/rasterizer/exact.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::grid_position_test {
namespace {

/// A window position in units of the grid spacing, as RULES §1 defines it.
std::array<Rational, 2> position_in_units(const State& state, const glm::vec4& p) {
  const Viewport& viewport = state.viewport;
  const Rational w = p.w;
  const int turn = state.convention == Convention::d3d ? -1 : 1;
  const Rational x = Rational(p.x) * Rational(viewport.size.x) / 2 / w +
                     Rational(viewport.origin.x) + Rational(viewport.size.x) / 2;
  const Rational y = turn * Rational(p.y) * Rational(viewport.size.y) / 2 / w +
                     Rational(viewport.origin.y) + Rational(viewport.size.y) / 2;
  const Rational points = power_of_two(state.snapping->subpixel_bits);
  return {Rational(x * points), Rational(y * points)};
}

/// The nearest integer; of two that are equally near, the one that the rounding names.
mpz_class nearest(const Rational& value, Rounding rounding) {
  mpz_class below;
  mpz_fdiv_q(below.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  const Rational rest = value - Rational(below);
  const Rational half(1, 2);
  if (rest < half) return below;
  if (rest > half) return below + 1;
  const bool is_lower = rounding == Rounding::nearest_even && below % 2 == 0;
  return is_lower ? below : mpz_class(below + 1);
}

bool is_within(const State& state, const glm::vec4& p) {
  if (!(p.w > 0)) return false;
  const auto at = position_in_units(state, p);
  const Rational limit = Rational(kGuardBand) * power_of_two(state.snapping->subpixel_bits);
  return abs(at[0]) <= limit && abs(at[1]) <= limit;
}

void expect_exact(const State& state, const glm::vec4& p, int& within) {
  const Grid grid = grid_of(state);
  const bool is_inside = is_within(state, p);
  ASSERT_EQ(is_within_guard_band(grid, p), is_inside) << p.x << " " << p.y << " " << p.w;
  if (!is_inside) return;
  ++within;
  const auto at = position_in_units(state, p);
  const GridPoint point = snapped(grid, p);
  // A unit is at most 2^-4 pixels.
  const int units = 1 << std::max(4 - state.snapping->subpixel_bits, 0);
  const Rounding rounding = state.snapping->rounding;
  EXPECT_EQ(mpz_class(point.x), nearest(at[0], rounding) * units) << p.x << " " << p.w;
  EXPECT_EQ(mpz_class(point.y), nearest(at[1], rounding) * units) << p.y << " " << p.w;
}

State random_grid_state(Random& random) {
  State state = small_state(64, 64, random.pick({Convention::vulkan, Convention::d3d}));
  state.snapping = Snapping{random.between(kLeastSubpixelBits, kMostSubpixelBits),
                            random.pick({Rounding::nearest_even, Rounding::half_up})};
  switch (random.between(0, 3)) {
    case 0:
      break;
    case 1:
      state.viewport.origin = {random.real(-4, 8), random.real(-4, 8)};
      state.viewport.size = {random.real(4, 10), random.real(4, 10)};
      break;
    case 2:  // sums of terms that cancel
      state.viewport.origin = {random.real(20, 60), -33};
      state.viewport.size = {-2 * state.viewport.origin.x, 64};
      break;
    default:
      state.viewport.origin = {random.any_real(), random.any_real()};
      state.viewport.size = {random.any_real(), random.any_real()};
  }
  return state;
}

TEST(GridPosition, IsTheNearestGridPoint) {
  Random random(1);
  int within = 0;
  for (int i = 0; i < 60'000; ++i) {
    const State state = random_grid_state(random);
    glm::vec4 p{random.real(-3, 3), random.real(-3, 3), 0, std::abs(random.real(-3, 3))};
    if (random.one_in(4)) p = {random.any_real(), random.any_real(), 0, random.any_real()};
    expect_exact(state, p, within);
  }
  EXPECT_GT(within, 20'000);
}

// Kills: a quotient rounded in double; halves rounded up where they go to the even point, or
// rounded away from zero.
TEST(GridPosition, HalvesGoWhereTheRoundingSaysAndNeighboursOfHalvesDoNot) {
  Random random(2);
  int within = 0;
  int ties = 0;
  for (int i = 0; i < 60'000; ++i) {
    State state = small_state(64, 64);
    state.snapping =
        Snapping{random.between(0, 10), random.pick({Rounding::nearest_even, Rounding::half_up})};
    if (random.one_in(2)) state.viewport.origin.x = -32;
    // u is n + 1/2 grid spacings, and x is multiplied by a w of few bits, so that the float is
    // exact or nearly so.
    const auto units = static_cast<double>(1 << state.snapping->subpixel_bits);
    const double u = (random.between(0, static_cast<int>(64 * units)) + 0.5) / units;
    const auto w = static_cast<float>(random.between(1, 63));
    glm::vec4 p{static_cast<float>((2 * u / 64 - 1) * double{w}), 0, 0, w};
    if (random.one_in(3)) p.x = std::nextafter(p.x, 100.0F);
    if (random.one_in(3)) p.x = std::nextafter(p.x, -100.0F);
    const Rational rest = position_in_units(state, p)[0] + Rational(1, 2);
    ties += rest.get_den() == 1 ? 1 : 0;
    expect_exact(state, p, within);
  }
  EXPECT_GT(ties, 1'000);
}

// Kills: a comparison with the guard band in double.
TEST(GridPosition, TheGuardBandIsExact) {
  int within = 0;
  for (const float w : {1.0F, 3.0F, 0x1.fffffep-60F, 0x1p-140F}) {
    for (const double side : {-1.0, 1.0}) {
      State state = small_state(64, 64);
      state.snapping = Snapping{16};
      // x such that 32 x + 32 w = ±32768 w
      auto x = static_cast<float>((side * 1024 - 1) * double{w});
      for (int step = 0; step < 3; ++step) {
        expect_exact(state, {x, 0, 0, w}, within);
        x = std::nextafter(x, static_cast<float>(side) * std::numeric_limits<float>::infinity());
      }
    }
  }
  EXPECT_GT(within, 0);
}

}  // namespace
}  // namespace rastercheck::rasterizer::grid_position_test
