#include "properties/window_position.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cases/sample_pattern.h"
#include "properties/exact_sum.h"
#include "properties/random_state.h"

namespace rastercheck::properties {
namespace {

struct Box {
  WindowPoint lo;
  WindowPoint hi;
};

/// Returns the part of [0, size] between `from` and `from + extent`; if that part is empty, [0,
/// size].
std::pair<double, double> overlap(double from, double extent, int size) {
  const double lo = std::max(0.0, std::min(from, from + extent));
  const double hi = std::min(static_cast<double>(size), std::max(from, from + extent));
  if (lo < hi) return {lo, hi};
  return {0.0, static_cast<double>(size)};
}

Box visible_box(const cases::Case& c) {
  const auto [u_lo, u_hi] =
      overlap(double{c.viewport.x}, double{c.viewport.width}, c.framebuffer.width);
  const auto [v_lo, v_hi] =
      overlap(double{c.viewport.y}, double{c.viewport.height}, c.framebuffer.height);
  return {{u_lo, v_lo}, {u_hi, v_hi}};
}

WindowPoint point_of(Draw& draw, const Box& box) {
  const double s = double{draw.unit()};
  const double t = double{draw.unit()};
  return {box.lo.u + s * (box.hi.u - box.lo.u), box.lo.v + t * (box.hi.v - box.lo.v)};
}

/// True if from + (1 + ndc/w) size/2 = at. Multiplied by 2 w: ndc · size + w (size + 2 from − 2 at)
/// = 0. Products of two floats are exact in double.
bool is_coordinate(double ndc, double w, double from, double size, double at) {
  return sign_of_sum(std::array{ndc * size, w * size, w * (2 * from), -(w * (2 * at))}) == 0;
}

}  // namespace

bool is_exactly_at(const cases::Case& c, const cases::ClipVertex& vertex, const WindowPoint& p) {
  const double y = c.rules == cases::Rules::d3d ? -double{vertex.y} : double{vertex.y};
  return is_coordinate(vertex.x, vertex.w, c.viewport.x, c.viewport.width, p.u) &&
         is_coordinate(y, vertex.w, c.viewport.y, c.viewport.height, p.v);
}

cases::ClipVertex at_window(const cases::Case& c, const WindowPoint& p, float depth, float w) {
  const double weight{w};
  const double x = 2 * (p.u - double{c.viewport.x}) / double{c.viewport.width} - 1;
  const double y = 2 * (p.v - double{c.viewport.y}) / double{c.viewport.height} - 1;
  const double turned = c.rules == cases::Rules::d3d ? -y : y;
  return {to_float(x * weight), to_float(turned * weight), to_float(double{depth} * weight), w};
}

WindowPoint window_point(const cases::Case& c, const cases::ClipVertex& vertex) {
  const cases::Viewport& viewport = c.viewport;
  const double turn = c.rules == cases::Rules::d3d ? -1 : 1;
  const double w = vertex.w;
  return {viewport.x + double{viewport.width} / 2 * (1 + vertex.x / w),
          viewport.y + double{viewport.height} / 2 * (1 + turn * vertex.y / w)};
}

std::uint32_t add_vertex(cases::Case& c, const cases::ClipVertex& position) {
  c.positions.push_back(position);
  return static_cast<std::uint32_t>(c.positions.size() - 1);
}

std::uint32_t add_vertex_like(cases::Case& c, std::uint32_t like, cases::ClipVertex position) {
  const auto append = [like](std::vector<float>& numbers, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(numbers[like * count + i]);
  };
  append(c.attribute_values, c.attributes.size());
  append(c.clip_distances, c.clip_distance_count);
  return add_vertex(c, position);
}

void add_triangle(cases::Case& c, const cases::ClipVertex& first, const cases::ClipVertex& second,
                  const cases::ClipVertex& third) {
  const std::uint32_t index = add_vertex(c, first);
  add_vertex(c, second);
  add_vertex(c, third);
  c.triangles.push_back({index, index + 1, index + 2});
}

WindowPoint visible_middle(const cases::Case& c) {
  const Box box = visible_box(c);
  return {(box.lo.u + box.hi.u) / 2, (box.lo.v + box.hi.v) / 2};
}

WindowPoint visible_point(Draw& draw, const cases::Case& c) {
  return point_of(draw, visible_box(c));
}

WindowPoint visible_sample(Draw& draw, const cases::Case& c) {
  const WindowPoint p = visible_point(draw, c);
  return sample_in_pixel(draw, c, p);
}

WindowPoint sample_in_pixel(Draw& draw, const cases::Case& c, const WindowPoint& p) {
  const auto pattern = cases::standard_pattern(c.framebuffer.samples);
  const int sample = draw.between(0, static_cast<int>(pattern.size()) - 1);
  const cases::SamplePosition at = pattern[static_cast<std::size_t>(sample)];
  // The coordinates are not negative, so truncation rounds down.
  const auto x = static_cast<double>(static_cast<int>(p.u));
  const auto y = static_cast<double>(static_cast<int>(p.v));
  return {x + at.x / 16.0, y + at.y / 16.0};
}

WindowPoint point_about(Draw& draw, const cases::Case& c) {
  Box box = visible_box(c);
  const double more_u = (box.hi.u - box.lo.u) / 4;
  const double more_v = (box.hi.v - box.lo.v) / 4;
  box.lo = {box.lo.u - more_u, box.lo.v - more_v};
  box.hi = {box.hi.u + more_u, box.hi.v + more_v};
  return point_of(draw, box);
}

std::array<cases::ClipVertex, 2> edge_through(Draw& draw, const cases::Case& c,
                                              const WindowPoint& p, float depth) {
  // In homogeneous coordinates b = k q − a, where q is the position of p, so p = (a + b)/k. As a
  // has 9 bits and q has 11 bits after the binary point, all numbers are exact in float32.
  const cases::ClipVertex q = at_window(c, p, depth, 1);
  const int w = draw.between(33, 255);
  const int x = draw.between(-w, w);
  const int y = draw.between(-w, w);
  const int k = draw.between(5, 12);
  const cases::ClipVertex a{static_cast<float>(x) / 64, static_cast<float>(y) / 64,
                            depth * static_cast<float>(w) / 64, static_cast<float>(w) / 64};
  const auto factor = static_cast<float>(k);
  return {a, {factor * q.x - a.x, factor * q.y - a.y, factor * q.z - a.z, factor - a.w}};
}

float random_depth(Draw& draw, const cases::Case& c) { return draw.uniform(near_depth(c), 1); }

std::vector<WindowPoint> sample_points(const cases::Case& c, const cases::Contract& contract) {
  if (contract.sample_position && c.framebuffer.samples == 1) {
    const cases::PixelFraction& at = *contract.sample_position;
    const double parts = at.parts;
    return {{at.x / parts, at.y / parts}};
  }
  std::vector<WindowPoint> points;
  for (const cases::SamplePosition& at : cases::standard_pattern(c.framebuffer.samples)) {
    points.push_back({at.x / 16.0, at.y / 16.0});
  }
  return points;
}

}  // namespace rastercheck::properties
