// degenerate: triangles with exactly no area: corners that coincide, in clip space or only on the
// screen, corners on one line, planes through the eye, vertices without a position (x = y = w = 0).
// Degenerate triangles draw nothing, whatever the rounding, and do not affect triangles that share
// their vertices.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::degenerate_generator {
namespace {

/// Returns a position in or near the visible part. Its numbers have few bits, so that sums of a few
/// positions stay exact.
cases::ClipVertex short_position(Draw& draw) {
  const auto number = [&draw](int most) {
    return static_cast<float>(draw.between(-most, most)) / 1024;
  };
  const float x = number(2048);
  const float y = number(2048);
  const float w = static_cast<float>(draw.between(256, 2048)) / 1024;
  return {x, y, w / 2, w};
}

cases::ClipVertex sum_of(const cases::ClipVertex& a, float m, const cases::ClipVertex& b, float n) {
  return {m * a.x + n * b.x, m * a.y + n * b.y, m * a.z + n * b.z, m * a.w + n * b.w};
}

cases::ClipVertex times(const cases::ClipVertex& p, float factor) {
  return sum_of(p, factor, {0, 0, 0, 0}, 0);
}

/// Adds a triangle that starts with any of its vertices, in either orientation.
void add_turned(Draw& draw, cases::Case& c, cases::Triangle triangle) {
  const int turns = draw.between(0, 2);
  std::rotate(triangle.begin(), triangle.begin() + turns, triangle.end());
  if (draw.one_in(2)) std::swap(triangle[1], triangle[2]);
  c.triangles.push_back(triangle);
}

/// Returns a third vertex with which the triangle of a and b has no area.
cases::ClipVertex flattening(Draw& draw, const cases::ClipVertex& a, const cases::ClipVertex& b) {
  switch (draw.between(0, 6)) {
    case 0:  // equal to b
      return b;
    case 1:  // the same place on the screen, with another weight
      return times(b, draw.pick(std::array{0.5F, 2.0F, 3.0F, -1.0F}));
    case 2: {  // x = y = w = 0, which has no position
      const float z = draw.one_in(2) ? 0.0F : 0.5F;
      return {0, 0, z, any_zero(draw)};
    }
    case 3: {  // on the line through both, between or beyond them
      const float n = draw.pick(std::array{0.25F, 0.5F, 0.75F, -0.5F, 1.5F});
      return sum_of(a, 1 - n, b, n);
    }
    default: {  // in the plane through both and the eye; may be behind the eye
      const auto m = static_cast<float>(draw.between(-3, 3));
      const auto n = static_cast<float>(draw.between(-3, 3));
      return sum_of(a, m, b, n);
    }
  }
}

/// Adds a visible triangle, and triangles without area that share vertices with it or lie on it.
void add_group(Draw& draw, cases::Case& c) {
  std::array<cases::ClipVertex, 3> corners;
  for (cases::ClipVertex& p : corners) p = short_position(draw);
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  add_triangle(c, corners[0], corners[1], corners[2]);
  if (draw.one_in(2)) std::swap(c.triangles.back()[0], c.triangles.back()[1]);
  const int flat = draw.between(1, 4);
  for (int i = 0; i < flat; ++i) {
    const auto from = static_cast<std::size_t>(draw.between(0, 2));
    const std::size_t to = (from + 1) % 3;
    const auto a = first + static_cast<std::uint32_t>(from);
    const auto b = first + static_cast<std::uint32_t>(to);
    if (draw.one_in(6)) {  // uses a vertex twice or three times
      add_turned(draw, c, {a, a, draw.one_in(2) ? a : b});
      continue;
    }
    add_turned(draw, c, {a, b, add_vertex(c, flattening(draw, corners[from], corners[to]))});
  }
}

/// Adds a triangle of numbers of any magnitude. In all corners, one coordinate is the same multiple
/// of another (or 0), so that the corners are coplanar with the eye.
void add_of_any_size(Draw& draw, cases::Case& c) {
  const int kind = draw.between(0, 2);
  const float slope = draw.pick(std::array{0.0F, 1.0F, -0.5F, 2.0F});
  std::array<cases::ClipVertex, 3> corners;
  for (cases::ClipVertex& p : corners) {
    const float x = draw.spread(-60, 60);
    const float y = draw.spread(-60, 60);
    const float w = draw.spread(-60, 60);
    p = {x, y, 0, w};
    if (kind == 0) p.y = slope * p.x;
    if (kind == 1) p.x = slope * p.w;
    if (kind == 2) p.w = slope * p.y;
    p.z = p.w / 2;
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 40;
  cases::Case c = random_state(draw, request);
  const int groups = draw.between(1, 2 + draw.size() / 34);
  for (int i = 0; i < groups; ++i) {
    add_group(draw, c);
    if (draw.one_in(2)) add_of_any_size(draw, c);
  }
  // A viewport without area draws nothing.
  if (draw.one_in(24)) (draw.one_in(2) ? c.viewport.width : c.viewport.height) = 0;
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"degenerate", "triangles without any area, next to and on others that are drawn", &make});

}  // namespace
}  // namespace rastercheck::properties::degenerate_generator
