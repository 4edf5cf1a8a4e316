// Triangle A of the square (tests/properties/damaged_backend.h): e = (1 − u/8 − v/8, u/8, v/8), all
// w = 1, and attribute x is u.

#include "properties/inspect/judged_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "properties/drawing.h"
#include "properties/inspect/case_to_draw.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::judged_places_test {
namespace {

using records::JudgedPlace;
using records::Verdict;
using testing::SizeIs;

/// The four by two pixels from (0, 0) on.
records::Inspection part() {
  records::Inspection inspection;
  inspection.width = 4;
  inspection.height = 2;
  return inspection;
}

std::vector<JudgedPlace> places_of(const Damage& damage, std::size_t most_samples = 1000) {
  DamagedBackend backend(damage, "cpu");
  const cases::ClipCase clip = case_to_draw(square()).value();
  return judged_places(clip, draw(clip, backend).value(), part(), most_samples);
}

TEST(JudgedPlaces, AreThePartsSamplesOfAllTriangles) {
  const std::vector<JudgedPlace> places = places_of({});
  ASSERT_THAT(places, SizeIs(16));
  // Pixel (1, 1) of A: drawn, with x = 3/2.
  const JudgedPlace& one = places[5];
  EXPECT_EQ(one.place, (cases::SamplePlace{0, 1, 1, 0}));
  EXPECT_EQ(one.verdict, Verdict::required);
  EXPECT_TRUE(one.has_right_count);
  ASSERT_THAT(one.values, SizeIs(4));
  EXPECT_EQ(one.values[0].attribute, std::nullopt);
  const records::PermittedValue& x = one.values[1];
  EXPECT_EQ(x.attribute, 0U);
  EXPECT_LE(x.numbers.least, 1.5F);
  EXPECT_GE(x.numbers.greatest, 1.5F);
  EXPECT_LT(x.numbers.greatest, 1.5F + 0x1p-18F);
  // B is the other half of the square.
  EXPECT_EQ(places[8 + 5].place.triangle, 1U);
  EXPECT_EQ(places[8 + 5].verdict, Verdict::forbidden);
  EXPECT_THAT(places[8 + 5].values, SizeIs(0));
}

TEST(JudgedPlaces, TellWhatIsWrong) {
  const auto wrong = places_of([](const cases::Case&, cases::Fragments& d) {
    value(d, 0, 1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    d.triangle[0] = 1;  // pixel (0, 0) of A as one of B
  });
  EXPECT_FALSE(wrong[5].values[1].is_right);
  EXPECT_TRUE(wrong[5].values[2].is_right);
  EXPECT_FALSE(wrong[0].has_right_count);
  EXPECT_FALSE(wrong[8].has_right_count);
  EXPECT_TRUE(wrong[1].has_right_count);
}

// Kills: a sample that is drawn twice, taken for one that is drawn.
TEST(JudgedPlaces, CountFragments) {
  const auto twice = places_of([](const cases::Case&, cases::Fragments& d) {
    d.x[1] = 0;
    d.y[1] = 0;
  });
  EXPECT_FALSE(twice[0].has_right_count);
  EXPECT_FALSE(twice[1].has_right_count);
}

TEST(JudgedPlaces, AreOfTheTriangleInFocusIfThereAreTooMany) {
  const std::vector<JudgedPlace> places = places_of({}, 15);
  ASSERT_THAT(places, SizeIs(8));
  EXPECT_EQ(places.back().place.triangle, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::judged_places_test
