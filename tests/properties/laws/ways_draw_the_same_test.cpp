// The law compares every way of drawing with the first one, and does not apply to a backend that
// draws in one way only.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::ways_draw_the_same_test {
namespace {

using cases::Case;
using cases::Fragments;
using testing::HasSubstr;

constexpr std::string_view kLaw = "every-way-of-drawing-draws-the-same-bits";

Check checked(DamagedBackend& backend, const Case& c = square()) {
  return check_law(*find_law(kLaw), c, backend, 0).value();
}

/// A backend whose second way damages the fragments that it draws.
class OtherWay : public DamagedBackend {
 public:
  explicit OtherWay(const Damage& damage) : DamagedBackend({}, "cpu") {
    way_damage = [damage](const Case& c, Result<Fragments>& drawn) { damage(c, *drawn); };
  }
};

TEST(Ways, DrawTheSame) {
  OtherWay backend([](const Case&, Fragments&) {});
  const Check check = checked(backend);
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Contains("drawn"));
}

TEST(Ways, AreAskedForByName) {
  OtherWay backend([](const Case&, Fragments&) {});
  EXPECT_TRUE(is_promised(*find_law(kLaw), backend));
  DamagedBackend single({}, "cpu");
  EXPECT_FALSE(is_promised(*find_law(kLaw), single));
  EXPECT_FALSE(checked(single).is_applicable);
}

TEST(Ways, MissNothing) {
  OtherWay backend([](const Case&, Fragments& drawn) { drop(drawn, 0, 1, 1); });
  const Check check = checked(backend);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, records::FragmentClass::missing);
  EXPECT_EQ(check.violations[0].note, "drawn by layers, compared with append");
}

// Kills: a fragment that is drawn twice, both times with the right values.
TEST(Ways, DrawNothingTwice) {
  OtherWay backend([](const Case&, Fragments& drawn) {
    const Fragments once = drawn;
    drawn = Fragments();
    drawn.attribute_count = once.attribute_count;
    for (std::size_t i = 0; i < once.size(); ++i) {
      for (int times = i == 5 ? 2 : 1; times > 0; --times) {
        const cases::SamplePlace place = once.place_of(i);
        drawn.triangle.push_back(place.triangle);
        drawn.x.push_back(once.x[i]);
        drawn.y.push_back(once.y[i]);
        drawn.sample.push_back(once.sample[i]);
        drawn.depth.push_back(once.depth[i]);
        const auto values = once.attributes_of(i);
        drawn.attributes.insert(drawn.attributes.end(), values.begin(), values.end());
      }
    }
  });
  const Check check = checked(backend);
  ASSERT_GE(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, records::FragmentClass::extra);
  EXPECT_EQ(check.violations[0].note, "drawn more than once by layers");
}

// Kills: the same note for differences that the contract permits and for those that it does not.
TEST(Ways, SayWhetherEitherIsPermitted) {
  OtherWay backend([](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 0) += 0x1p-20F; });
  const Check beyond = checked(backend);
  ASSERT_EQ(beyond.violation_count, 1U);
  EXPECT_EQ(beyond.violations[0].fragment_class, records::FragmentClass::beyond_bound);
  EXPECT_EQ(beyond.violations[0].note, "drawn by layers, compared with append");

  cases::Contract loose = backend.promise(square());
  loose.bounds.smooth.constant = 64;
  backend.promised = loose;
  const Check within = checked(backend);
  ASSERT_EQ(within.violation_count, 1U);
  EXPECT_THAT(within.violations[0].note, HasSubstr("; the contract permits either"));
}

// Either way may flush subnormal numbers, and the sign of a zero does not count.
TEST(Ways, MayFlushSubnormalNumbers) {
  Case c = square();
  c.attribute_values.assign(c.attribute_values.size(), 0x1p-140F);
  OtherWay backend([](const Case&, Fragments& drawn) {
    for (float& value : drawn.attributes) value = -0.0F;
  });
  EXPECT_EQ(checked(backend, c).violation_count, 0U);
}

TEST(Ways, LeaveOutWhatAWayDoesNotDraw) {
  DamagedBackend backend({}, "cpu");
  backend.way_damage = [](const Case&, Result<Fragments>& drawn) {
    drawn = tl::unexpected(Error{"", "", "no such cases", Failure::unsupported});
  };
  const Check check = checked(backend);
  EXPECT_FALSE(check.is_applicable);
  EXPECT_EQ(check.why_not, "no such cases");
}

}  // namespace
}  // namespace rastercheck::properties::ways_draw_the_same_test
