// Splits of hand-made traces in which one stage has an error: the split gives this stage the whole
// error, to the last digit, and gives no error to the others.

#include "oracle/stage_split.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "oracle/internal/rational_number.h"
#include "oracle/transform.h"
#include "tests/oracle/stage_traces.h"

namespace rastercheck::oracle::stage_split_test {
namespace {

using records::SampleTrace;
using records::Stage;
using records::TracedValue;

/// The parts of an error that are not 0, as fractions, by stage.
using Parts = std::map<Stage, std::string>;

Rational ratio(int p, int q) { return to_rational(Field(p, q)); }
std::string difference(const Rational& a, const Rational& b) {
  return to_rational(to_field(a) - to_field(b)).to_string();
}

Parts parts_of(const std::optional<ExactSplit>& split) {
  if (!split) return {{Stage::excess, "no split"}};
  Parts parts;
  for (const ExactSplit::Part& part : split->parts) {
    if (part.error == Rational(0)) continue;
    EXPECT_TRUE(parts.emplace(part.stage, part.error.to_string()).second);
  }
  return parts;
}

/// A trace without errors for attribute 0 of sample (0, 0): its exact value is 1/8, and it is
/// evaluated by planes.
SampleTrace right_trace(const cases::Case& c) {
  SampleTrace trace = bare_trace(c, 0.5, 0.5);
  trace.frame = kFrame;
  TracedValue& value = trace.attributes[0];
  value.numerator = kQuarterU;
  value.denominator = kOne;
  value.numerator_at = 0.125;
  value.denominator_at = 1;
  value.evaluated = 0.125;
  value.value = 0.125F;
  return trace;
}

/// A trace that holds nothing but this value, for tests that add corners or lines which give it.
SampleTrace trace_ending_in(const cases::Case& c, double value) {
  SampleTrace trace = bare_trace(c, 0.5, 0.5);
  trace.attributes[0].evaluated = value;
  trace.attributes[0].value = static_cast<float>(value);
  return trace;
}

std::optional<ExactSplit> split(const cases::Case& c, const SampleTrace& trace,
                                std::optional<std::uint32_t> attribute = 0, std::uint32_t x = 0,
                                std::uint32_t y = 0) {
  const float actual = (attribute ? trace.attributes[*attribute] : trace.depth).value;
  const auto result =
      StageSplit(c, c, cases::contract_of(c), 0).traced(attribute, x, y, 0, actual, trace);
  EXPECT_TRUE(!result || adds_up(*result, actual));
  return result;
}

TEST(TracedSplit, NamesTheStagesThatWereTold) {
  const cases::Case c = traced_case();
  const auto result = split(c, right_trace(c));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->exact, ratio(1, 8));
  EXPECT_EQ(result->attribute, 0U);
  EXPECT_TRUE(result->is_traced);
  std::vector<Stage> stages;
  for (const ExactSplit::Part& part : result->parts) stages.push_back(part.stage);
  EXPECT_EQ(stages, (std::vector{Stage::transform, Stage::set_up, Stage::coverage, Stage::weights,
                                 Stage::evaluation, Stage::rounding}));
  EXPECT_EQ(parts_of(result), Parts{});
}

TEST(TracedSplit, TellsTheRoundingOfTheCamerasPositions) {
  // x is scaled by s = (1 + 2^-23)² = 1 + 2^-22 + 2^-46, which rounds to t = 1 + 2^-22. Vertices at
  // window x 2 ∓ 2s make r = 1/2 + (u − 2)/(4s), which is 1/2 − 3/(8s) at u = 1/2.
  cases::Case given = traced_case();
  given.camera.emplace();
  given.camera->model[0] = 0x1.000002p0F;
  given.camera->view[0] = 0x1.000002p0F;
  const cases::Case drawn = to_clip_case(given, "").value();
  ASSERT_EQ(drawn.positions[1].x, 0x1.000004p0F);
  const auto value_at_scale = [](const Field& s) {
    return to_rational(Field(1, 2) - Field(3) / (Field(8) * s));
  };
  const Field one_ulp = power_of_two(-23);
  const Rational exact = value_at_scale(Field(1) + Field(2) * one_ulp + one_ulp * one_ulp);
  const Rational of_rounded = value_at_scale(Field(1) + Field(2) * one_ulp);

  const StageSplit both(given, drawn, cases::contract_of(drawn), 0);
  const SampleTrace trace = trace_ending_in(drawn, 0.125);
  const auto traced = both.traced(0, 0, 0, 0, 0.125F, trace);
  ASSERT_TRUE(traced);
  EXPECT_EQ(traced->exact, exact);
  EXPECT_EQ(parts_of(traced), (Parts{{Stage::transform, difference(of_rounded, exact)},
                                     {Stage::evaluation, difference(ratio(1, 8), of_rounded)}}));
  EXPECT_EQ(parts_of(both.untraced(0, 0, 0, 0, 0.125F)),
            (Parts{{Stage::transform, difference(of_rounded, exact)},
                   {Stage::excess, difference(ratio(1, 8), of_rounded)}}));
}

TEST(TracedSplit, TellsPositionsThatWereNotTheCases) {
  const cases::Case c = traced_case();
  SampleTrace trace = trace_ending_in(c, 0.0625);
  trace.positions[1][0] = 3;  // window x 8: r = u/8
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::transform, "-1/16"}}));
}

TEST(TracedSplit, TellsAMovedCorner) {
  const cases::Case c = traced_case();
  SampleTrace trace = trace_ending_in(c, 0.1);
  trace.corners = window_corners();
  (*trace.corners)[1].x = 5;  // r = u/5
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::clip_space, "-1/40"},
                   {Stage::evaluation, difference(Rational(0.1), ratio(1, 10))},
                   {Stage::rounding, difference(Rational(0.1F), Rational(0.1))}}));
}

TEST(TracedSplit, TellsACornerThatClippingMade) {
  // Half-way between the first two vertices in clip space: w = 3/2, (X, Y) = (4, 0). With this
  // corner as column 1, e_1 = u/4 and 1/w = 1 − u/8, so that a share s of vertex 1 gives r = s u/4
  // / (1 − u/8).
  const cases::Case c = traced_case(2);
  SampleTrace trace = trace_ending_in(c, 0.0625);
  trace.corners = window_corners();
  (*trace.corners)[1] = {4, 0, 0.25, 1.5, true, {0.5, 0.5, 0}};
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::evaluation, difference(ratio(1, 16), ratio(1, 15))}}));
  (*trace.corners)[1].share = {0.25, 0.75, 0};
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::clip_space, "1/30"},
                   {Stage::evaluation, difference(ratio(1, 16), ratio(1, 10))}}));
}

TEST(TracedSplit, TellsSnapping) {
  const cases::Case c = traced_case();
  SampleTrace trace = trace_ending_in(c, 0.125);
  trace.corners = window_corners();
  trace.snapped = window_corners();
  (*trace.snapped)[1].x = 4.25;  // r = u/(17/4)
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::snap, "-1/136"}, {Stage::evaluation, "1/136"}}));
}

TEST(TracedSplit, TellsAWrongPlane) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c);
  TracedValue& value = trace.attributes[0];
  value.numerator->c += 0.125;
  value.numerator_at = 0.25;
  value.evaluated = 0.25;
  value.value = 0.25;
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::set_up, "1/8"}}));
  value.numerator = kQuarterU;
  value.denominator->b = -0.5;  // V = 1: (1/8)/(1/2)
  value.numerator_at = 0.125;
  value.denominator_at = 0.5;
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::set_up, "1/8"}}));
}

TEST(TracedSplit, TellsAWrongLine) {
  // With e_1 + V/16 instead of e_1, the noperspective value is 2 (1/16 + 1/16)/(3/4 + 1/4 + 1/8) =
  // 2/9 instead of 1/8.
  cases::Case c = traced_case(2);
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  SampleTrace trace = trace_ending_in(c, 0.125);
  trace.frame = kFrame;
  trace.lines = lines(2);
  for (records::TracedLine& line : *trace.lines) line = {3 * line.a, 3 * line.b, 3 * line.c};
  trace.attributes[0].is_from_lines = true;
  trace.attributes[0].weights = {{6, 0.5, 1}};  // each weight times eight
  EXPECT_EQ(parts_of(split(c, trace)), Parts{});
  (*trace.lines)[1].b += 3.0 / 16;
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::set_up, "7/72"}, {Stage::weights, "-7/72"}}));
}

TEST(TracedSplit, TakesNoLinesThatAValueDoesNotComeFrom) {
  const cases::Case c = traced_case();
  SampleTrace trace = trace_ending_in(c, 0.125);
  trace.frame = kFrame;
  trace.lines = lines();
  (*trace.lines)[1].b += 1;
  EXPECT_EQ(parts_of(split(c, trace)), Parts{});
}

TEST(TracedSplit, TellsAnotherPlace) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c);
  TracedValue& value = trace.attributes[0];
  value.u = 0.75;
  value.numerator_at = 0.1875;
  value.evaluated = 0.1875;
  value.value = 0.1875F;
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::coverage, "1/16"}}));
  // Without planes, the last corners are evaluated at that place.
  value = {.u = 0.75, .v = 0.5, .evaluated = 0.1875, .value = 0.1875F};
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::coverage, "1/16"}}));
}

TEST(TracedSplit, TellsWrongWeights) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c);
  TracedValue& value = trace.attributes[0];
  value.denominator_at = 0.5;
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::weights, "1/8"}, {Stage::evaluation, "-1/8"}}));
  value.numerator_at.reset();
  value.weights = {{6, 1, 1.5}};
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::weights, "-1/136"}, {Stage::evaluation, "1/136"}}));
}

TEST(TracedSplit, TakesSharesForWhatCornersHaveInTheValue) {
  // Shares of 3/4, 1/8, 1/8 in the values 0, 1, 0 give 1/8, whatever w is.
  cases::Case c = traced_case(2);
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  SampleTrace trace = trace_ending_in(c, 0.125);
  trace.attributes[0].shares = {{6, 1, 1}};
  EXPECT_EQ(parts_of(split(c, trace)), Parts{});
  trace.attributes[0].shares = {{6, 2, 0}};
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::weights, "1/8"}, {Stage::evaluation, "-1/8"}}));
  // A corner that clipping made half-way has 2/3 of vertex 1's value: (0 + 1·2)/2 over w = 3/2.
  trace.corners = window_corners();
  (*trace.corners)[1] = {4, 0, 0.25, 1.5, true, {0.5, 0.5, 0}};
  trace.attributes[0].shares = {{1, 3, 0}};
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::weights, "3/8"}, {Stage::evaluation, "-3/8"}}));
}

TEST(TracedSplit, TakesAValuesOwnCorners) {
  const cases::Case c = traced_case();
  SampleTrace trace = trace_ending_in(c, 0.125);
  trace.corners = window_corners();
  trace.snapped = window_corners();
  (*trace.corners)[1].x = 5;
  (*trace.snapped)[1].x = 4.25;
  TracedValue& value = trace.attributes[0];
  value.snapped = window_corners();
  EXPECT_EQ(parts_of(split(c, trace)), Parts{});
  (*value.snapped)[1].x = 8;  // r = u/8
  EXPECT_EQ(parts_of(split(c, trace)),
            (Parts{{Stage::snap, "-1/16"}, {Stage::evaluation, "1/16"}}));
}

TEST(TracedSplit, TakesNoCornersThatAValueDoesNotComeFrom) {
  const cases::Case c = traced_case();
  SampleTrace trace = trace_ending_in(c, 0.125);
  trace.snapped = window_corners();
  (*trace.snapped)[1].x = 4.25;
  trace.attributes[0].is_from_vertices = true;
  EXPECT_EQ(parts_of(split(c, trace)), Parts{});
}

TEST(TracedSplit, TellsEvaluationFromRounding) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c);
  trace.attributes[0].evaluated = 0.125 + 0x1p-30;
  const auto result = split(c, trace);
  EXPECT_EQ(parts_of(result),
            (Parts{{Stage::evaluation, "1/1073741824"}, {Stage::rounding, "-1/1073741824"}}));
  // A scale ULP is the ULP of the greatest vertex value, 1.
  const records::ErrorSplit record = enclose(*result);
  ASSERT_EQ(record.parts.size(), 6U);
  EXPECT_EQ(record.parts[4].error, (records::Enclosure{0x1p-7, 0x1p-7}));
  EXPECT_EQ(record.total, (records::Enclosure{0, 0}));
  EXPECT_EQ(record.attribute, 0U);
  EXPECT_TRUE(record.is_traced);
}

TEST(TracedSplit, GivesTheLastOperationsRoundingToIt) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c);
  trace.attributes[0].evaluated.reset();
  trace.attributes[0].value = 0.25F;
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::evaluation, "1/8"}}));
}

TEST(TracedSplit, LeavesOutAStageWithoutAValue) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c);
  TracedValue& value = trace.attributes[0];
  value.denominator = {0, 0, 0};
  value.denominator_at = 0;
  value.numerator_at = std::numeric_limits<double>::quiet_NaN();
  value.evaluated = 0.25;
  value.value = 0.25F;
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::evaluation, "1/8"}}));
  value.numerator->a = std::numeric_limits<double>::infinity();
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::evaluation, "1/8"}}));
  value.evaluated = std::numeric_limits<double>::infinity();
  trace.corners = window_corners();
  (*trace.corners)[2].share[1] = std::numeric_limits<double>::quiet_NaN();
  trace.snapped = window_corners();
  (*trace.snapped)[2] = (*trace.snapped)[0];
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::evaluation, "1/8"}}));
}

TEST(TracedSplit, OfAFlatAttributeIsACopys) {
  cases::Case c = traced_case();
  c.attributes[0].interpolation = cases::Interpolation::flat;
  c.attribute_values = {3, 4, 5};
  SampleTrace trace = trace_ending_in(c, 4);
  trace.positions[1][0] = 3;
  EXPECT_EQ(parts_of(split(c, trace)), (Parts{{Stage::evaluation, "1"}}));
}

TEST(TracedSplit, OfDepthIsByItsOwnPlane) {
  const cases::Case c = traced_case();  // z/w = u/8
  SampleTrace trace = bare_trace(c, 0.5, 0.5);
  trace.frame = kFrame;
  trace.corners = window_corners();
  trace.depth.numerator = {1.0 / 32, 1.0 / 16, 1.0 / 4};  // u/8 + v/8
  trace.depth.evaluated = 0.125;
  trace.depth.value = 0.125F;
  EXPECT_EQ(parts_of(split(c, trace, std::nullopt)), (Parts{{Stage::set_up, "1/16"}}));
  (*trace.corners)[2].z = 0.25;  // z/w has v/16 more
  EXPECT_EQ(parts_of(split(c, trace, std::nullopt)),
            (Parts{{Stage::clip_space, "1/32"}, {Stage::set_up, "1/32"}}));
}

TEST(TracedSplit, OfDepthFollowsTheRules) {
  cases::Case c = traced_case(1, cases::Rules::opengl);
  for (cases::ClipVertex& p : c.positions) p.y = -p.y;
  c.viewport.min_depth = 0.5;
  // 1/2 + (1/2)(u/8 + 1)/2 at u = 1/2: 49/64.
  SampleTrace trace = bare_trace(c, 0.5, 0.5);
  trace.corners = window_corners();
  trace.depth.evaluated = 49.0 / 64;
  trace.depth.value = 49.0F / 64;
  EXPECT_EQ(parts_of(split(c, trace, std::nullopt)), Parts{});
  EXPECT_EQ(split(c, trace, std::nullopt)->unit, to_rational(power_of_two(-23)));
}

TEST(TracedSplit, OfDepthIsClampedWhereTheRulesClamp) {
  cases::Case c = traced_case();
  for (cases::ClipVertex& p : c.positions) p.z = 2;
  c.depth_clamp = true;
  c.viewport.max_depth = 0.75F;
  SampleTrace trace = bare_trace(c, 0.5, 0.5);
  trace.frame = kFrame;
  trace.depth.numerator = {0, 0, 3};
  trace.depth.numerator_at = 4;
  trace.depth.evaluated = 0.75;
  trace.depth.value = 0.75F;
  EXPECT_EQ(parts_of(split(c, trace, std::nullopt)), Parts{});
}

/// Attribute 0 is u. There are four samples; sample 0 of pixel (3, 0), at (27/8, 1/8), is covered,
/// and sample 3 is not.
cases::Case centroid_case(cases::Rules rules) {
  cases::Case c = traced_case(1, rules);
  c.framebuffer.samples = 4;
  c.attributes[0].location = cases::Location::centroid;
  c.attribute_values = {0, 4, 0};
  return c;
}

Parts centroid_parts(cases::Rules rules, double u, double v, Rational* exact) {
  const cases::Case c = centroid_case(rules);
  SampleTrace trace = bare_trace(c, 3.375, 0.125);
  trace.attributes[0] = {.u = u, .v = v, .evaluated = u, .value = static_cast<float>(u)};
  const auto result = split(c, trace, 0, 3, 0);
  if (result) *exact = result->exact;
  return parts_of(result);
}

TEST(TracedSplit, OfACentroidTakesAnyPlaceThatIsAllowed) {
  Rational exact;
  EXPECT_EQ(centroid_parts(cases::Rules::vulkan, 3.25, 0.25, &exact), Parts{});
  EXPECT_EQ(exact, ratio(13, 4));
  EXPECT_EQ(centroid_parts(cases::Rules::vulkan, 3.75, 0.75, &exact),
            (Parts{{Stage::coverage, "3/8"}}));
  EXPECT_EQ(exact, ratio(27, 8));
  // Inside the triangle, but in the next pixel.
  EXPECT_EQ(centroid_parts(cases::Rules::vulkan, 2.5, 0.25, &exact),
            (Parts{{Stage::coverage, "-7/8"}}));
}

TEST(TracedSplit, OfACentroidOfD3dTakesTheFirstCoveredSample) {
  Rational exact;
  EXPECT_EQ(centroid_parts(cases::Rules::d3d, 3.375, 0.125, &exact), Parts{});
  EXPECT_EQ(centroid_parts(cases::Rules::d3d, 3.25, 0.25, &exact),
            (Parts{{Stage::coverage, "-1/8"}}));
  EXPECT_EQ(exact, ratio(27, 8));
}

TEST(TracedSplit, IsOfFiniteDrawnValuesOnly) {
  const cases::Case c = traced_case();
  const StageSplit triangle(c, c, cases::contract_of(c), 0);
  SampleTrace trace = right_trace(c);
  EXPECT_TRUE(triangle.traced(0, 0, 0, 0, 0.125F, trace));
  EXPECT_FALSE(triangle.traced(0, 0, 0, 0, 0.25F, trace));
  EXPECT_FALSE(triangle.traced(1, 0, 0, 0, 0.125F, trace));
  trace.is_drawn = false;
  EXPECT_FALSE(triangle.traced(0, 0, 0, 0, 0.125F, trace));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  trace = right_trace(c);
  trace.attributes[0].value = nan;
  EXPECT_FALSE(triangle.traced(0, 0, 0, 0, nan, trace));
  EXPECT_FALSE(triangle.untraced(0, 0, 0, 0, nan));
}

TEST(TracedSplit, IsOfDefinedValuesOnly) {
  cases::Case c = traced_case(-1);  // 1/w = 1 − u/2
  c.attributes[0].location = cases::Location::center;
  const StageSplit triangle(c, c, cases::contract_of(c), 0);
  EXPECT_FALSE(triangle.traced(0, 2, 0, 0, 1, [&] {
    SampleTrace trace = bare_trace(c, 2.5, 0.5);
    trace.attributes[0].value = 1;
    return trace;
  }()));
  EXPECT_FALSE(triangle.untraced(0, 2, 0, 0, 1));
  EXPECT_TRUE(triangle.untraced(0, 1, 0, 0, 1));
}

TEST(AddsUp, IsFalseWhereAPartLacks) {
  const cases::Case c = traced_case();
  SampleTrace trace = right_trace(c);
  trace.attributes[0].evaluated = 0.125 + 0x1p-30;
  auto result = split(c, trace);
  ASSERT_TRUE(result && adds_up(*result, 0.125F));
  EXPECT_FALSE(adds_up(*result, 0x1.000002p-3F));
  result->parts.pop_back();
  EXPECT_FALSE(adds_up(*result, 0.125F));
}

/// Vertex 1 is at window x = 4 + 1/64, which snaps to 4 on a grid of sixteenths: r = u/(4 + 1/64),
/// which is 32/257 instead of 1/8 at u = 1/2.
cases::Case snapped_case(cases::Basis basis, cases::Rounding rounding) {
  cases::Case c = traced_case();
  c.positions[1].x = 1 + 0x1p-7F;
  c.coverage = cases::Snapping{4, rounding, 0};
  c.basis = basis;
  return c;
}

Parts untraced(const cases::Case& c, float actual) {
  const auto result = StageSplit(c, c, cases::contract_of(c), 0).untraced(0, 0, 0, 0, actual);
  if (result) {
    EXPECT_TRUE(adds_up(*result, actual));
    EXPECT_FALSE(result->is_traced);
  }
  return parts_of(result);
}

TEST(UntracedSplit, PartsSnappingFromTheExcess) {
  const auto even = cases::Rounding::nearest_even;
  const float actual = 0.125F + 0x1p-20F;
  EXPECT_EQ(untraced(snapped_case(cases::Basis::snapped, even), actual),
            (Parts{{Stage::left_open, "1/2056"}, {Stage::excess, "1/1048576"}}));
  EXPECT_EQ(untraced(snapped_case(cases::Basis::ideal, even), actual),
            (Parts{{Stage::excess, difference(Rational(actual), ratio(32, 257))}}));
}

TEST(UntracedSplit, LeavesAllOpenWithinTheRange) {
  const cases::Case c = snapped_case(cases::Basis::unspecified, cases::Rounding::unspecified);
  // The range is from u/(4 + 1/16) to u/4: [8/65, 1/8].
  EXPECT_EQ(untraced(c, 0.1243F),
            (Parts{{Stage::left_open, difference(Rational(0.1243F), ratio(32, 257))}}));
  EXPECT_EQ(untraced(c, 0.25F), (Parts{{Stage::left_open, "1/2056"}, {Stage::excess, "1/8"}}));
}

TEST(UntracedSplit, LeavesAllOpenThatTheRulesLeaveFree) {
  cases::Case c = traced_case(-1);
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  EXPECT_EQ(untraced(c, 0.5F), (Parts{{Stage::left_open, "3/8"}}));
}

TEST(UntracedSplit, OfACentroidStartsAtTheFirstCoveredSample) {
  const cases::Case c = centroid_case(cases::Rules::vulkan);
  const StageSplit triangle(c, c, cases::contract_of(c), 0);
  // The range is that of u within the pixel and the triangle: [3, 4].
  EXPECT_EQ(parts_of(triangle.untraced(0, 3, 0, 0, 3.5F)), (Parts{{Stage::left_open, "1/8"}}));
  EXPECT_EQ(parts_of(triangle.untraced(0, 3, 0, 0, 5)),
            (Parts{{Stage::left_open, "5/8"}, {Stage::excess, "1"}}));
}

}  // namespace
}  // namespace rastercheck::oracle::stage_split_test
