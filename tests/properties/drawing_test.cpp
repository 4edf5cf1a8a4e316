// Tests what a backend must not do to the process that it runs in, and which drawings it must not
// return.

#include "properties/drawing.h"

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <string>

#include "tests/floating_point_control.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::drawing_test {
namespace {

TEST(Drawing, HandsBackWhatTheBackendDrew) {
  DamagedBackend backend;
  const cases::Fragments drawn = draw(square(), backend).value().fragments;
  EXPECT_EQ(drawn.size(), 64U);
  EXPECT_EQ(drawn.attribute_count, 3U);
}

TEST(Drawing, FailsOnAnotherRoundingModeAndPutsItBack) {
  DamagedBackend backend([](const cases::Case&, cases::Fragments&) { std::fesetround(FE_UPWARD); });
  const auto drawn = draw(square(), backend);
  ASSERT_FALSE(drawn.has_value());
  EXPECT_NE(drawn.error().reason.find("rounding mode"), std::string::npos);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(Drawing, FailsOnFlushedSubnormalsAndPutsThemBack) {
  const unsigned before = floating_point_control();
  for (const unsigned flush : kFlushes) {
    DamagedBackend backend([flush](const cases::Case&, cases::Fragments&) {
      set_floating_point_control(floating_point_control() | flush);
    });
    EXPECT_FALSE(draw(square(), backend).has_value());
    EXPECT_EQ(floating_point_control() & ~kSticky, before & ~kSticky);
  }
}

TEST(Drawing, LetsStickyFlagsPass) {
  DamagedBackend backend(
      [](const cases::Case&, cases::Fragments&) { std::feraiseexcept(FE_ALL_EXCEPT); });
  EXPECT_TRUE(draw(square(), backend).has_value());
}

TEST(Drawing, WatchesVertexStageAndStripsAsWell) {
  const std::array<std::uint32_t, 4> indices{0, 1, 2, 3};
  DamagedBackend good({}, "cpu");
  cases::Case c = square();
  EXPECT_EQ(draw_assembled(c, cases::Topology::strip, indices, good).value().size(), 64U);
  cases::Case seen = c;
  seen.camera.emplace();
  EXPECT_EQ(transform(seen, good).value(), c.positions);

  DamagedBackend bad([](const cases::Case&, cases::Fragments&) { std::fesetround(FE_UPWARD); },
                     "cpu");
  bad.transform_damage = [](const cases::Case&, std::vector<cases::ClipVertex>&) {
    std::fesetround(FE_UPWARD);
  };
  EXPECT_FALSE(draw_assembled(c, cases::Topology::strip, indices, bad).has_value());
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_FALSE(transform(seen, bad).has_value());
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(Drawing, FailsOnArraysOfDifferentLengths) {
  const std::array<Damage, 4> damages{
      [](const cases::Case&, cases::Fragments& drawn) { drawn.derivatives.resize(3); },
      [](const cases::Case&, cases::Fragments& drawn) { drawn.depth.pop_back(); },
      [](const cases::Case&, cases::Fragments& drawn) { drawn.attributes.pop_back(); },
      [](const cases::Case&, cases::Fragments& drawn) {
        drawn.attribute_count = 1;
        drawn.attributes.resize(drawn.size());
      }};
  for (const Damage& damage : damages) {
    DamagedBackend backend(damage);
    EXPECT_FALSE(draw(square(), backend).has_value());
  }
}

}  // namespace
}  // namespace rastercheck::properties::drawing_test
