#pragma once

// Tests that a driver's ways of drawing give the same result, for a case that is known to need all
// parts of them: more attributes than a draw has, more triangles than a buffer of records initially
// has room for, a scissor, culling, and clipped triangles.

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
  // Vertices on two spirals, some of them outside the view, with various w; a few are behind the
  // eye.
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

/// Replaces NaN by 0, as some drivers return NaN for noperspective attributes.
inline std::vector<float> with_numbers(std::vector<float> values) {
  for (float& value : values) {
    if (std::isnan(value)) value = 0;
  }
  return values;
}

/// Kills: giving attributes of a second draw to other fragments; losing records for which there is
/// no room; a scissor or culling that one way forgets.
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
  // A case that cannot be appended is drawn in another way, unless appending is requested.
  cases::Case tested = c;
  tested.depth_test = cases::DepthTest::less;
  EXPECT_TRUE(backend.draw_unjudged(tested));
  const auto refused = ways->draw_by(tested, cases::DrawBy::append);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().failure, Failure::unsupported);
  backend.prefer(std::nullopt);
}

}  // namespace rastercheck::backends
