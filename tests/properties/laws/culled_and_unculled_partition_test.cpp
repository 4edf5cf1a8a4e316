// The law catches fragments that both kinds of culling draw or that neither draws, an ignored
// orientation of front faces, and values that depend on culling.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::culled_and_unculled_partition_test {
namespace {

using cases::Case;
using cases::Cull;
using cases::Fragments;
using cases::FrontFace;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "culled-and-unculled-partition";

/// The square, with one half seen from behind.
Case two_sided() {
  Case c = square();
  c.triangles[1] = {1, 2, 3};
  return c;
}

/// Draws with a changed state.
class Misled : public DamagedBackend {
 public:
  explicit Misled(std::function<void(Case&)> mislead) : mislead_(std::move(mislead)) {}
  Result<Fragments> draw_fragments(const Case& c) override {
    Case changed = c;
    mislead_(changed);
    return DamagedBackend::draw_fragments(changed);
  }

 private:
  std::function<void(Case&)> mislead_;
};

Check misled(const std::function<void(Case&)>& mislead) {
  Misled backend(mislead);
  return check_of(kLaw, two_sided(), backend);
}

TEST(Culling, Partitions) {
  for (const FrontFace front : {FrontFace::ccw, FrontFace::cw}) {
    for (const Cull cull : {Cull::none, Cull::back}) {
      Case c = two_sided();
      c.front_face = front;
      c.cull = cull;
      c.depth_test = cases::DepthTest::less;
      const Check check = check_of(kLaw, c, {});
      EXPECT_TRUE(check.is_applicable);
      EXPECT_EQ(check.violation_count, 0U);
      EXPECT_THAT(check.labels, testing::ElementsAre("back faces", "both", "drawn", "front faces"));
    }
  }
}

TEST(Culling, FindsTheOrientationIgnored) {
  const Check check = misled([](Case& c) { c.front_face = FrontFace::ccw; });
  EXPECT_EQ(check.violation_count, 128U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("the definition of front faces reversed"));
}

TEST(Culling, FindsWhatIsNeverCulled) {
  const Check check = misled([](Case& c) {
    if (c.cull == Cull::front) c.cull = Cull::none;
  });
  EXPECT_GT(check.violation_count, 0U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::extra);
  EXPECT_THAT(check.violations.front().note, HasSubstr("combined"));
}

// A triangle that counts partly as a front face and partly as a back face.
TEST(Culling, FindsATriangleInBoth) {
  const Check check = check_of(kLaw, two_sided(), [](const Case& c, Fragments& drawn) {
    if (c.cull == Cull::none || c.front_face == FrontFace::cw) return;
    const bool is_here = find(drawn, 0, 1, 1) < drawn.size();
    if (is_here) {
      drop(drawn, 0, 1, 1);
    } else {
      add(drawn, 0, 1, 1);
      drawn.depth.back() = 0.25F;
      value(drawn, 0, 1, 1, 0) = 1.5F;
      value(drawn, 0, 1, 1, 1) = 1;
    }
  });
  ASSERT_GT(check.violation_count, 0U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.exact,
            "forbidden: part of this triangle is also drawn when back faces are culled");
  EXPECT_EQ(violation.place.triangle, 0U);
}

TEST(Culling, FindsWhatNeitherDraws) {
  const Check check = check_of(kLaw, two_sided(), [](const Case& c, Fragments& drawn) {
    if (c.cull != Cull::none && find(drawn, 1, 7, 7) < drawn.size()) drop(drawn, 1, 7, 7);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations.front().place.triangle, 1U);
}

TEST(Culling, FindsValuesThatDependOnIt) {
  const Check check = check_of(kLaw, two_sided(), [](const Case& c, Fragments& drawn) {
    const std::size_t at = find(drawn, 1, 7, 7);
    if (c.cull == Cull::none || at == drawn.size()) return;
    value(drawn, 1, 7, 7, 1) = std::nextafter(1.0F, 2.0F);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().attribute, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::culled_and_unculled_partition_test
