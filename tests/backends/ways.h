#pragma once

// What every driver's ways of drawing have to show of a case that is known to need all of them:
// more attributes than a draw has, more triangles than a record's buffer begins with room for, a
// scissor, culling, and triangles that are clipped.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/names.h"

namespace rastercheck::backends {

inline cases::Case case_of_ways(cases::Rules rules) {
  cases::Case c;
  c.rules = rules;
  c.framebuffer = {24, 20, 1};
  c.viewport = {2, -3, 20, 24, 0.25F, 0.75F};
  c.scissor = cases::Scissor{3, 1, 17, 18};
  c.cull = cases::Cull::back;
  for (int i = 0; i < 6; ++i) c.attributes.push_back({"s" + std::to_string(i)});
  c.attributes.push_back({"n", cases::Interpolation::noperspective});
  c.attributes.push_back({"f", cases::Interpolation::flat});
  // Vertices on two spirals, some of them beside the view, of any w but behind the eye for a few.
  constexpr int kVertices = 40;
  for (int i = 0; i < kVertices; ++i) {
    const float turn = static_cast<float>(i * 7 % 40) / 20 - 1;
    const float other = static_cast<float>(i * 11 % 40) / 16 - 1.2F;
    const float w = i % 9 == 0 ? -0.5F : 0.5F + static_cast<float>(i % 5) / 2;
    c.positions.push_back({turn * w, other * w, 0.5F * w, w});
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      c.attribute_values.push_back(static_cast<float>((i + 3) * (static_cast<int>(a) + 1) % 17));
    }
  }
  for (std::uint32_t i = 0; i < 1500; ++i) {
    c.triangles.push_back({i % kVertices, (i * 3 + 1) % kVertices, (i * 7 + 2) % kVertices});
  }
  return c;
}

/// The same with 0 for what is no number, as some drivers have it of noperspective attributes.
inline std::vector<float> with_numbers(std::vector<float> values) {
  for (float& value : values) {
    if (std::isnan(value)) value = 0;
  }
  return values;
}

/// Kills: attributes of a second draw put to other fragments, records that are lost where there is
/// no room for them, a scissor or culling that one way forgets.
inline void expect_ways_alike(Backend& backend, cases::Rules rules) {
  WaysOfDrawing* const ways = backend.ways_of_drawing();
  ASSERT_NE(ways, nullptr);
  const cases::Case c = case_of_ways(rules);
  ASSERT_EQ(ways->ways(), (std::vector{cases::DrawBy::append, cases::DrawBy::layers}));
  const auto appended = ways->draw_by(c, cases::DrawBy::append);
  const auto layers = ways->draw_by(c, cases::DrawBy::layers);
  ASSERT_TRUE(appended) << to_string(appended.error());
  ASSERT_TRUE(layers) << to_string(layers.error());
  EXPECT_GT(layers->size(), 20'000U);
  EXPECT_EQ(appended->triangle, layers->triangle);
  EXPECT_EQ(appended->x, layers->x);
  EXPECT_EQ(appended->y, layers->y);
  EXPECT_EQ(appended->sample, layers->sample);
  EXPECT_EQ(appended->depth, layers->depth);
  EXPECT_EQ(with_numbers(appended->attributes), with_numbers(layers->attributes));

  backend.prefer(cases::DrawBy::append);
  const auto preferred = backend.draw_unjudged(c);
  ASSERT_TRUE(preferred);
  EXPECT_EQ(with_numbers(preferred->attributes), with_numbers(appended->attributes));
  // What cannot be appended is drawn all the same, unless appending is what was asked for.
  cases::Case tested = c;
  tested.depth_test = cases::DepthTest::less;
  EXPECT_TRUE(backend.draw_unjudged(tested));
  const auto refused = ways->draw_by(tested, cases::DrawBy::append);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().failure, Failure::unsupported);
  backend.prefer(std::nullopt);
}

}  // namespace rastercheck::backends
