#include "properties/campaign/internal/variations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "properties/campaign/internal/case_size.h"
#include "properties/draw.h"
#include "properties/law.h"

namespace rastercheck::properties::variations_test {
namespace {

TEST(Variations, HaveIdsOfTheirOwn) {
  std::set<std::string_view> ids;
  for (const Variation& variation : variations()) {
    EXPECT_TRUE(ids.insert(variation.id).second) << variation.id;
    EXPECT_EQ(find_variation(variation.id), &variation);
  }
  EXPECT_EQ(find_variation("no such"), nullptr);
}

// Kills: a variation that makes an invalid case; a variation that claims to have removed something
// and has not; a variation that never applies.
TEST(Variations, TakeSomethingAwayAndLeaveAValidCase) {
  constexpr std::uint64_t kCases = 1500;
  std::map<std::string_view, int> taken;
  for (std::uint64_t index = 0; index < kCases; ++index) {
    Draw draw(1, "variations", index);
    cases::Case source = generate_any(draw).source;
    // No generator that all properties have makes cases with these.
    if (index % 3 == 0) source.depth_bias.slope = 1;
    if (index % 3 == 1) source.depth_format = cases::DepthFormat::unorm16;
    for (const Variation& variation : variations()) {
      cases::Case other = source;
      if (!take_away(variation, other, {})) continue;
      ++taken[variation.id];
      const std::string text = cases::to_json(other);
      EXPECT_NE(text, cases::to_json(source)) << variation.id;
      const auto read = cases::parse_case(text, "varied");
      EXPECT_TRUE(read) << variation.id << ": " << to_string(read.error());
    }
  }
  for (const Variation& variation : variations()) {
    // "far pixels" depends on where the case fails, here the first pixel; no generator makes cases
    // for the other two.
    const std::set<std::string_view> others{"far pixels", "camera", "depth clear"};
    if (others.contains(variation.id)) continue;
    EXPECT_GT(taken[variation.id], 0) << variation.id;
  }
}

// Kills: a variation that claims to have removed something that is still there.
TEST(Variations, AreNotThereAnyMoreOnceTakenAway) {
  const std::set<std::string_view> again{"tie",   "small",        "large",
                                         "side",  "large values", "small values",
                                         "sides", "viewport",     "fractions"};
  for (std::uint64_t index = 0; index < 400; ++index) {
    Draw draw(2, "variations", index);
    cases::Case c = generate_any(draw).source;
    for (const Variation& variation : variations()) {
      if (again.contains(variation.id)) continue;
      cases::Case other = c;
      if (!take_away(variation, other, {})) continue;
      EXPECT_FALSE(take_away(variation, other, {})) << variation.id << " of " << cases::to_json(c);
    }
  }
}

// Kills: a target without size if a fragment was drawn outside the target.
TEST(Variations, OfFarPixelsCropTheTarget) {
  cases::Case c;
  c.framebuffer = {80, 100, 1};
  c.viewport = {0, 0, 80, 100, 0, 1};
  const Variation& far = *find_variation("far pixels");
  cases::Case cropped = c;
  ASSERT_TRUE(take_away(far, cropped, {0, 70, 65, 0}));
  EXPECT_EQ(cropped.framebuffer.width, 16);
  EXPECT_EQ(cropped.framebuffer.height, 36);
  EXPECT_EQ(cropped.viewport.x, -64);
  EXPECT_EQ(cropped.viewport.y, -64);
  EXPECT_FALSE(take_away(far, c, {0, 3, 65535, 0}));
}

// Kills: a change of the viewport that also moves the picture in it.
TEST(Variations, OfViewportsLeaveVerticesWhereTheyAppear) {
  for (std::uint64_t index = 0; index < 400; ++index) {
    Draw draw(3, "variations", index);
    const cases::Case source = generate_any(draw).source;
    for (const std::string_view id : {"sides", "viewport", "negative height"}) {
      cases::Case other = source;
      if (!take_away(*find_variation(id), other, {})) continue;
      for (std::size_t i = 0; i < source.positions.size(); ++i) {
        WindowPoint before = window_point(source.viewport, source.positions[i]);
        WindowPoint after = window_point(other.viewport, other.positions[i]);
        if (source.rules == cases::Rules::d3d) {  // y points the other way
          before.v = 2 * double{source.viewport.y} + double{source.viewport.height} - before.v;
          after.v = 2 * double{other.viewport.y} + double{other.viewport.height} - after.v;
        }
        // The tolerance is two roundings of a clip position to float32, each of half an ULP, times
        // the size of the viewport. Positions beyond float32's range are clamped to it, so very
        // large sizes are skipped.
        const double size = std::abs(double{other.viewport.width}) +
                            std::abs(double{other.viewport.height}) + std::abs(before.u) +
                            std::abs(before.v) + std::abs(double{other.viewport.x}) +
                            std::abs(double{other.viewport.y});
        if (size > 0x1p30) continue;
        EXPECT_NEAR(before.u, after.u, size * 0x1p-22) << id << " of " << cases::to_json(source);
        EXPECT_NEAR(before.v, after.v, size * 0x1p-22) << id << " of " << cases::to_json(source);
      }
    }
  }
}

}  // namespace
}  // namespace rastercheck::properties::variations_test
