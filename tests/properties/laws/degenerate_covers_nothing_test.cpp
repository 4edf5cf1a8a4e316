// The law catches a triangle without area that draws something, or that changes, hides or renumbers
// its neighbours. The triangles that the law adds have exactly no area.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "oracle/triangle_truth.h"
#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::degenerate_covers_nothing_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "what-is-degenerate-covers-nothing";

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// True if triangles were added to the square's two.
bool is_mixed(const Case& c) { return c.triangles.size() > 2; }

/// The indices of triangles that are not the square's.
std::vector<std::uint32_t> added(const Case& c) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
    const cases::Triangle& triangle = c.triangles[t];
    const Case whole = square();
    const auto& own = whole.triangles;
    if (std::find(own.begin(), own.end(), triangle) == own.end()) result.push_back(t);
  }
  return result;
}

TEST(Degenerate, TrianglesLeaveTheSquareAsItIs) {
  for (const cases::Cull cull : {cases::Cull::none, cases::Cull::front}) {
    Case c = square();
    c.cull = cull;
    const Check check = checked(c, {});
    EXPECT_TRUE(check.is_applicable);
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_GE(check.labels.size(), 5U);
  }
}

// det M = 0, or all w <= 0: the oracle says that such triangles cover nothing.
TEST(Degenerate, TrianglesHaveNoArea) {
  int added_to = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    Case c = own_case(kLaw, i).source;
    c.coverage.reset();
    c.triangles.resize(1);
    checked(c, [&](const Case& seen, Fragments&) {
      if (seen.triangles.size() > 1) ++added_to;
      for (std::uint32_t t = 0; t < seen.triangles.size(); ++t) {
        if (seen.triangles[t] == c.triangles[0]) continue;
        const oracle::SceneTruth scene(seen, cases::Contract{});
        const bool is_behind =
            std::all_of(seen.triangles[t].begin(), seen.triangles[t].end(),
                        [&seen](std::uint32_t v) { return seen.positions[v].w <= 0; });
        EXPECT_TRUE(is_behind || oracle::TriangleTruth(scene, t).orientation() == 0);
      }
    });
  }
  EXPECT_EQ(added_to, 100);
}

TEST(Degenerate, TriangleThatDrawsIsFound) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_mixed(c)) add(drawn, added(c).front(), 3, 4);
  });
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::extra);
  EXPECT_EQ(violation.place.x, 3U);
  EXPECT_EQ(violation.place.y, 4U);
  EXPECT_THAT(violation.note, HasSubstr("an added triangle: "));
}

TEST(Degenerate, TriangleThatChangesItsNeighboursIsFound) {
  const Check bit = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_mixed(c)) drawn.attributes[0] += 0x1p-20F;
  });
  EXPECT_EQ(bit.violation_count, 1U);
  const Check hidden = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_mixed(c)) drop(drawn, drawn.triangle[0], drawn.x[0], drawn.y[0]);
  });
  EXPECT_EQ(hidden.violation_count, 1U);
  const Check renumbered = checked(square(), [](const Case& c, Fragments& drawn) {
    if (!is_mixed(c)) return;
    for (std::uint32_t& triangle : drawn.triangle) triangle += 100;
  });
  EXPECT_EQ(renumbered.violation_count, 128U);
}

// A textbook method may draw a snapped line next to the diagonal; the oracle decides what is
// permitted.
TEST(Degenerate, TrianglesOfTextbookMethodsHold) {
  EXPECT_EQ(check_own_cases(kLaw, "method:rational-linear", 100).violated, 0);
}

TEST(Degenerate, TrianglesNeedOthersToBeMadeOf) {
  Case c = square();
  c.triangles.clear();
  EXPECT_FALSE(checked(c, {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::degenerate_covers_nothing_test
