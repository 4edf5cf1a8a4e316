#include "properties/campaign/internal/explanation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "properties/campaign/check_case.h"
#include "properties/campaign/findings.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::explanation_test {
namespace {

using records::DrawnPart;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

/// A triangle over half of 8 × 8 pixels of four samples, with a scissor.
cases::Case scene() {
  cases::Case c;
  c.framebuffer = {8, 8, 4};
  c.viewport = {0, 0, 8, 8, 0, 1};
  c.rules = cases::Rules::vulkan;
  c.scissor = cases::Scissor{0, 0, 6, 6};
  c.positions = {{-0.9F, -0.8F, 0, 1}, {0.7F, -0.9F, 0, 1}, {-0.8F, 0.9F, 0.5F, 1}};
  c.attributes = {{"r"}};
  c.attribute_values = {0.25F, 0.5F, 1};
  c.triangles = {{0, 1, 2}};
  return c;
}

/// The explanation that is found for a backend with this damage.
records::Explanation explained(std::string_view law_id, const Damage& damage) {
  DamagedBackend backend(damage);
  const Law& law = *find_law(law_id);
  Findings findings;
  check_case(law, "damaged", backend, 1, {scene(), "", 0}, findings);
  EXPECT_FALSE(findings.counterexamples.empty());
  if (findings.counterexamples.empty()) return {};
  const records::Counterexample& found = findings.counterexamples[0];
  return explain(law, backend, found, found.source, nullptr, {}).value_or(records::Explanation());
}

void drop_last(cases::Fragments& drawn) {
  drawn.triangle.pop_back();
  drawn.x.pop_back();
  drawn.y.pop_back();
  drawn.sample.pop_back();
  drawn.depth.pop_back();
  drawn.attributes.resize(drawn.attributes.size() - drawn.attribute_count);
}

TEST(Explain, CoverageHasToBePutRight) {
  const records::Explanation explanation =
      explained(kCoverageLaw, [](const cases::Case& /*c*/, cases::Fragments& drawn) {
        if (drawn.size() > 0) drop_last(drawn);
      });
  EXPECT_THAT(explanation.parts, ElementsAre(DrawnPart::coverage));
  EXPECT_THAT(explanation.needs, IsEmpty());
  EXPECT_THAT(explanation.indifferent, Contains("scissor"));
  EXPECT_THAT(explanation.indifferent, Contains("samples"));
}

// Kills: reporting what the case happens to have as something the fault needs.
TEST(Explain, WhatTheFaultNeedsIsFound) {
  const records::Explanation explanation =
      explained(kCoverageLaw, [](const cases::Case& c, cases::Fragments& drawn) {
        if (c.scissor && drawn.size() > 0) drop_last(drawn);
      });
  EXPECT_THAT(explanation.needs, ElementsAre("scissor"));
  EXPECT_THAT(explanation.indifferent, Contains("samples"));
}

TEST(Explain, ValuesOfSeveralSamples) {
  const records::Explanation explanation =
      explained(kValuesLaw, [](const cases::Case& c, cases::Fragments& drawn) {
        if (c.framebuffer.samples == 1) return;
        for (float& value : drawn.attributes) value += 0.25F;
      });
  EXPECT_THAT(explanation.parts, ElementsAre(DrawnPart::values));
  EXPECT_THAT(explanation.needs, ElementsAre("samples"));
  EXPECT_THAT(explanation.indifferent, Contains("scissor"));
}

// Kills: a law about two drawings whose failure is not traced to errors in each drawing.
TEST(Explain, ALawAboutTwoDrawingsFailsForTheirValues) {
  const records::Explanation explanation =
      explained("vertex-order-changes-nothing-beyond-the-bound",
                [](const cases::Case& c, cases::Fragments& drawn) {
                  for (std::size_t i = 0; i < drawn.attributes.size(); ++i) {
                    drawn.attributes[i] = c.attributes_of(c.triangles[0][0])[0];
                  }
                });
  EXPECT_THAT(explanation.parts, ElementsAre(DrawnPart::values));
}

// Kills: returning half an explanation, which would be wrong; reporting needs of a case that does
// not fail again.
TEST(Explain, SaysNothingOfWhatWasNotTriedToTheEnd) {
  const Law& law = *find_law(kCoverageLaw);
  records::Counterexample found;
  found.source = scene();
  found.source.found = {std::string(kCoverageLaw), "damaged", "missing", 1, 0};
  DamagedBackend damaged([](const cases::Case& /*c*/, cases::Fragments& drawn) {
    if (drawn.size() > 0) drop_last(drawn);
  });
  EXPECT_TRUE(explain(law, damaged, found, found.source, nullptr, {}));
  EXPECT_FALSE(explain(law, damaged, found, found.source, nullptr, [] { return true; }));
  DamagedBackend right;
  records::Explanation held;
  held.fails_again = false;
  EXPECT_EQ(explain(law, right, found, found.source, nullptr, {}), held);
}

}  // namespace
}  // namespace rastercheck::properties::explanation_test
