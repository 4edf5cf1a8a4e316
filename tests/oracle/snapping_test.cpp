// Snapped coverage (RULES §3), by hand.

#include "oracle/internal/snapping.h"

#include <gtest/gtest.h>

#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::snapping_test {
namespace {

using cases::Rounding;
using cases::Snapping;
using records::Reason;
using records::Verdict;

/// The candidates for a coordinate. snap() must give the same ones for a vertex at this place,
/// whatever its w.
std::pair<long, long> range(double coordinate, const Snapping& snapping) {
  const Ring one_unit(1);
  const GridRange r = candidates(Field(coordinate), snapping);
  for (const double w : {1.0, 3.0, 0x1.fffffep-3, 0x1p-100}) {
    const SnappedVertex vertex =
        snap(RingVector3(Ring(coordinate) * Ring(w), Ring(0), Ring(w)), snapping, one_unit);
    EXPECT_EQ(vertex.x.first, r.first) << coordinate << " of " << w;
    EXPECT_EQ(vertex.x.last, r.last) << coordinate << " of " << w;
  }
  return {r.first, r.last};
}

TEST(Candidates, HaveOneMemberForANamedRounding) {
  EXPECT_EQ(range(0.53125, {4, Rounding::nearest_even, 0}), std::pair(8L, 8L));    // 8.5 units
  EXPECT_EQ(range(0.59375, {4, Rounding::nearest_even, 0}), std::pair(10L, 10L));  // 9.5
  EXPECT_EQ(range(0.53125, {4, Rounding::half_up, 0}), std::pair(9L, 9L));
  EXPECT_EQ(range(-0.53125, {4, Rounding::half_up, 0}), std::pair(-8L, -8L));
  EXPECT_EQ(range(-0.53125, {4, Rounding::nearest_even, 0}), std::pair(-8L, -8L));
  EXPECT_EQ(range(-0.59375, {4, Rounding::nearest_even, 0}), std::pair(-10L, -10L));
}

TEST(Candidates, OfADirectedRoundingLieInItsDirection) {
  EXPECT_EQ(range(0.53125, {4, Rounding::half_down, 0}), std::pair(8L, 8L));  // 8.5 units
  EXPECT_EQ(range(-0.53125, {4, Rounding::half_down, 0}), std::pair(-9L, -9L));
  EXPECT_EQ(range(0.59, {4, Rounding::floor, 0}), std::pair(9L, 9L));  // 9.44
  EXPECT_EQ(range(-0.59, {4, Rounding::floor, 0}), std::pair(-10L, -10L));
  EXPECT_EQ(range(0.59, {4, Rounding::ceil, 0}), std::pair(10L, 10L));
  EXPECT_EQ(range(-0.59, {4, Rounding::ceil, 0}), std::pair(-9L, -9L));
  EXPECT_EQ(range(0.59, {4, Rounding::toward_zero, 0}), std::pair(9L, 9L));
  EXPECT_EQ(range(-0.59, {4, Rounding::toward_zero, 0}), std::pair(-9L, -9L));
  EXPECT_EQ(range(-0.03, {4, Rounding::toward_zero, 0}), std::pair(0L, 0L));
  for (const Rounding rounding : {Rounding::floor, Rounding::ceil, Rounding::toward_zero}) {
    EXPECT_EQ(range(-0.5, {4, rounding, 0}), std::pair(-8L, -8L)) << "on the grid";
  }
  // All positions within 0.75 units of 9.44, which are 8.69 to 10.19.
  EXPECT_EQ(range(0.59, {4, Rounding::floor, 0.75F}), std::pair(8L, 10L));
  EXPECT_EQ(range(0.59, {4, Rounding::ceil, 0.75F}), std::pair(9L, 11L));
}

TEST(Candidates, NeedNoPowerOfTwo) {
  EXPECT_EQ(range(0.53125, cases::with_steps({8, Rounding::floor, 0}, 12)),
            std::pair(6L, 6L));  // 6.375
  EXPECT_EQ(range(0.53125, cases::with_steps({8, Rounding::ceil, 0}, 12)), std::pair(7L, 7L));
  EXPECT_EQ(range(0.53125, cases::with_steps({8, Rounding::nearest_even, 0}, 3)),
            std::pair(2L, 2L));
  EXPECT_EQ(range(0.5, cases::with_steps({8, Rounding::nearest_even, 0}, 5)),
            std::pair(2L, 2L));  // 2.5
}

TEST(Candidates, MayDifferAlongTheAxes) {
  Snapping snapping{4, Rounding::floor, 0};
  snapping.rounding_of_y = Rounding::ceil;
  const SnappedVertex vertex =
      snap(RingVector3(Ring(0.59), Ring(0.59), Ring(1)), snapping, Ring(1));
  EXPECT_EQ(vertex.x.first, 9);
  EXPECT_EQ(vertex.y.first, 10);
}

TEST(Candidates, OfAnUnspecifiedRoundingAreTheNeighbours) {
  EXPECT_EQ(range(0.53125, {4, Rounding::unspecified, 0}), std::pair(8L, 9L));
  EXPECT_EQ(range(0.5, {4, Rounding::unspecified, 0}), std::pair(8L, 8L));  // on the grid
  EXPECT_EQ(range(0.5, {4, Rounding::unspecified, 0.25F}), std::pair(7L, 9L));
}

// Coordinates as near to a tie, or to the grid, as doubles allow.
TEST(Candidates, NextToATieFollowTheNearerSide) {
  const Snapping named{4, Rounding::nearest_even, 0};
  EXPECT_EQ(range(0.53125 - 0x1p-54, named), std::pair(8L, 8L));
  EXPECT_EQ(range(0.53125 + 0x1p-53, named), std::pair(9L, 9L));
  const Snapping unspecified{4, Rounding::unspecified, 0};
  EXPECT_EQ(range(0.5 - 0x1p-54, unspecified), std::pair(7L, 8L));
  EXPECT_EQ(range(0.5 + 0x1p-53, unspecified), std::pair(8L, 9L));
}

TEST(Candidates, OfAPositionErrorAreAllWithinHalfAUnitMore) {
  // D3D: 8.5 units with an error of 0.6 units is 7.9 … 9.1, which rounds to 8 and 9.
  EXPECT_EQ(range(0.53125, {4, Rounding::nearest_even, 0.125F}), std::pair(8L, 9L));
  EXPECT_EQ(range(0.5, {4, Rounding::nearest_even, 0.25F}), std::pair(8L, 8L));
  EXPECT_EQ(range(0.5, {4, Rounding::nearest_even, 0.5F}), std::pair(7L, 9L));
}

/// A triangle whose left side is at window u = 33/64, 1/64 to the right of the samples of column 0.
/// A grid of 1/16 moves the side onto these samples (8.25 units → 8).
cases::Case near_column(const cases::Coverage& coverage, cases::Basis basis) {
  const float left = 33.0F / 64 / 2 - 1;
  cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{left, -1, 0, 1}, {3, -1, 0, 1}, {left, 3, 0, 1}}},
                 {{{0}, {1}, {0}}});
  c.coverage = coverage;
  c.basis = basis;
  return c;
}

records::SampleVerdict judge(const cases::Case& c, int x, int y) {
  const SceneTruth scene(c, cases::contract_of(c));
  return TriangleTruth(scene, 0).judge(x, y, 0);
}

TEST(Snapping, CountsTheExtremePlacements) {
  for (const long columns : {1L, 2L, 5L}) {
    for (const long rows : {1L, 2L, 3L}) {
      const SnappedVertex vertex{{7, 6 + columns}, {-3, rows - 4}, Ring(1)};
      EXPECT_EQ(vertex.extreme_placements(), placed_columns(vertex, 8, true).size());
    }
  }
}

TEST(Snapping, MovesTheTriangleThatIsCovered) {
  EXPECT_EQ(judge(near_column(std::nullopt, cases::Basis::ideal), 0, 1).verdict,
            Verdict::forbidden);
  const auto snapped = near_column(Snapping{4, Rounding::nearest_even, 0}, cases::Basis::ideal);
  EXPECT_EQ(judge(snapped, 0, 1).verdict, Verdict::required);
  EXPECT_EQ(judge(snapped, 0, 1).reason, Reason::tie);
}

TEST(Snapping, UnspecifiedPermitsWhatSomePlacementCovers) {
  const auto c = near_column(Snapping{4, Rounding::unspecified, 0}, cases::Basis::ideal);
  EXPECT_EQ(judge(c, 0, 1).verdict, Verdict::permitted);
  EXPECT_EQ(judge(c, 0, 1).reason, Reason::snapping);
  EXPECT_EQ(judge(c, 1, 1).verdict, Verdict::required);
}

TEST(Snapping, ManyPlacementsAreBoundedByTheirBoxes) {
  // Four units of error allow 9 × 9 candidates for a vertex, far more than are enumerated.
  const auto c = near_column(Snapping{4, Rounding::nearest_even, 4}, cases::Basis::ideal);
  EXPECT_EQ(judge(c, 0, 1).verdict, Verdict::permitted);
  EXPECT_EQ(judge(c, 1, 1).verdict, Verdict::required);
}

// A sample may be covered if vertices lie between grid points, although no placement on grid points
// covers it: if vertices need not be on the grid, the sample is permitted. The apex is (1/2, 3/2)
// grid units from the sample and about one degree wide. On the grid it misses the sample, or has
// the sample on its right edge, which owns no samples.
TEST(Snapping, OffTheGridLeavesOpenWhatNoPlacementDecides) {
  constexpr float kUnit = 0x1p-8F;  // in NDC of a target of 2 pixels: 2^-8 pixels
  cases::Case c = small_case(cases::Rules::vulkan, 2, 2,
                             {{{-0.5F + 0.5F * kUnit, -0.5F + 1.5F * kUnit, 0, 1},
                               {-0.51F, -1, 0, 1},
                               {-0.5F, -1, 0, 1}}});
  cases::Contract contract;
  contract.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
  contract.tie_rule = cases::TieRule::top_left;
  const SceneTruth on_grid(c, contract);
  contract.is_on_grid = false;
  const SceneTruth off_grid(c, contract);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) {
      const bool is_beside_apex = x == 0 && y == 0;
      EXPECT_EQ(TriangleTruth(on_grid, 0).judge(x, y, 0).verdict, Verdict::forbidden);
      EXPECT_EQ(TriangleTruth(off_grid, 0).judge(x, y, 0).verdict,
                is_beside_apex ? Verdict::permitted : Verdict::forbidden);
    }
  }
}

// By hand, in whole pixels. (0, 0), (1, 0), (0, 1) lie on the grid and have one placement each, so
// the orientation is certain. The quick test of has_certain_orientation() cannot show this, because
// the mean of the vertices is no deeper inside than vertices may move. If the second vertex lies
// off the grid, it may be placed on the first.
TEST(Orientation, IsCertainWhereNoPlacementTurnsTheTriangle) {
  const auto is_certain = [](float u, float z, const cases::Coverage& coverage) {
    cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                               {{{-1, -1, 0, 1}, {u / 2 - 1, -1, z, 1}, {-1, -0.5F, 0, 1}}});
    c.coverage = coverage;
    const SceneTruth scene(c, cases::contract_of(c));
    return TriangleTruth(scene, 0).has_certain_orientation();
  };
  const Snapping named{0, Rounding::nearest_even, 0};
  const Snapping unspecified{0, Rounding::unspecified, 0};
  for (const cases::Coverage& coverage : {cases::Coverage(), cases::Coverage(named)}) {
    EXPECT_TRUE(is_certain(1, 0, coverage));
    EXPECT_FALSE(is_certain(1, -0.5F, coverage));  // clipped
    EXPECT_FALSE(is_certain(0, 0, coverage));      // without area
  }
  EXPECT_TRUE(is_certain(1, 0, unspecified));
  EXPECT_TRUE(is_certain(3.75F, 0, unspecified));
  EXPECT_FALSE(is_certain(0.75F, 0, unspecified));
  EXPECT_FALSE(is_certain(0.25F, 0, named));
}

TEST(Basis, DecidesWhereAttributesComeFrom) {
  const auto value = [](cases::Basis basis) {
    const auto c = near_column(Snapping{4, Rounding::nearest_even, 0}, basis);
    const SceneTruth scene(c, cases::contract_of(c));
    const auto range = TriangleTruth(scene, 0).attribute(0, 1, 0, 0);
    return std::pair(range->lo.to_string(), range->hi.to_string());
  };
  // r = (u − left)/(8 − left) at u = 3/2: left = 33/64, or 1/2 after snapping.
  EXPECT_EQ(value(cases::Basis::ideal), std::pair(std::string("63/479"), std::string("63/479")));
  EXPECT_EQ(value(cases::Basis::snapped), std::pair(std::string("2/15"), std::string("2/15")));
  EXPECT_EQ(value(cases::Basis::unspecified),
            std::pair(std::string("63/479"), std::string("2/15")));
}

TEST(Clipping, PermitsSamplesWithinAGridUnitOfWhatWasCut) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 8, 4, {{{0, 1, 0, -1}, {-0.5F, 0, 0, 1}, {0.5F, 0, 0, 1}}});
  c.coverage = Snapping{4, Rounding::nearest_even, 0};
  // One vertex is behind the eye, at window (4, 0); the others are at (2, 2) and (6, 2), and the
  // edges from them to the first vertex are cut. One of these edges is the line u + v = 4, on which
  // the sample at (1.5, 2.5) is open.
  EXPECT_EQ(judge(c, 1, 2).verdict, Verdict::permitted);
  EXPECT_EQ(judge(c, 1, 2).reason, Reason::nonpositive_w);
  EXPECT_EQ(judge(c, 2, 2).verdict, Verdict::required);
  EXPECT_EQ(judge(c, 0, 2).verdict, Verdict::forbidden);
}

TEST(Clipping, LeavesTheFacingOfASliverOpenWhereItComesFromSnappedVertices) {
  // A sliver along v = u, far thinner than a grid unit, cut by the near plane: its new vertices may
  // snap to either side of the line.
  cases::Case c = small_case(cases::Rules::d3d, 8, 8,
                             {{{-1, 1, -0.5F, 1}, {1, -1, 0.5F, 1}, {1, -0x1.ffep-1F, 0.5F, 1}}});
  c.coverage = Snapping{4, Rounding::nearest_even, 0};
  c.basis = cases::Basis::snapped;
  for (const cases::Cull cull : {cases::Cull::back, cases::Cull::front}) {
    c.cull = cull;
    EXPECT_EQ(judge(c, 6, 6).verdict, Verdict::permitted);
  }
  c.basis = cases::Basis::ideal;
  c.cull = cases::Cull::back;
  const Verdict back = judge(c, 6, 6).verdict;
  c.cull = cases::Cull::front;
  const Verdict front = judge(c, 6, 6).verdict;
  EXPECT_TRUE((back == Verdict::forbidden) != (front == Verdict::forbidden));
}

/// In units of 1/256 pixel: A (519.375, 509.875) → (519, 510), C (519.625, 510.375) → (520, 510),
/// and B behind the eye, w = −1, seen at (455.5, 510.125). The visible wedge opens from AC to the
/// right. Rounding turns AC from nearly upright to level, so that the line through the snapped edge
/// runs right through the wedge. At x = 3344 the wedge reaches from 498.8 to 521.4: a sample at 512
/// is more than nine units away from all sides, and no corner moves by more than one unit.
TEST(Clipping, AnEdgeShorterThanAUnitDoesNotDecideFarFromIt) {
  const auto at = [](float x, float y, float w) {
    return cases::ClipVertex{(x - 2048) / 2048 * w, (y - 2048) / 2048 * w, 0, w};
  };
  cases::Case c = small_case(
      cases::Rules::vulkan, 16, 16,
      {{at(519.375F, 509.875F, 1), at(519.625F, 510.375F, 1), at(455.5F, 510.125F, -1)}});
  c.framebuffer.samples = 16;
  c.depth_clamp = true;
  c.coverage = Snapping{8, Rounding::nearest_even, 0};
  const SceneTruth scene(c, cases::contract_of(c));
  constexpr int kAtOneSixteenthAndZero = 15;
  const records::SampleVerdict verdict =
      TriangleTruth(scene, 0).judge(13, 2, kAtOneSixteenthAndZero);
  EXPECT_EQ(verdict.verdict, Verdict::required);
  EXPECT_EQ(verdict.reason, Reason::inside);
}

TEST(Clipping, GivesACentreThatIsTheSampleTheSamplesValue) {
  // The triangle is cut by the near plane along u = 2, on a whole-pixel grid: a permitted sample
  // has a range of values, the same range wherever the attribute is located, because a pixel with
  // one sample has one place.
  cases::Case c =
      small_case(cases::Rules::d3d, 4, 4, {{{-1, 1, 0.5F, 1}, {3, 1, -1.5F, 1}, {-1, -3, 0.5F, 1}}},
                 {{{0, 0, 0}, {1, 1, 1}, {0, 0, 0}}});
  c.attributes[1].location = cases::Location::center;
  c.attributes[2].location = cases::Location::centroid;
  c.coverage = Snapping{0, Rounding::nearest_even, 0};
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  ASSERT_EQ(truth.judge(1, 2, 0).verdict, Verdict::permitted);
  const auto at_sample = truth.attribute(0, 1, 2, 0);
  for (const std::size_t other : {1U, 2U}) {
    const auto value = truth.attribute(other, 1, 2, 0);
    ASSERT_TRUE(value);
    EXPECT_EQ(value->lo, at_sample->lo);
    EXPECT_EQ(value->hi, at_sample->hi);
  }
  // r = u/8 on [1/2, 5/2] ∩ [0, 2].
  EXPECT_EQ(at_sample->lo.to_string(), "1/16");
  EXPECT_EQ(at_sample->hi.to_string(), "1/4");
}

TEST(Clipping, ByTheNearPlaneIsOpenAlongTheClipEdge) {
  // z/w = 1/2 − u/4 passes 0 at u = 2. Row 2 is more than a pixel away from the triangle's cut
  // edges.
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                             {{{-1, -1, 0.5F, 1}, {3, -1, -1.5F, 1}, {-1, 3, 0.5F, 1}}});
  c.coverage = Snapping{0, Rounding::nearest_even, 0};
  EXPECT_EQ(judge(c, 0, 2).verdict, Verdict::required);
  EXPECT_EQ(judge(c, 1, 2).verdict, Verdict::permitted);  // within a whole pixel of u = 2
  EXPECT_EQ(judge(c, 1, 2).reason, Reason::clip_edge);
  EXPECT_EQ(judge(c, 2, 2).verdict, Verdict::permitted);
  EXPECT_EQ(judge(c, 3, 2).verdict, Verdict::forbidden);
  EXPECT_EQ(judge(c, 0, 0).verdict, Verdict::permitted);  // within a pixel of the edge v = 0
  c.coverage = Snapping{4, Rounding::nearest_even, 0};
  EXPECT_EQ(judge(c, 1, 2).verdict, Verdict::required);
  EXPECT_EQ(judge(c, 2, 2).verdict, Verdict::forbidden);
}

// Kills: the product of the numbers of placements at both ends of an edge, 131073^4, computed in 64
// bits. On a grid of 2^-16 pixels the largest position error is a pixel.
TEST(Clipping, TakesTheGreatestPositionError) {
  cases::Case c = small_case(cases::Rules::vulkan, 8, 8,
                             {{{-1, -1, 0.5F, 1}, {3, -1, -1.5F, 1}, {-1, 3, 0.5F, 1}}});
  c.coverage = Snapping{16, Rounding::unspecified, cases::kMaxPositionError};
  EXPECT_EQ(judge(c, 2, 2).verdict, Verdict::required);
  EXPECT_EQ(judge(c, 0, 2).verdict, Verdict::permitted);
  EXPECT_EQ(judge(c, 7, 2).verdict, Verdict::forbidden);
}

}  // namespace
}  // namespace rastercheck::oracle::snapping_test
