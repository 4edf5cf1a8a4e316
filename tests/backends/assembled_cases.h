#pragma once

// Tests of strips, fans and lists of indices, drawn by the backend itself: they must leave the
// fragments of their triangles and lines, which are spelled out here, drawn as lists.

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "backends/backend.h"
#include "tests/backends/window_cases.h"

namespace rastercheck::backends {

/// Draws indices, and the given primitives as a list; expects the same fragments.
inline void expect_assembled(Backend& backend, cases::Case c, cases::Topology topology,
                             const std::vector<std::uint32_t>& indices,
                             const std::vector<cases::Triangle>& primitives) {
  c.triangles = primitives;
  const cases::Fragments expected = fragments_of(backend.draw(c)).value();
  EXPECT_FALSE(expected.triangle.empty());
  c.triangles.clear();
  const Result<cases::Fragments> drawn = backend.assembler()->draw_assembled(c, topology, indices);
  ASSERT_TRUE(drawn) << to_string(drawn.error());
  EXPECT_EQ(drawn->triangle, expected.triangle);
  EXPECT_EQ(drawn->x, expected.x);
  EXPECT_EQ(drawn->y, expected.y);
  EXPECT_EQ(drawn->depth, expected.depth);
  EXPECT_EQ(drawn->attributes, expected.attributes);
}

/// The window's corners, each with its index as a flat value.
inline cases::Case case_of_corners(cases::Rules rules) {
  cases::Case c = empty_case(rules);
  c.positions = {at(0, 0, 0.25F), at(kSide, 0, 0.25F), at(0, kSide, 0.25F),
                 at(kSide, kSide, 0.25F)};
  c.attributes = {{"vertex", cases::Interpolation::flat, cases::Location::sample}};
  c.attribute_values = {0, 1, 2, 3};
  return c;
}

/// The same under a depth test, for which drivers have another way.
inline cases::Case with_depth_test(cases::Case c) {
  c.depth_test = cases::DepthTest::less;
  c.depth_clear = 0.75F;
  return c;
}

inline void expect_strips_and_fans_of(Backend& backend, const cases::Case& c) {
  ASSERT_NE(backend.assembler(), nullptr);
  EXPECT_TRUE(backend.about().assembles);
  const bool is_last = c.rules == cases::Rules::opengl;
  using cases::Topology;
  using Triangles = std::vector<cases::Triangle>;
  expect_assembled(backend, c, Topology::strip, {0, 1, 2, 3},
                   is_last ? Triangles{{0, 1, 2}, {2, 1, 3}} : Triangles{{0, 1, 2}, {1, 3, 2}});
  expect_assembled(backend, c, Topology::fan, {0, 1, 3, 2},
                   is_last ? Triangles{{0, 1, 3}, {0, 3, 2}} : Triangles{{1, 3, 0}, {3, 2, 0}});
  expect_assembled(backend, c, Topology::triangles, {0, 1, 2, cases::kRestart, 2, 1, 3, 0},
                   {{0, 1, 2}, {2, 1, 3}});
  expect_assembled(backend, c, Topology::strip,
                   {cases::kRestart, 0, 1, cases::kRestart, 1, 3, 2, 0},
                   is_last ? Triangles{{1, 3, 2}, {2, 3, 0}} : Triangles{{1, 3, 2}, {3, 0, 2}});
}

inline void expect_strips_and_fans(Backend& backend, cases::Rules rules) {
  expect_strips_and_fans_of(backend, case_of_corners(rules));
  expect_strips_and_fans_of(backend, with_depth_test(case_of_corners(rules)));
  cases::Case c = case_of_corners(rules);
  const std::vector<std::uint32_t> beyond{0, 1, 4};
  const auto refused = backend.assembler()->draw_assembled(c, cases::Topology::strip, beyond);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().failure, Failure::unsupported);
  EXPECT_EQ(backend.assembler()->draw_assembled(c, cases::Topology::strip, {}).value().size(), 0U);
}

inline void expect_strips_of_lines(Backend& backend, cases::Rules rules) {
  using cases::Topology;
  cases::Case c = case_of_corners(rules);
  c.primitive = cases::Primitive::lines;
  c.line_mode = cases::LineMode::bresenham;
  c.positions = {at(1.5F, 1.5F), at(9.5F, 1.5F), at(9.5F, 12.5F), at(3.5F, 7.5F)};
  expect_assembled(backend, c, Topology::strip, {0, 1, 2, cases::kRestart, 2, 3},
                   {{0, 1, 1}, {1, 2, 2}, {2, 3, 3}});
  expect_assembled(backend, c, Topology::triangles, {0, 1, 2, cases::kRestart, 2, 3},
                   {{0, 1, 1}, {2, 3, 3}});
  const Result<cases::Fragments> fan =
      backend.assembler()->draw_assembled(c, Topology::fan, std::vector<std::uint32_t>{0, 1, 2});
  ASSERT_FALSE(fan);
  EXPECT_EQ(fan.error().failure, Failure::unsupported);
}

}  // namespace rastercheck::backends
