#pragma once

// Tests of lines and points as drivers draw them, by cases of 16 × 16 pixels whose fragments are
// known by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "backends/backend.h"
#include "tests/backends/window_cases.h"

namespace rastercheck::backends {

/// A case without lines yet, with a smooth and a flat attribute.
inline cases::Case case_of_lines(cases::Rules rules, cases::LineMode mode, int samples = 1) {
  cases::Case c = empty_case(rules);
  c.framebuffer.samples = samples;
  c.primitive = cases::Primitive::lines;
  c.line_mode = mode;
  c.attributes = {{"smooth"}, {"flat", cases::Interpolation::flat}};
  return c;
}

inline cases::Case case_of_points(cases::Rules rules, float size) {
  cases::Case c = case_of_lines(rules, cases::LineMode::rectangular);
  c.primitive = cases::Primitive::points;
  c.point_size = size;
  return c;
}

/// Adds a line with the values 0 to 1 and, flat, 7 and 9.
inline void add_line(cases::Case& c, const cases::ClipVertex& a, const cases::ClipVertex& b) {
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  c.positions.insert(c.positions.end(), {a, b});
  c.attribute_values.insert(c.attribute_values.end(), {0, 7, 1, 9});
  c.triangles.push_back({first, first + 1, first + 1});
}

/// Adds a point with the values 5 and 7.
inline void add_point(cases::Case& c, const cases::ClipVertex& vertex) {
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  c.positions.push_back(vertex);
  c.attribute_values.insert(c.attribute_values.end(), {5, 7});
  c.triangles.push_back({first, first, first});
}

inline cases::Fragments drawn_by(Backend& backend, const cases::Case& c) {
  Result<cases::Fragments> drawn = fragments_of(backend.draw(c));
  EXPECT_TRUE(drawn) << to_string(drawn.error());
  return drawn.value_or(cases::Fragments());
}

using PixelSet = std::set<std::pair<int, int>>;

/// The pixels of a primitive.
inline PixelSet pixels_of_primitive(const cases::Fragments& drawn, std::uint32_t index) {
  PixelSet pixels;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn.triangle[i] == index) pixels.emplace(drawn.x[i], drawn.y[i]);
  }
  return pixels;
}

/// Pixels (x, y) with x0 <= x <= x1 and y0 <= y <= y1.
inline PixelSet box_of_pixels(int x0, int x1, int y0, int y1) {
  PixelSet pixels;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) pixels.emplace(x, y);
  }
  return pixels;
}

/// Lines from x = 2.25 to 7.25 leave the diamonds of pixels 2 to 6, which are also those whose
/// centres are between the ends. With a share s of the second end in the window, where w is 3, its
/// share in clip space is s/(3 − 2 s).
/// Kills: a line as a triangle; its vertices in another order; three vertices per line.
inline void expect_lines(Backend& backend, cases::Rules rules, cases::LineMode mode) {
  cases::Case c = case_of_lines(rules, mode);
  add_line(c, at(2.25F, 4.5F, 0.25F), at(7.25F, 4.5F, 0.75F, 3));
  add_line(c, at(11.5F, 3.25F, 0.25F), at(11.5F, 8.25F, 0.75F, 3));
  const cases::Fragments drawn = drawn_by(backend, c);
  EXPECT_EQ(pixels_of_primitive(drawn, 0), box_of_pixels(2, 6, 4, 4));
  EXPECT_EQ(pixels_of_primitive(drawn, 1), box_of_pixels(11, 11, 3, 7));
  ASSERT_EQ(drawn.size(), 10U);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto along = static_cast<float>(drawn.triangle[i] == 0 ? drawn.x[i] - 2 : drawn.y[i] - 3);
    const float s = (along + 0.25F) / 5;
    EXPECT_NEAR(drawn.attributes_of(i)[0], s / (3 - 2 * s), 0x1p-12F);
    EXPECT_EQ(drawn.attributes_of(i)[1], rules == cases::Rules::opengl ? 9 : 7);
    const float z = 0.25F + s / 2;
    EXPECT_NEAR(drawn.depth[i], rules == cases::Rules::opengl ? (z + 1) / 2 : z, 0x1p-12F);
  }
}

/// Kills: a width that is not handed over.
inline void expect_wide_lines(Backend& backend, cases::Rules rules, cases::LineMode mode) {
  cases::Case c = case_of_lines(rules, mode);
  c.line_width = 3;
  add_line(c, at(2.25F, 4.5F), at(7.25F, 4.5F));
  add_line(c, at(11.5F, 3.25F), at(11.5F, 8.25F));
  const cases::Fragments drawn = drawn_by(backend, c);
  EXPECT_EQ(pixels_of_primitive(drawn, 0), box_of_pixels(2, 6, 3, 5));
  EXPECT_EQ(pixels_of_primitive(drawn, 1), box_of_pixels(10, 12, 3, 7));
}

/// Kills: a size that is not handed over; three vertices per point.
inline void expect_points(Backend& backend, cases::Rules rules) {
  cases::Case c = case_of_points(rules, 3);
  add_point(c, at(6.5F, 9.5F, 0.5F, 3));
  add_point(c, at(2.5F, 3.5F, 0.5F, 2));
  const cases::Fragments drawn = drawn_by(backend, c);
  EXPECT_EQ(pixels_of_primitive(drawn, 0), box_of_pixels(5, 7, 8, 10));
  EXPECT_EQ(pixels_of_primitive(drawn, 1), box_of_pixels(1, 3, 2, 4));
  ASSERT_EQ(drawn.size(), 18U);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_NEAR(drawn.attributes_of(i)[0], 5, 0x1p-18F);
    EXPECT_EQ(drawn.attributes_of(i)[1], 7);
    EXPECT_NEAR(drawn.depth[i], rules == cases::Rules::opengl ? 0.75F : 0.5F, 0x1p-20F);
  }
  c.point_size = 1;
  EXPECT_EQ(pixels_of_primitive(drawn_by(backend, c), 0), box_of_pixels(6, 6, 9, 9));
}

/// The fragments of lines and of points are the same in layers and as records.
inline void expect_primitives_alike(Backend& backend, cases::Rules rules, cases::LineMode mode) {
  cases::Case lines = case_of_lines(rules, mode);
  cases::Case points = case_of_points(rules, 2);
  for (int i = 0; i < 40; ++i) {
    const auto u = static_cast<float>(i * 7 % 16) + 0.4F;
    const auto v = static_cast<float>(i * 3 % 16) + 0.3F;
    add_line(lines, at(u, v, 0.25F), at(8, 8.7F, 0.5F, 2));
    add_point(points, at(u, v, 0.25F));
  }
  for (const cases::Case* const c : {&lines, &points}) {
    WaysOfDrawing& ways = *backend.ways_of_drawing();
    const auto appended = ways.draw_by(*c, cases::DrawBy::append);
    const auto layers = ways.draw_by(*c, cases::DrawBy::layers);
    ASSERT_TRUE(appended) << to_string(appended.error());
    ASSERT_TRUE(layers) << to_string(layers.error());
    EXPECT_GT(layers->size(), 100U);
    EXPECT_EQ(appended->triangle, layers->triangle);
    EXPECT_EQ(appended->x, layers->x);
    EXPECT_EQ(appended->y, layers->y);
    EXPECT_EQ(appended->depth, layers->depth);
    EXPECT_EQ(appended->attributes, layers->attributes);
  }
}

/// A width and a size that no driver has.
inline void expect_sizes_refused(Backend& backend, cases::Rules rules, cases::LineMode mode) {
  cases::Case lines = case_of_lines(rules, mode);
  lines.line_width = 16000;
  add_line(lines, at(2, 4), at(7, 4));
  cases::Case points = case_of_points(rules, 16000);
  add_point(points, at(2, 4));
  for (const cases::Case* const c : {&lines, &points}) {
    const auto drawn = backend.draw(*c);
    ASSERT_FALSE(drawn);
    EXPECT_EQ(drawn.error().failure, Failure::unsupported);
    EXPECT_THAT(drawn.error().reason, testing::HasSubstr("16000"));
  }
}

/// A picture of a line and one of a point.
inline void expect_pictures_of_primitives(Backend& backend, cases::Rules rules,
                                          cases::LineMode mode) {
  cases::Case lines = case_of_lines(rules, mode);
  add_line(lines, at(2.25F, 4.5F, 0.5F), at(7.25F, 4.5F, 0.5F));
  cases::Case points = case_of_points(rules, 3);
  add_point(points, at(6.5F, 9.5F, 0.5F));
  for (const auto& [c, pixels] : {std::pair(&lines, box_of_pixels(2, 6, 4, 4)),
                                  std::pair(&points, box_of_pixels(5, 7, 8, 10))}) {
    const auto picture = backend.picture_drawer()->draw_picture(*c, {});
    ASSERT_TRUE(picture) << to_string(picture.error());
    PixelSet changed;
    for (std::size_t i = 0; i < picture->depth.size(); ++i) {
      if (picture->depth[i] != 1)
        changed.emplace(static_cast<int>(i % 16), static_cast<int>(i / 16));
    }
    EXPECT_EQ(changed, pixels);
  }
}

}  // namespace rastercheck::backends
