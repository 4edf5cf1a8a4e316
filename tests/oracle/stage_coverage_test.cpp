// Hand-made traces in which one stage loses a sample or draws one too many: the split names that
// stage.

#include <gtest/gtest.h>

#include "oracle/stage_split.h"
#include "tests/oracle/stage_traces.h"

namespace rastercheck::oracle::stage_coverage_test {
namespace {

using records::SampleTrace;
using records::Stage;

/// A trace without errors. The triangle covers pixel (1, 1) but not pixel (3, 3); the centre of
/// pixel (3, 0) lies on its hypotenuse, which owns no samples.
SampleTrace right_trace(const cases::Case& c, std::uint32_t x, std::uint32_t y, bool is_drawn) {
  SampleTrace trace = bare_trace(c, x + 0.5, y + 0.5);
  trace.is_drawn = is_drawn;
  trace.frame = kFrame;
  trace.lines = lines();
  const double u = trace.u;
  const double v = trace.v;
  trace.edges = {{1 - (u + v) / 4, u / 4, v / 4}};
  trace.decision = "in_double";
  return trace;
}

std::optional<Stage> stage_of(const cases::Case& c, std::uint32_t x, std::uint32_t y,
                              const SampleTrace& trace) {
  return StageSplit(c, c, cases::contract_of(c), 0).coverage_stage(x, y, 0, trace.is_drawn, &trace);
}

cases::Case snapped_case() {
  cases::Case c = traced_case();
  c.coverage = cases::Snapping{4, cases::Rounding::nearest_even, 0};
  c.basis = cases::Basis::snapped;
  return c;
}

TEST(CoverageStage, IsNothingWhereCoverageIsRight) {
  const cases::Case c = traced_case();
  EXPECT_EQ(stage_of(c, 1, 1, right_trace(c, 1, 1, true)), std::nullopt);
  EXPECT_EQ(stage_of(c, 3, 3, right_trace(c, 3, 3, false)), std::nullopt);
}

TEST(CoverageStage, IsNothingWhereEitherIsRight) {
  const cases::Case c = traced_case();
  cases::Contract contract = cases::contract_of(c);
  contract.tie_rule = cases::TieRule::unspecified;
  const StageSplit triangle(c, c, contract, 0);
  const SampleTrace trace = right_trace(c, 3, 0, true);
  EXPECT_EQ(triangle.coverage_stage(3, 0, 0, true, &trace), std::nullopt);
}

TEST(CoverageStage, IsTheDecisionWhereAllElseIsRight) {
  const cases::Case c = traced_case();
  EXPECT_EQ(stage_of(c, 1, 1, right_trace(c, 1, 1, false)), Stage::coverage);
  EXPECT_EQ(stage_of(c, 3, 3, right_trace(c, 3, 3, true)), Stage::coverage);
  EXPECT_EQ(stage_of(c, 3, 0, right_trace(c, 3, 0, true)), Stage::coverage);
}

TEST(CoverageStage, IsTheDecisionOfATriangleWithoutATrace) {
  const cases::Case c = traced_case();
  const StageSplit triangle(c, c, cases::contract_of(c), 0);
  EXPECT_EQ(triangle.coverage_stage(1, 1, 0, false, nullptr), Stage::coverage);
  EXPECT_EQ(triangle.coverage_stage(1, 1, 0, true, nullptr), std::nullopt);
  // A sample drawn without a trace does not show which stage failed.
  EXPECT_EQ(triangle.coverage_stage(3, 3, 0, true, nullptr), std::nullopt);
}

TEST(CoverageStage, IsEmptyIfTheTraceIsOfAnotherDrawing) {
  const cases::Case c = traced_case();
  const SampleTrace trace = right_trace(c, 1, 1, true);
  const StageSplit triangle(c, c, cases::contract_of(c), 0);
  EXPECT_EQ(triangle.coverage_stage(1, 1, 0, false, &trace), std::nullopt);
}

TEST(CoverageStage, IsTheTransformOfOtherPositions) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c, 1, 1, false);
  for (auto& p : trace.positions) p[0] += 4;  // two widths to the right
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::transform);
}

TEST(CoverageStage, IsTheSnapThatMovedACorner) {
  const cases::Case c = snapped_case();
  SampleTrace trace = right_trace(c, 1, 1, false);
  trace.corners = window_corners();
  trace.snapped = window_corners();
  (*trace.snapped)[2].y = 1;
  trace.decision = "in_whole_numbers";
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::snap);
  (*trace.corners)[2].y = 1;
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::clip_space);
}

TEST(CoverageStage, DoesNotTellCornersFromWhatSnappingMends) {
  // The left edge at u = 1/2 owns the first sample. A corner at 0.52 snaps to 1/2 on the grid,
  // although without snapping it would leave the sample outside.
  cases::Case c = snapped_case();
  c.positions[0].x = -0.75F;
  c.positions[2].x = -0.75F;
  SampleTrace trace = right_trace(c, 0, 0, false);
  trace.decision = "in_whole_numbers";
  trace.corners = window_corners();
  (*trace.corners)[0].x = 0.52;
  (*trace.corners)[2].x = 0.5;
  EXPECT_EQ(stage_of(c, 0, 0, trace), Stage::coverage);
  (*trace.corners)[0].x = 0.6;
  EXPECT_EQ(stage_of(c, 0, 0, trace), Stage::clip_space);
}

TEST(CoverageStage, IsTheCornersOfAPartThatReachesTooFar) {
  // z/w = (u + v)/2: beyond u + v = 2 the triangle is clipped.
  cases::Case c = snapped_case();
  c.positions[1].z = 2;
  c.positions[2].z = 2;
  SampleTrace trace = right_trace(c, 2, 0, true);
  trace.decision = "in_whole_numbers";
  trace.corners = window_corners();
  (*trace.corners)[1] = {3.5, 0, 1.75, 1, false, {0.125, 0.875, 0}};
  EXPECT_EQ(stage_of(c, 2, 0, trace), Stage::clip_space);
  // Without corners, the trace does not show what clipping should have left of the triangle.
  trace.corners.reset();
  EXPECT_EQ(stage_of(c, 2, 0, trace), Stage::coverage);
}

TEST(CoverageStage, IsNotToldOfASampleThatACutTriangleLacks) {
  cases::Case c = snapped_case();
  c.positions[1].z = 2;
  SampleTrace trace = right_trace(c, 0, 0, false);
  trace.corners = window_corners();
  EXPECT_EQ(stage_of(c, 0, 0, trace), Stage::coverage);
  (*trace.corners)[1].share = {0.5, 0.5, 0};
  EXPECT_EQ(stage_of(c, 0, 0, trace), std::nullopt);
}

TEST(CoverageStage, IsTheSetUpOfAWrongLine) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c, 1, 1, false);
  (*trace.lines)[0].c = 0;  // −(u + v)/4 + 1/2
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::set_up);
  // Lines that were not used for the decision are not blamed.
  trace.decision = "exactly";
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::coverage);
}

TEST(CoverageStage, IsCoverageWhereTheSampleWasTakenToBeElsewhere) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c, 1, 1, false);
  trace.u = 3.5;
  trace.edges = {{-0.25, 0.875, 0.375}};
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::coverage);
}

TEST(CoverageStage, IsTheWeightsThatWereComputedWrong) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c, 1, 1, false);
  trace.edges = {{-0.25, 0.375, 0.375}};
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::weights);
  trace.edges = {{0, 0.375, 0.375}};  // a tie is no evidence
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::coverage);
}

TEST(CoverageStage, IsCoverageForSamplesOutsideTheScissor) {
  cases::Case c = traced_case();
  c.scissor = cases::Scissor{2, 2, 2, 2};
  SampleTrace trace = right_trace(c, 1, 1, true);
  (*trace.lines)[0].c = 1;  // counts as inside even more clearly
  EXPECT_EQ(stage_of(c, 1, 1, trace), Stage::coverage);
}

}  // namespace
}  // namespace rastercheck::oracle::stage_coverage_test
