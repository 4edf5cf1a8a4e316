// The law catches a clipper that loses fragments, draws too many, or gives them other values than
// the triangle that reaches beyond the plane; it accepts differences exactly on the plane.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <set>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::clipped_equals_clipless_test {
namespace {

using cases::Case;
using cases::Fragments;
using testing::HasSubstr;

constexpr std::string_view kLaw = "clipped-equals-clipless";

/// True if the case is the clipped one: it still lists vertices of the whole triangles, which its
/// parts do not use.
bool is_clipped(const Case& c) {
  std::set<std::uint32_t> named;
  for (const cases::Triangle& triangle : c.triangles) {
    named.insert(triangle.begin(), triangle.end());
  }
  return named.size() < c.positions.size();
}

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// Calls `visit` with the law's own cases of exact coverage that draw something when clipped.
template <typename Visit>
void for_some_cases(const Visit& visit) {
  int found = 0;
  for (std::uint64_t i = 0; i < 100 && found < 20; ++i) {
    Case c = own_case(kLaw, i).source;
    c.coverage.reset();
    if (checked(c, {}).judgement.counts.required < 8) continue;
    ++found;
    visit(c);
  }
  EXPECT_EQ(found, 20);
}

TEST(Clipping, FindsWhatIsLostAndWhatIsTooMuch) {
  for_some_cases([](const Case& c) {
    const Check lost = checked(c, [](const Case& drawn_case, Fragments& drawn) {
      if (!is_clipped(drawn_case) || drawn.size() < 8) return;
      for (int i = 0; i < 8; ++i) {
        drawn.triangle[static_cast<std::size_t>(i)] = 9999;  // not a part of any triangle
      }
    });
    EXPECT_GE(lost.violation_count, 8U);
    EXPECT_THAT(lost.violations.front().note, HasSubstr("drawn as the part that remains at the "));
    const Check twice = checked(c, [](const Case& drawn_case, Fragments& drawn) {
      if (!is_clipped(drawn_case) || drawn.size() == 0) return;
      drawn.triangle.push_back(drawn.triangle[0]);
      drawn.x.push_back(drawn.x[0]);
      drawn.y.push_back(drawn.y[0]);
      drawn.sample.push_back(drawn.sample[0]);
      drawn.depth.push_back(drawn.depth[0]);
      for (std::size_t a = 0; a < drawn.attribute_count; ++a) {
        drawn.attributes.push_back(drawn.attributes[a]);
      }
      if (!drawn.derivatives.empty()) drawn.derivatives.resize(drawn.attributes.size() * 2);
    });
    EXPECT_EQ(twice.violation_count, 1U);
  });
}

TEST(Clipping, FindsOtherValues) {
  for_some_cases([](const Case& c) {
    const Check check = checked(c, [](const Case& drawn_case, Fragments& drawn) {
      if (is_clipped(drawn_case) && drawn.size() > 0) drawn.depth[0] += 0.25F;
    });
    EXPECT_EQ(check.violation_count, 1U);
  });
}

// Samples on the near plane count as inside; the edge that clipping makes there may own them or
// not.
TEST(Clipping, LeavesTheSamplesOnThePlaneAlone) {
  FoundInOwnCases found = check_own_cases(kLaw, "cpu", 600);
  EXPECT_EQ(found.violated, 0);
  EXPECT_GT(found.reached["sample on the plane"], 0);
}

TEST(Clipping, OfATextbookMethodHolds) {
  EXPECT_EQ(check_own_cases(kLaw, "method:rational-linear", 50).violated, 0);
}

}  // namespace
}  // namespace rastercheck::properties::clipped_equals_clipless_test
