// Contracts that permit several viewports (Contract::viewport_error; docs/judge-a-driver.md, What a
// driver is held to), compared with triangles drawn by one of these viewports. The test computes
// the triangles in rational numbers of its own.

#include <CGAL/Gmpq.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "oracle/triangle_truth.h"
#include "tests/oracle/random_case.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::open_viewport_test {
namespace {

using CGAL::Gmpq;
using records::Verdict;

struct Place {
  Gmpq u;
  Gmpq v;
};

/// Twice the signed area of a, b, c; positive if they turn from u to v.
Gmpq area(const Place& a, const Place& b, const Place& c) {
  return (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
}

/// A viewport's sides.
struct Sides {
  std::array<Gmpq, 2> u;
  std::array<Gmpq, 2> v;
};

/// The sides of a case's viewport, each moved by up to `error`.
Sides moved_sides(const cases::Viewport& viewport, double error) {
  const auto moved = [error](double side) {
    const int eighths = one_of({-8, 8, -8, 8, 0, 3, -5});
    return Gmpq(side) + Gmpq(error) * Gmpq(eighths, 8);
  };
  const double x = viewport.x;
  const double y = viewport.y;
  Sides sides;
  sides.u[0] = moved(x);
  sides.u[1] = moved(x + viewport.width);
  sides.v[0] = moved(y);
  sides.v[1] = moved(y + viewport.height);
  return sides;
}

Place window_position(const cases::ClipVertex& p, const Sides& sides) {
  const auto along = [](const Gmpq& ndc, const std::array<Gmpq, 2>& side) {
    return side[0] + (ndc + 1) / 2 * (side[1] - side[0]);
  };
  return {along(Gmpq(p.x) / Gmpq(p.w), sides.u), along(Gmpq(p.y) / Gmpq(p.w), sides.v)};
}

/// One triangle as an implementation may draw it: `placed` gives the coverage, `valued` the values.
struct Drawn {
  Sides sides;
  std::array<Place, 3> placed;
  std::array<Place, 3> valued;
};

bool is_covered(const Drawn& drawn, const Place& p) {
  const auto is_between = [](const std::array<Gmpq, 2>& side, const Gmpq& at) {
    return (at > side[0] && at < side[1]) || (at < side[0] && at > side[1]);
  };
  if (!is_between(drawn.sides.u, p.u) || !is_between(drawn.sides.v, p.v)) return false;
  const auto& [a, b, c] = drawn.placed;
  const Gmpq whole = area(a, b, c);
  const Gmpq zero(0);
  return area(p, b, c) * whole > zero && area(a, p, c) * whole > zero &&
         area(a, b, p) * whole > zero;
}

/// The attribute at p; nullopt if 1/w <= 0.
std::optional<Gmpq> value_at(const Drawn& drawn, const cases::Case& c, const Place& p) {
  const auto& [first, second, third] = drawn.valued;
  const std::array<Gmpq, 3> weights{area(p, second, third), area(first, p, third),
                                    area(first, second, p)};
  Gmpq numerator(0);
  Gmpq denominator(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Gmpq weight = weights[i] / Gmpq(c.positions[i].w);
    numerator += weight * Gmpq(c.attribute_values[i]);
    denominator += weight;
  }
  if (denominator * area(first, second, third) <= Gmpq(0)) return std::nullopt;
  return numerator / denominator;
}

cases::Case viewport_case() {
  std::array<cases::ClipVertex, 3> corners;
  const auto reach = one_of({1.0F, 1.0F, 0.25F, 3.0F});
  for (cases::ClipVertex& p : corners) {
    const auto w = one_of({1.0F, 1.0F, 2.5F, 0.125F, 9.0F});
    const float x = ordinary_float(reach) * w;
    const float y = ordinary_float(reach) * w;
    p = {x, y, 0.5F * w, w};
  }
  cases::Case c = small_case(cases::Rules::vulkan, 12, 12, corners,
                             {{{ordinary_float(2)}, {ordinary_float(2)}, {ordinary_float(2)}}});
  c.viewport.x = one_of({0.0F, 0.375F, -2.25F});
  c.viewport.y = one_of({0.0F, 0.5F, 3.125F});
  c.viewport.width = one_of({12.0F, 11.5F, 9.25F});
  c.viewport.height = one_of({12.0F, 7.75F, -10.5F});
  if (c.viewport.height < 0) c.viewport.y -= c.viewport.height;
  c.coverage = cases::Snapping{one_of({2, 4, 8}), cases::Rounding::unspecified, 0};
  c.basis = one_of({cases::Basis::unspecified, cases::Basis::snapped, cases::Basis::ideal});
  return c;
}

Drawn some_drawing(const cases::Case& c, double error) {
  Drawn drawn{moved_sides(c.viewport, error), {}, {}};
  const Gmpq unit(std::ldexp(1.0, -c.coverage->subpixel_bits));
  const bool is_ideal = c.basis == cases::Basis::ideal ||
                        (c.basis == cases::Basis::unspecified && *rc::gen::arbitrary<bool>());
  for (std::size_t i = 0; i < 3; ++i) {
    const Place exact = window_position(c.positions[i], drawn.sides);
    // Less than a unit: rounding to either neighbour.
    const auto step = [&unit] { return unit * Gmpq(one_of({-63, 63, -63, 63, 0, 20}), 64); };
    const Gmpq along_u = step();
    const Gmpq along_v = step();
    drawn.placed[i] = {exact.u + along_u, exact.v + along_v};
    drawn.valued[i] = is_ideal ? exact : drawn.placed[i];
  }
  return drawn;
}

bool lies_within(const Gmpq& value, const ValueRange& range) {
  // The oracle hands out exact fractions only as text.
  const auto number = [](const Rational& rational) { return Gmpq(rational.to_string()); };
  return value >= number(range.lo) && value <= number(range.hi);
}

// Kills: giving each vertex a box of its own, as if each could have another viewport; considering
// only the extreme viewports; measuring the rounding in pixels of the wrong viewport; judging
// values of the exact triangle by the requested viewport.
RC_GTEST_PROP(OpenViewport, LeavesOpenWhateverOneOfItsViewportsDraws, ()) {
  const cases::Case c = viewport_case();
  cases::Contract contract = cases::contract_of(c);
  contract.is_on_grid = false;
  contract.viewport_error = one_of({0.25, 0.0625, 1.0});
  const Drawn drawn = some_drawing(c, contract.viewport_error);
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  int covered = 0;
  int with_value = 0;
  for (int y = 0; y < c.framebuffer.height; ++y) {
    for (int x = 0; x < c.framebuffer.width; ++x) {
      const Place p{Gmpq(2 * x + 1, 2), Gmpq(2 * y + 1, 2)};
      const Verdict verdict = truth.judge(x, y, 0).verdict;
      const bool is_drawn = is_covered(drawn, p);
      RC_ASSERT(verdict != (is_drawn ? Verdict::forbidden : Verdict::required));
      if (!is_drawn) continue;
      ++covered;
      const std::optional<ValueRange> range = truth.attribute(0, x, y, 0);
      const std::optional<Gmpq> value = value_at(drawn, c, p);
      if (!range || !value) continue;
      ++with_value;
      RC_ASSERT(lies_within(*value, *range));
    }
  }
  RC_CLASSIFY(covered > 0, "covers something");
  RC_CLASSIFY(covered > 0 && with_value == covered, "all values known");
}

/// A triangle over the left half of a viewport that is 16 pixels wide, begins at 1/2, and whose
/// sides may be off by a pixel. The attribute is window x of the requested viewport, less 1/2.
struct LeftHalf {
  cases::Case source =
      small_case(cases::Rules::vulkan, 20, 16,
                 {{{-3, -9, 0.5F, 1}, {0, -9, 0.5F, 1}, {0, 9, 0.5F, 1}}}, {{{-16}, {8}, {8}}});
  cases::Contract contract;
  LeftHalf() {
    source.viewport.x = 0.5F;
    source.viewport.width = 16;
    source.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
    source.basis = cases::Basis::snapped;
    contract = cases::contract_of(source);
    contract.viewport_error = 1;
  }
};

// By hand: the edge is at x = 8.5. It may be off by the viewport's pixel and by a unit of 1/256
// pixel, which is 8/7 as large in a viewport of 14 pixels: together 1.0045 pixels. So 6.5 (2 away)
// is inside, 7.5 and 9.5 (1 away) are open, and 10.5 is outside.
TEST(OpenViewport, MovesEdgesByTheViewportAndTheRounding) {
  const LeftHalf half;
  const SceneTruth scene(half.source, half.contract);
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.judge(6, 8, 0).verdict, Verdict::required);
  EXPECT_EQ(truth.judge(7, 8, 0).verdict, Verdict::permitted);
  EXPECT_EQ(truth.judge(7, 8, 0).reason, records::Reason::viewport);
  EXPECT_EQ(truth.judge(9, 8, 0).verdict, Verdict::permitted);
  EXPECT_EQ(truth.judge(10, 8, 0).verdict, Verdict::forbidden);
  // The viewport begins between −0.5 and 1.5.
  EXPECT_EQ(truth.judge(0, 8, 0).verdict, Verdict::permitted);
  EXPECT_EQ(truth.judge(2, 8, 0).verdict, Verdict::required);
}

// At x = 4.5 the attribute is 4 in the requested viewport; if moved by up to 1.0045 pixels, it is
// between 2.9955 and 5.0045.
TEST(OpenViewport, MovesValuesByNoMore) {
  const LeftHalf half;
  const SceneTruth scene(half.source, half.contract);
  const TriangleTruth truth(scene, 0);
  const std::optional<ValueRange> range = truth.attribute(0, 4, 8, 0);
  ASSERT_TRUE(range);
  EXPECT_TRUE(range->is_open);
  const double most = 1 + 8.0 / 7 / 256;
  EXPECT_NEAR(range->lo.nearest_double(), 4 - most, 1e-9);
  EXPECT_NEAR(range->hi.nearest_double(), 4 + most, 1e-9);
}

// A triangle far smaller than the viewport's error is drawn somewhere, as a whole. Its values lie
// between its vertices' values, however far the samples are from the requested position.
TEST(OpenViewport, DoesNotTakeSmallTrianglesApart) {
  cases::Case c = small_case(cases::Rules::vulkan, 16, 16,
                             {{{0, 0, 0.5F, 1}, {0.0625F, 0, 0.5F, 1}, {0, 0.0625F, 0.5F, 1}}},
                             {{{1}, {2}, {3}}});
  c.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
  c.basis = cases::Basis::snapped;
  c.cull = cases::Cull::back;
  cases::Contract contract = cases::contract_of(c);
  contract.viewport_error = 1;
  for (const bool is_turned : {false, true}) {
    if (is_turned) std::swap(c.positions[1], c.positions[2]);
    const SceneTruth scene(c, contract);
    const TriangleTruth truth(scene, 0);
    const Verdict expected = truth.orientation() > 0 ? Verdict::forbidden : Verdict::permitted;
    EXPECT_EQ(truth.judge(8, 8, 0).verdict, expected);
    if (expected == Verdict::forbidden) continue;
    const std::optional<ValueRange> range = truth.attribute(0, 8, 8, 0);
    ASSERT_TRUE(range);
    EXPECT_GE(range->lo.nearest_double(), 1);
    EXPECT_LE(range->hi.nearest_double(), 3);
  }
}

// By hand: three vertices at the window's (8, 8), which a grid of 1/4 pixel may pull apart by 1/4
// pixel, or by 2/7 pixel in a viewport of 14 pixels. The sample (8.5, 8.5) may be covered; samples
// 2 pixels away may not.
TEST(OpenViewport, MayGiveAPointAnArea) {
  cases::Case c = small_case(cases::Rules::vulkan, 16, 16,
                             {{{0, 0, 0.5F, 1}, {0, 0, 0.5F, 1}, {0, 0, 0.5F, 1}}});
  c.coverage = cases::Snapping{2, cases::Rounding::unspecified, 0};
  cases::Contract contract = cases::contract_of(c);
  contract.viewport_error = 1;
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.judge(8, 8, 0).verdict, Verdict::permitted);
  EXPECT_EQ(truth.judge(9, 8, 0).verdict, Verdict::forbidden);
}

TEST(OpenViewport, PromisesNothingOfViewportsThatMayVanish) {
  LeftHalf half;
  half.contract.viewport_error = 8;
  EXPECT_FALSE(cases::promise_of(half.contract, half.source, 0).is_made);
  half.contract.viewport_error = 7.75;
  EXPECT_TRUE(cases::promise_of(half.contract, half.source, 0).is_made);
}

}  // namespace
}  // namespace rastercheck::oracle::open_viewport_test
