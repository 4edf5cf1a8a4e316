// Triangle A of the square (tests/properties/damaged_backend.h): e = (1 − u/8 − v/8, u/8, v/8), all
// w = 1, and attribute x is u. At pixel (2, 1): (5/2, 3/2), e = (1/2, 5/16, 3/16).

#include "properties/inspect/inspect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "properties/drawing.h"
#include "properties/inspect/case_to_draw.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::inspect_test {
namespace {

using records::Enclosure;
using records::InspectedSample;
using records::InspectedValue;
using records::Inspection;
using records::WindowPoint;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Enclosure exactly(double value) { return {value, value}; }

/// Finds the inspected sample of a pixel, which must be in the inspection.
InspectedSample sample_of(const Inspection& inspection, std::uint32_t x, std::uint32_t y) {
  for (const InspectedSample& one : inspection.samples) {
    if (one.place.x == x && one.place.y == y) return one;
  }
  ADD_FAILURE() << "no pixel (" << x << ", " << y << ")";
  return {};
}

std::array<std::uint32_t, 4> crop_of(const Inspection& inspection) {
  return {inspection.left, inspection.top, inspection.width, inspection.height};
}

Result<Inspection> inspected(const cases::Case& c, backends::Backend& backend, const Focus& focus,
                             const InspectOptions& options = {}) {
  const cases::ClipCase clip = case_to_draw(c).value();
  return inspect(clip, draw(clip, backend).value(), focus, trace_sample(clip, focus.at, backend),
                 options);
}

Inspection inspection_of(const Focus& focus, const Damage& damage, const cases::Case& c = square(),
                         const InspectOptions& options = {}) {
  DamagedBackend backend(damage, "cpu");
  return inspected(c, backend, focus, options).value();
}

// The scale ULP of x is ulp(8) = 2^-20, its local ULP ulp(5/2) = 2^-22.
TEST(Inspect, SaysWhatIsExactAndWhatWasDrawn) {
  const Inspection found = inspection_of(
      {{0, 1, 2, 0}, 0},
      [](const cases::Case&, cases::Fragments& d) { value(d, 0, 2, 1, 0) += 0x1p-21F; });
  EXPECT_THAT(found.q_matrix.value(),
              ElementsAre(ElementsAre("-1/8", "-1/8", "1"), ElementsAre("1/8", "0", "0"),
                          ElementsAre("0", "1/8", "0")));
  EXPECT_THAT(found.pattern, ElementsAre(WindowPoint{0.5, 0.5}));
  ASSERT_THAT(found.outlines, SizeIs(2));
  EXPECT_THAT(found.outlines[1],
              ElementsAre(WindowPoint{0, 8}, WindowPoint{8, 0}, WindowPoint{8, 8}));
  EXPECT_EQ(found.attribute, 0U);
  const InspectedSample sample = sample_of(found, 2, 1);
  EXPECT_EQ(sample.verdict, records::Verdict::required);
  EXPECT_EQ(sample.reason, records::Reason::inside);
  EXPECT_TRUE(sample.is_drawn);
  EXPECT_EQ(sample.distance, exactly(1.5));
  EXPECT_THAT(sample.edges.value(), ElementsAre(exactly(0.5), exactly(0.3125), exactly(0.1875)));
  ASSERT_THAT(sample.values, SizeIs(4));
  EXPECT_EQ(sample.values[0].attribute, std::nullopt);
  EXPECT_EQ(sample.values[0].exact, "1/4");
  EXPECT_EQ(sample.values[0].actual, 0.25F);
  const InspectedValue& x = sample.values[1];
  EXPECT_EQ(x.attribute, 0U);
  EXPECT_EQ(x.exact, "5/2");
  EXPECT_EQ(x.nearest, 2.5);
  EXPECT_EQ(x.actual, 2.5F + 0x1p-21F);
  EXPECT_EQ(x.scale_error, exactly(0.5));
  EXPECT_EQ(x.local_error, exactly(2));
  EXPECT_EQ(x.excess, exactly(0.5));
  EXPECT_EQ(x.kappa, exactly(1));
  EXPECT_EQ(x.kappa_d, exactly(1.5));               // for e_0: 5/16 + 3/16 + 1
  EXPECT_EQ(sample.values[3].kappa, std::nullopt);  // 0 everywhere
}

// Kills: an excess although the contract leaves the value open; an error measured from the
// permitted range.
TEST(Inspect, TellsErrorFromExcess) {
  DamagedBackend backend(
      [](const cases::Case&, cases::Fragments& d) { value(d, 0, 2, 1, 0) += 0.25F; }, "cpu");
  cases::Contract open = cases::contract_of(square());
  open.coverage = cases::Snapping{0, cases::Rounding::unspecified, 0};
  open.basis = cases::Basis::snapped;  // each vertex may be up to a pixel off
  backend.promised = open;
  cases::Case c = square();
  c.coverage = open.coverage;
  c.basis = open.basis;
  for (cases::ClipVertex& p : c.positions) p.x -= 0.125F;  // half a pixel: between grid points
  const Inspection found = inspected(c, backend, {{0, 1, 2, 0}, 0}).value();
  const InspectedValue x = sample_of(found, 2, 1).values.at(1);
  EXPECT_EQ(x.exact, "3");
  // The vertices snap back by half a pixel, where x is 2 1/2, and the damage adds 1/4. So x was
  // drawn 1/4 below its exact value, 3, and the contract allows this.
  EXPECT_EQ(x.scale_error, exactly(-0x1p18));
  EXPECT_EQ(x.excess, exactly(0));
}

// (13/2, 11/2) lies outside A, but the attribute x extends beyond A.
TEST(Inspect, ShowsValuesWhereDrawnOrNotForbidden) {
  const Inspection found =
      inspection_of({{0, 1, 2, 0}}, [](const cases::Case&, cases::Fragments& d) {
        drop(d, 0, 2, 1);
        add(d, 0, 6, 5);
      });
  const InspectedSample missing = sample_of(found, 2, 1);
  EXPECT_FALSE(missing.is_drawn);
  ASSERT_THAT(missing.values, SizeIs(4));
  EXPECT_EQ(missing.values[1].exact, "5/2");
  EXPECT_EQ(missing.values[1].actual, std::nullopt);
  EXPECT_EQ(missing.values[1].scale_error, std::nullopt);
  const InspectedSample extra = sample_of(found, 6, 5);
  EXPECT_EQ(extra.verdict, records::Verdict::forbidden);
  EXPECT_TRUE(extra.is_drawn);
  EXPECT_EQ(extra.values.at(1).exact, "13/2");
  EXPECT_EQ(extra.values.at(1).scale_error, exactly(-6.5 * 0x1p20));
  EXPECT_EQ(extra.values.at(1).excess, std::nullopt);
  EXPECT_THAT(sample_of(found, 7, 7).values, IsEmpty());
}

TEST(Inspect, GivesWhatIsNoNumberNoError) {
  const Inspection found =
      inspection_of({{0, 1, 2, 0}, 0}, [](const cases::Case&, cases::Fragments& d) {
        value(d, 0, 2, 1, 0) = std::numeric_limits<float>::quiet_NaN();
        value(d, 0, 2, 1, 1) = std::numeric_limits<float>::infinity();
      });
  const InspectedSample sample = sample_of(found, 2, 1);
  EXPECT_TRUE(std::isnan(sample.values.at(1).actual.value()));
  EXPECT_EQ(sample.values.at(1).scale_error, std::nullopt);
  EXPECT_EQ(sample.values.at(2).excess, std::nullopt);
}

cases::Case larger_square(int size, int samples) {
  cases::Case c = square();
  c.framebuffer = {size, size, samples};
  c.viewport.width = static_cast<float>(size);
  c.viewport.height = static_cast<float>(size);
  return c;
}

// Kills: a crop beyond the framebuffer; more than 1,024 samples; a crop that does not contain the
// sample.
TEST(Inspect, ShowsPartOfALargeFramebuffer) {
  const Inspection middle = inspection_of({{0, 50, 40, 0}}, {}, larger_square(100, 1));
  EXPECT_THAT(crop_of(middle), ElementsAre(24, 34, 32, 32));
  ASSERT_THAT(middle.samples, SizeIs(1024));
  EXPECT_EQ(middle.samples[33].place.x, 25U);
  EXPECT_EQ(middle.samples[33].place.y, 35U);
  const Inspection corner = inspection_of({{0, 99, 0, 3}}, {}, larger_square(100, 4));
  EXPECT_THAT(crop_of(corner), ElementsAre(0, 84, 16, 16));
  ASSERT_THAT(corner.samples, SizeIs(1024));
  EXPECT_EQ(corner.samples[5].place.x, 1U);
  EXPECT_EQ(corner.samples[5].place.sample, 1U);
  EXPECT_THAT(corner.pattern, ElementsAre(WindowPoint{0.375, 0.125}, WindowPoint{0.875, 0.375},
                                          WindowPoint{0.125, 0.625}, WindowPoint{0.625, 0.875}));
}

// A pixel has four values: at most 100 values are 25 pixels, and a limit of 0 gives one pixel.
TEST(Inspect, ShowsNoMoreValuesThanAskedFor) {
  const cases::Case c = larger_square(100, 1);
  EXPECT_THAT(crop_of(inspection_of({{0, 50, 40, 0}}, {}, c, {100})), ElementsAre(38, 48, 5, 5));
  EXPECT_THAT(crop_of(inspection_of({{0, 50, 40, 0}}, {}, c, {0})), ElementsAre(40, 50, 1, 1));
}

// The triangle covers pixels 4…7 of 128 in both directions; the oracle may only know that it lies
// within 3…8. Kills: a missing margin; showing the whole framebuffer; leaving out the requested
// sample.
TEST(Inspect, ShowsLittleAroundASmallTriangle) {
  cases::Case c = larger_square(128, 1);
  for (cases::ClipVertex& p : c.positions) {
    p = {(p.x + 1) / 32 - 0.9375F, (p.y + 1) / 32 - 0.9375F, 0.25F, 1};
  }
  const Inspection found = inspection_of({{0, 4, 5, 0}}, {}, c);
  EXPECT_THAT((std::array{found.left, found.top}), testing::Each(testing::AnyOf(1, 2)));
  EXPECT_THAT((std::array{found.left + found.width, found.top + found.height}),
              testing::Each(testing::AnyOf(10, 11)));
  // A sample far from the triangle is shown if it was asked for.
  const Inspection far = inspection_of({{0, 90, 90, 0}}, {}, c);
  EXPECT_EQ(sample_of(far, 90, 90).verdict, records::Verdict::forbidden);
}

// Kills: a camera that is not used for drawing; a fragment hidden by another triangle.
TEST(Inspect, IsOfTheTriangleAloneAsItWasDrawn) {
  cases::Case c = square();
  c.depth_test = cases::DepthTest::less;
  c.triangles = {{0, 1, 2}, {0, 1, 2}};
  c.camera.emplace();
  const Inspection found = inspection_of({{1, 1, 2, 0}}, {}, c);
  EXPECT_EQ(found.source.camera, std::nullopt);
  EXPECT_EQ(found.source.depth_test, cases::DepthTest::none);
  EXPECT_TRUE(sample_of(found, 2, 1).is_drawn);
}

TEST(Inspect, HasNoMapOfATriangleSeenEdgeOn) {
  cases::Case c = square();
  c.triangles = {{0, 1, 1}};
  const Inspection found = inspection_of({{0, 1, 2, 0}}, {}, c);
  EXPECT_FALSE(found.q_matrix);
  EXPECT_FALSE(sample_of(found, 2, 1).edges);
  EXPECT_EQ(sample_of(found, 2, 1).reason, records::Reason::degenerate);
}

TEST(Inspect, RefusesWhatIsNotThere) {
  DamagedBackend backend({}, "cpu");
  const auto reason = [&backend](const Focus& focus) {
    return inspected(square(), backend, focus).error().reason;
  };
  EXPECT_EQ(reason({{2, 0, 0, 0}}), "triangle 2 does not exist; the case has 2");
  EXPECT_EQ(reason({{0, 0, 8, 0}}), "pixel (8, 0) lies outside the framebuffer of 8 × 8 pixels");
  EXPECT_THAT(reason({{0, 8, 0, 0}}), HasSubstr("pixel (0, 8) lies outside"));
  EXPECT_EQ(reason({{0, 0, 0, 1}}), "sample 1 does not exist; a pixel has 1");
  EXPECT_EQ(reason({{0, 0, 0, 0}, 3}), "attribute 3 does not exist; the case has 3");
}

}  // namespace
}  // namespace rastercheck::properties::inspect_test
