// Values of lines and points, by hand (RULES §9, §10), and drawings of them judged.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "oracle/judge.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawing.h"

namespace rastercheck::oracle::primitive_values_test {
namespace {

using cases::Interpolation;
using cases::LineMode;
using cases::Location;
using cases::Primitive;

/// From (1, 1.5) with w = 1 to (5, 1.5) with w = 3, on 8 × 8 pixels; depth from 0 to 1/2.
/// Attributes from 0 to 4, in this order: smooth, noperspective, flat.
cases::Case line(float width = 1) {
  cases::Case c;
  c.rules = cases::Rules::vulkan;
  c.framebuffer = {8, 8, 1};
  c.viewport.width = c.viewport.height = 8;
  c.primitive = Primitive::lines;
  c.line_width = width;
  c.positions = {{-0.75F, -0.625F, 0, 1}, {0.75F, -1.875F, 1.5F, 3}};
  c.triangles = {{0, 1, 1}};
  c.attributes = {{"s", Interpolation::smooth, Location::sample},
                  {"n", Interpolation::noperspective, Location::sample},
                  {"f", Interpolation::flat, Location::sample}};
  c.attribute_values = {0, 0, 7, 4, 4, 8};
  return c;
}

std::string text(const std::optional<ValueRange>& value) {
  if (!value) return "none";
  return value->lo == value->hi ? value->lo.to_string()
                                : value->lo.to_string() + ".." + value->hi.to_string();
}

// At u = 2.5, 3/8 of the way in the window: 1/w = 5/8 + 3/8/3 = 3/4, and s = (3/8/3)/(3/4) = 1/6.
// Kills: affine values; t along the minor axis; depth with perspective; another vertex's flat
// value.
TEST(LineValues, AreOfTheShareOfTheSecondEnd) {
  const cases::Case c = line(3);
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  for (const int y : {0, 1, 2}) {  // the same across the line
    EXPECT_EQ(text(truth.attribute(0, 2, y, 0)), "2/3") << y;
    EXPECT_EQ(text(truth.attribute(1, 2, y, 0)), "3/2") << y;
    EXPECT_EQ(text(truth.attribute(2, 2, y, 0)), "7") << y;
    EXPECT_EQ(text(truth.depth(2, y, 0)), "3/16") << y;
  }
  cases::Case last = c;
  last.rules = cases::Rules::opengl;
  last.positions = {{-0.75F, -0.625F, 0, 1}, {0.75F, -1.875F, 0, 3}};
  const SceneTruth last_scene(last, cases::contract_of(last));
  EXPECT_EQ(text(TriangleTruth(last_scene, 0).attribute(2, 2, 1, 0)), "8");
  EXPECT_EQ(text(TriangleTruth(last_scene, 0).depth(2, 1, 0)), "1/2");
}

// From (1, 1) to (5, 3): at (2.5, 1.5), along x 3/8 of the way, and in the line's own direction
// ((1.5, 0.5)·(4, 2))/20 = 7/20.
TEST(LineValues, OfAParallelogramAreOfTheShareAlongTheMajorAxis) {
  cases::Case c = line(3);
  c.positions = {{-0.75F, -0.75F, 0, 1}, {0.25F, -0.25F, 0, 1}};
  const auto value = [&c](LineMode mode) {
    c.line_mode = mode;
    const SceneTruth scene(c, cases::contract_of(c));
    return text(TriangleTruth(scene, 0).attribute(1, 2, 1, 0));
  };
  EXPECT_EQ(value(LineMode::parallelogram), "3/2");
  EXPECT_EQ(value(LineMode::rectangular), "7/5");
  EXPECT_EQ(value(LineMode::bresenham), "7/5");
}

// A clipped line's values are the unclipped one's. Behind the eye from s = 1/2 on: at u = 3, with
// w_a = 1 and w_b = -1, g_a = u − 1 and g_b = −(u − 1) + 2 (u + 3)… by hand: the clip-space point
// (1 − s) a + s b has w = 1 − 2 s and x = (1 − 2 s) · u, so u = ((1 − s) + 5 s)/(1 − 2 s) for
// X_a = 1, X_b = 5: s = (u − 1)/(2 u + 4) = 1/5.
TEST(LineValues, OfALineBehindTheEyeAreOfItsClipSpaceShare) {
  cases::Case c = line();
  c.positions = {{-0.75F, -0.625F, 0.5F, 1}, {2.25F, 0.625F, -0.5F, -1}};
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  // X_b = (x + w) · 4 = 5.
  EXPECT_EQ(text(truth.attribute(0, 2, 1, 0)), "2/3");  // s = 1.5/9 = 1/6
  EXPECT_EQ(truth.judge(2, 1, 0).verdict, records::Verdict::required);
}

TEST(PointValues, AreTheVertexs) {
  cases::Case c = line();
  c.primitive = Primitive::points;
  c.point_size = 4;
  c.triangles = {{1, 1, 1}};
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(text(truth.attribute(0, 6, 2, 0)), "4");
  EXPECT_EQ(text(truth.attribute(1, 3, 0, 0)), "4");
  EXPECT_EQ(text(truth.attribute(2, 3, 0, 0)), "8");
  EXPECT_EQ(text(truth.depth(3, 0, 0)), "1/2");
}

// Kills: a region of open values that is too small; values of the exact line only.
TEST(LineValues, OfOpenPlacementsHoldThoseOfEachPlacement) {
  Dice dice(4);
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    cases::Case c = line(dice.pick({0.5F, 1.0F, 3.0F}));
    c.line_mode = dice.one_in(2) ? LineMode::rectangular : LineMode::parallelogram;
    for (cases::ClipVertex& p : c.positions) {
      p.w = dice.pick({0.5F, 1.0F, 4.0F});
      p.x = (static_cast<float>(dice.between(1, 127)) / 64 - 1) * p.w;
      p.y = (static_cast<float>(dice.between(1, 127)) / 64 - 1) * p.w;
      p.z = p.w / 2;
    }
    cases::Contract open = cases::contract_of(c);
    open.coverage = cases::Snapping{2, cases::Rounding::unspecified};
    open.basis = cases::Basis::snapped;
    const SceneTruth scene(c, open);
    const TriangleTruth truth(scene, 0);
    for (int k = 0; k < 16; ++k) {
      cases::Case placed = c;
      for (std::size_t end = 0; end < 2; ++end) {
        cases::ClipVertex& p = placed.positions[end];
        const auto moved = [&](float at, std::size_t axis) {
          const float down = std::floor((at / p.w + 1) * 16);  // in grid units
          const bool is_up = ((k >> (2 * end + axis)) & 1) != 0 && down != (at / p.w + 1) * 16;
          return ((is_up ? down + 1 : down) / 16 - 1) * p.w;
        };
        p.x = moved(p.x, 0);
        p.y = moved(p.y, 1);
      }
      const SceneTruth there(placed, cases::contract_of(placed));
      const TriangleTruth placed_truth(there, 0);
      for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
          if (placed_truth.judge(x, y, 0).verdict != records::Verdict::required) continue;
          if (truth.judge(x, y, 0).reason == records::Reason::not_promised) continue;
          for (const std::size_t attribute : {0U, 1U}) {
            const Rational value = placed_truth.attribute(attribute, x, y, 0).value().lo;
            const ValueRange range = truth.attribute(attribute, x, y, 0).value();
            ASSERT_LE(range.lo, value) << i << " " << k << " " << x << " " << y;
            ASSERT_GE(range.hi, value) << i << " " << k << " " << x << " " << y;
            ++compared;
          }
        }
      }
    }
  }
  EXPECT_GT(compared, 2000);
}

/// The number of fragments and values that are wrong in some way.
std::uint64_t wrong_of(const SceneTruth& scene, const cases::Fragments& drawn) {
  std::uint64_t wrong = 0;
  const records::Judgement judgement = judge(scene, drawn).judgement;
  for (const auto& [kind, errors] : judgement.errors) {
    for (std::size_t i = 1; i < errors.classes.counts.size(); ++i)
      wrong += errors.classes.counts[i];
  }
  return wrong;
}

cases::Case points() {
  cases::Case c = line();
  c.primitive = Primitive::points;
  c.point_size = 3;
  c.triangles = {{0, 0, 0}, {1, 1, 1}};
  return c;
}

// Kills: lines and points that the judge skips; values that it does not compare.
TEST(Judge, TakesARightDrawingOfLinesAndPointsForRightAndNoOther) {
  cases::Case diagonal = line(2);
  diagonal.positions = {{-0.75F, -0.625F, 0, 1}, {1.5F, 1.875F, 1.5F, 3}};
  cases::Case thin = diagonal;
  thin.line_mode = LineMode::bresenham;
  cases::Case slanted = diagonal;
  slanted.line_mode = LineMode::parallelogram;
  cases::Case several = diagonal;
  several.framebuffer.samples = 4;
  several.attributes[0].location = Location::center;
  several.attributes[1].location = Location::centroid;
  for (const cases::Case& c : {line(3), diagonal, thin, slanted, several, points()}) {
    for (const bool is_snapped : {false, true}) {
      cases::Contract contract = cases::contract_of(c);
      if (is_snapped) contract.coverage = cases::Snapping{8, cases::Rounding::nearest_even};
      const SceneTruth scene(c, contract);
      const cases::Fragments drawn = perfect(scene);
      ASSERT_GT(drawn.size(), 3U);
      EXPECT_EQ(wrong_of(scene, drawn), 0U);
      EXPECT_EQ(judge(scene, drawn).judgement.counts.required, drawn.size());

      cases::Fragments without = drawn;
      without.depth[1] += 0x1p-10F;
      EXPECT_GT(wrong_of(scene, without), 0U);
      without = drawn;
      without.attributes[0] += 0x1p-10F;
      EXPECT_GT(wrong_of(scene, without), 0U);
      without = drawn;
      without.x[0] = 7;
      without.y[0] = 7;
      EXPECT_GT(wrong_of(scene, without), 0U);
    }
  }
}

}  // namespace
}  // namespace rastercheck::oracle::primitive_values_test
