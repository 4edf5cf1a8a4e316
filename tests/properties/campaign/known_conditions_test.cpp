#include "properties/campaign/internal/known_conditions.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::known_conditions_test {
namespace {

using records::KnownConditions;
using records::KnownFact;
using records::KnownLimit;
using records::Violation;

using Change = std::function<void(cases::Case&)>;

/// True if a violation at the first triangle of the square, after `change`, meets the conditions.
bool is_met(const KnownConditions& when, const Change& change = {},
            const Violation& violation = {}) {
  cases::Case c = square();
  if (change) change(c);
  return meets(when, c, violation);
}

bool has(KnownFact fact, const Change& change = {}) {
  KnownConditions is;
  is.facts[fact] = true;
  KnownConditions is_not;
  is_not.facts[fact] = false;
  const bool met = is_met(is, change);
  EXPECT_NE(met, is_met(is_not, change));
  return met;
}

bool is_within(KnownLimit limit, double number, const Change& change = {},
               const Violation& violation = {}) {
  KnownConditions when;
  when.limits[limit] = number;
  return is_met(when, change, violation);
}

TEST(KnownConditions, AskOfTheTrianglesVertices) {
  EXPECT_FALSE(has(KnownFact::nonpositive_w));
  EXPECT_TRUE(has(KnownFact::nonpositive_w, [](auto& c) { c.positions[1].w = 0; }));
  // Vertex 3 belongs to the other triangle.
  EXPECT_FALSE(has(KnownFact::nonpositive_w, [](auto& c) { c.positions[3].w = -1; }));
}

TEST(KnownConditions, KnowWhatIsClipped) {
  EXPECT_FALSE(has(KnownFact::clipped));
  EXPECT_TRUE(has(KnownFact::clipped, [](auto& c) { c.positions[0].x = -1.5F; }));
  EXPECT_TRUE(has(KnownFact::clipped, [](auto& c) { c.positions[0].z = 1.5F; }));
  EXPECT_TRUE(has(KnownFact::clipped, [](auto& c) {
    c.clip_distance_count = 1;
    c.clip_distances = {1, -1, 1, 1};
  }));
  const auto below = [](auto& c) { c.positions[0].z = -0.5F; };
  EXPECT_TRUE(has(KnownFact::depth_clipped, below));
  EXPECT_FALSE(has(KnownFact::depth_clipped, [&below](auto& c) {
    below(c);
    c.rules = cases::Rules::opengl;
  }));
  EXPECT_FALSE(has(KnownFact::depth_clipped, [&below](auto& c) {
    below(c);
    c.depth_clamp = true;
  }));
}

TEST(KnownConditions, AskOfTheCase) {
  const auto is_so = [](KnownFact fact, const Change& change) {
    EXPECT_FALSE(has(fact));
    EXPECT_TRUE(has(fact, change));
  };
  is_so(KnownFact::clip_distances, [](auto& c) {
    c.clip_distance_count = 1;
    c.clip_distances = {1, 1, 1, 1};
  });
  is_so(KnownFact::depth_clamp, [](auto& c) { c.depth_clamp = true; });
  is_so(KnownFact::depth_test, [](auto& c) { c.depth_test = cases::DepthTest::less; });
  is_so(KnownFact::depth_bias, [](auto& c) { c.depth_bias.slope = 1; });
  is_so(KnownFact::unorm_depth, [](auto& c) { c.depth_format = cases::DepthFormat::unorm16; });
  is_so(KnownFact::scissor, [](auto& c) { c.scissor.emplace(); });
  is_so(KnownFact::culling, [](auto& c) { c.cull = cases::Cull::back; });
  is_so(KnownFact::reversed_depth_range, [](auto& c) {
    c.viewport.min_depth = 1;
    c.viewport.max_depth = 0;
  });
  is_so(KnownFact::negative_height, [](auto& c) { c.viewport.height = -8; });
  is_so(KnownFact::fractional_viewport, [](auto& c) { c.viewport.width = 7.5F; });
  is_so(KnownFact::beyond_viewport, [](auto& c) { c.viewport.x = 4; });
}

TEST(KnownConditions, MeasureTheTriangle) {
  // The triangle spans 8 × 8 pixels, with its right angle at the origin.
  EXPECT_TRUE(is_within(KnownLimit::largest_coordinate_at_least, 8));
  EXPECT_FALSE(is_within(KnownLimit::largest_coordinate_at_least, 8.01));
  EXPECT_TRUE(is_within(KnownLimit::largest_coordinate_at_least, 1e30,
                        [](auto& c) { c.positions[0].w = 0; }));
  EXPECT_FALSE(is_within(KnownLimit::height_at_most, 5.65));
  EXPECT_TRUE(is_within(KnownLimit::height_at_most, 5.66));  // 8 / sqrt 2
  EXPECT_FALSE(is_within(KnownLimit::height_at_most, 100, [](auto& c) { c.positions[0].w = -1; }));
  const auto far = [](auto& c) { c.positions[0].w = -16; };
  EXPECT_TRUE(is_within(KnownLimit::w_ratio_at_least, 16, far));
  EXPECT_FALSE(is_within(KnownLimit::point_size_at_most, 2));
  const auto points = [](auto& c) {
    c.primitive = cases::Primitive::points;
    c.point_size = 2;
  };
  EXPECT_TRUE(is_within(KnownLimit::point_size_at_most, 2, points));
  EXPECT_FALSE(is_within(KnownLimit::point_size_at_most, 1.5, points));
  EXPECT_FALSE(is_within(KnownLimit::w_ratio_at_least, 16.5, far));
}

TEST(KnownConditions, MeasureTheViolation) {
  Violation violation;
  EXPECT_FALSE(is_within(KnownLimit::error_at_most, 1000, {}, violation));  // without an error
  violation.error = records::Enclosure{-3, -2};
  EXPECT_TRUE(is_within(KnownLimit::error_at_most, 3, {}, violation));
  EXPECT_FALSE(is_within(KnownLimit::error_at_most, 2.5, {}, violation));
  EXPECT_FALSE(is_within(KnownLimit::distance_at_most, 1000, {}, violation));
  violation.distance = records::Enclosure{0.25, 0.25};
  EXPECT_TRUE(is_within(KnownLimit::distance_at_most, 0.25, {}, violation));
  EXPECT_FALSE(is_within(KnownLimit::distance_at_most, 0.2, {}, violation));
}

TEST(KnownConditions, MeasureTheAttribute) {
  Violation violation;
  EXPECT_FALSE(is_within(KnownLimit::largest_value_at_least, 0, {}, violation));  // no attribute
  violation.attribute = 0;                                                        // values 0, 8, 0
  EXPECT_TRUE(is_within(KnownLimit::largest_value_at_least, 8, {}, violation));
  EXPECT_FALSE(is_within(KnownLimit::largest_value_at_least, 9, {}, violation));
  EXPECT_TRUE(is_within(KnownLimit::least_value_at_most, 8, {}, violation));
  EXPECT_FALSE(is_within(KnownLimit::least_value_at_most, 7, {}, violation));
  violation.attribute = 2;  // zero everywhere
  EXPECT_FALSE(is_within(KnownLimit::least_value_at_most, 7, {}, violation));
}

TEST(KnownConditions, TakeOneOfEachList) {
  KnownConditions when;
  when.rules = {cases::Rules::opengl, cases::Rules::vulkan};
  when.samples = {1};
  EXPECT_TRUE(is_met(when));
  when.samples = {2, 4};
  EXPECT_FALSE(is_met(when));
  when = {};
  when.attribute_kinds = {records::AttributeKind::coverage};
  EXPECT_TRUE(is_met(when));
  when.attribute_kinds = {records::AttributeKind::depth};
  EXPECT_FALSE(is_met(when));
}

TEST(KnownConditions, AskOfTheViolationsAttribute) {
  KnownConditions when;
  when.interpolations = {cases::Interpolation::noperspective};
  when.locations = {cases::Location::centroid};
  const auto change = [](auto& c) {
    c.attributes[1].interpolation = cases::Interpolation::noperspective;
    c.attributes[1].location = cases::Location::centroid;
  };
  Violation violation;
  EXPECT_FALSE(is_met(when, change, violation));  // no attribute
  violation.attribute = 1;
  EXPECT_TRUE(is_met(when, change, violation));
  violation.attribute = 0;
  EXPECT_FALSE(is_met(when, change, violation));
}

TEST(KnownConditions, FindAPartOfTheNote) {
  KnownConditions when;
  when.note = "lost";
  Violation violation;
  EXPECT_FALSE(is_met(when, {}, violation));
  violation.note = "device lost";
  EXPECT_TRUE(is_met(when, {}, violation));
}

// Kills: ignoring conditions about triangles if there was no drawing.
TEST(KnownConditions, AskOfSomeTriangleWhereNothingWasDrawn) {
  Violation violation;
  violation.fragment_class = records::FragmentClass::crash;
  KnownConditions when;
  when.facts[KnownFact::nonpositive_w] = true;
  EXPECT_FALSE(is_met(when, {}, violation));
  EXPECT_TRUE(is_met(
      when, [](auto& c) { c.positions[3].w = 0; }, violation));
}

TEST(KnownConditions, KnowDepthPlanesWithDepthClampToo) {
  const auto clamped = [](float z) {
    return [z](cases::Case& c) {
      c.positions[0].z = z;
      c.depth_clamp = true;
    };
  };
  EXPECT_FALSE(has(KnownFact::before_near));
  EXPECT_TRUE(has(KnownFact::before_near, clamped(-0.5F)));
  EXPECT_FALSE(has(KnownFact::before_near, clamped(1.5F)));
  EXPECT_FALSE(has(KnownFact::beyond_far));
  EXPECT_TRUE(has(KnownFact::beyond_far, clamped(1.5F)));
}

TEST(KnownConditions, KnowPerspectiveAndState) {
  EXPECT_FALSE(has(KnownFact::perspective));
  EXPECT_TRUE(has(KnownFact::perspective, [](auto& c) { c.positions[2].w = 2; }));
  EXPECT_FALSE(has(KnownFact::snapped));
  EXPECT_TRUE(has(KnownFact::snapped, [](auto& c) { c.coverage = cases::Snapping{}; }));
  EXPECT_FALSE(has(KnownFact::depth_clear));
  EXPECT_TRUE(has(KnownFact::depth_clear, [](auto& c) { c.depth_clear = 0.5F; }));
}

TEST(KnownConditions, KnowTiesAndDegenerateTriangles) {
  const auto is = [](KnownFact fact, std::optional<records::Enclosure> distance) {
    KnownConditions when;
    when.facts[fact] = true;
    Violation violation;
    violation.fragment_class = records::FragmentClass::extra;
    violation.distance = distance;
    return is_met(when, {}, violation);
  };
  EXPECT_TRUE(is(KnownFact::tie, records::Enclosure{0, 0}));
  EXPECT_FALSE(is(KnownFact::tie, records::Enclosure{0, 0x1p-60}));
  EXPECT_FALSE(is(KnownFact::tie, std::nullopt));
  EXPECT_TRUE(is(KnownFact::degenerate, std::nullopt));
  EXPECT_FALSE(is(KnownFact::degenerate, records::Enclosure{0, 0}));
}

}  // namespace
}  // namespace rastercheck::properties::known_conditions_test
