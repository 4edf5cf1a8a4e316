// hairline: samples exactly on an edge, a depth plane or a user clip plane, or as close as floats
// get; triangles whose determinant is 0 or next to 0; planes of one depth midway between two
// floats; centres on the horizon. No double holds the numbers that decide these cases, so
// arithmetic in double gets them right only by luck.

#include <array>
#include <utility>

#include "cases/sample_pattern.h"
#include "properties/generator.h"
#include "properties/generators/internal/close_triangles.h"
#include "properties/generators/internal/exact_splits.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::hairline_generator {
namespace {

// --- the viewport ------------------------------------------------------------------------------

/// Sets a viewport whose numbers are multiples of 2^-12, so that a sample's homogeneous coordinates
/// have some 40 bits.
void set_fine_viewport(Draw& draw, cases::Case& c) {
  const int x = draw.between(-4096, 4096);
  const int y = draw.between(-4096, 4096);
  const int width = draw.between(-4096, 8192);
  const int height = draw.between(-4096, 8192);
  const bool is_turned = c.viewport.height < 0;
  c.viewport.x = static_cast<float>(x) / 4096;
  c.viewport.y = static_cast<float>(y) / 4096;
  c.viewport.width = static_cast<float>(c.framebuffer.width) + static_cast<float>(width) / 4096;
  c.viewport.height = static_cast<float>(c.framebuffer.height) + static_cast<float>(height) / 4096;
  if (!is_turned) return;
  c.viewport.y += c.viewport.height;
  c.viewport.height = -c.viewport.height;
}

/// Sets a viewport far larger than the framebuffer, which shows only a part of the viewport.
void set_large_viewport(Draw& draw, cases::Case& c) {
  const float width = draw.pick(std::array{256.0F, 1024.0F, 4096.0F, 8192.0F});
  const float height = draw.pick(std::array{256.0F, 1024.0F, 4096.0F});
  const bool is_turned = c.viewport.height < 0;
  const int most_x = 16 * (static_cast<int>(width) - c.framebuffer.width);
  const int most_y = 16 * (static_cast<int>(height) - c.framebuffer.height);
  const int x = draw.between(0, most_x);
  const int y = draw.between(0, most_y);
  c.viewport.x = -static_cast<float>(x) / 16;
  c.viewport.y = -static_cast<float>(y) / 16;
  c.viewport.width = width;
  c.viewport.height = height;
  if (!is_turned) return;
  c.viewport.y += height;
  c.viewport.height = -height;
}

/// Returns the depth z/w of the case's planes of equal depth. Usually also chooses a depth range
/// that maps z/w exactly midway between two floats: n + (f − n) t, where t has three bits. If n =
/// 0, no addition hides an error of z/w.
float set_level(Draw& draw, cases::Case& c) {
  const int eighths = draw.pick(std::array{3, 3, 5, 7, 7, 1});
  const float t = static_cast<float>(eighths) / 8;
  const float level = c.rules == cases::Rules::opengl ? 2 * t - 1 : t;
  if (draw.one_in(6)) return level;
  float n = draw.one_in(2) ? 0.0F : draw.unit();
  float f = draw.unit();
  if (c.rules == cases::Rules::d3d && n > f) std::swap(n, f);
  for (int step = 0; step < 32; ++step) {
    const float far = stepped(f, -step);
    const double depth = double{n} + (double{far} - double{n}) * double{t};
    const auto rounded = static_cast<float>(depth);
    const float other = stepped(rounded, double{rounded} < depth ? 1 : -1);
    const bool is_midway = double{rounded} != depth && double{rounded} + double{other} == 2 * depth;
    if (!is_midway || (c.rules == cases::Rules::d3d && n > far)) continue;
    c.viewport.min_depth = n;
    c.viewport.max_depth = far;
    break;
  }
  return level;
}

// --- triangles ---------------------------------------------------------------------------------

/// Adds a triangle with a sample at weights 1 : 1 : 1 that lies on a clip plane or next to it: the
/// corners' distances from the plane sum to 0 before they are nudged.
void add_plane(Draw& draw, cases::Case& c) {
  const Ray q = ray_through(c, visible_sample(draw, c));
  const bool is_user_plane = c.clip_distance_count > 0 && draw.one_in(2);
  const bool is_far = draw.one_in(2);
  const bool has_opposites = !draw.one_in(3);
  Corners corners;
  Distances distances{1, 1, 1};
  for (int attempt = 0; attempt < 32; ++attempt) {
    const double k = short_factor(draw);
    const double near_z = c.rules == cases::Rules::opengl ? -k * q.w : 0.0;
    const double z = is_far ? k * q.w : near_z;
    const auto x = split_in_three(draw, k * q.x);
    const auto y = split_in_three(draw, k * q.y);
    const auto w = split_in_three(draw, k * q.w);
    const double sum = is_user_plane ? 0 : z;
    const auto g = has_opposites ? split_off_opposites(draw, sum) : split_in_three(draw, sum);
    if (!x || !y || !w || !g) continue;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = {(*x)[i], (*y)[i], (*g)[i], (*w)[i]};
    if (is_user_plane) distances = *g;
    break;
  }
  if (is_user_plane) {
    set_level_depths(draw, c, corners);
    nudge_any(draw, std::array{distances.data(), &distances[1], &distances[2]});
  } else {
    nudge_any(draw, std::array{&corners[0].z, &corners[1].z, &corners[2].z});
  }
  add_with_distances(draw, c, corners, distances);
}

/// Adds a triangle of equal depth (exactly z_i w_j = z_j w_i), whose weights may be scaled by up to
/// 2^±40.
void add_level(Draw& draw, cases::Case& c, float level) {
  const int reach = draw.pick(std::array{0, 0, 3, 40});
  const bool is_mixed = draw.one_in(6);
  Corners corners;
  for (cases::ClipVertex& corner : corners) {
    const int bits = draw.between(1, 1 << 20);  // the level adds three bits
    const int exponent = draw.between(-reach, reach);
    const float w = to_float(bits * power_of_two(exponent));
    const WindowPoint p = point_about(draw, c);
    corner = at_window(c, p, 0, is_mixed && draw.one_in(2) ? -w : w);
    corner.z = level * corner.w;
  }
  add_with_distances(draw, c, corners, {1, 1, 1});
}

/// Adds a triangle with one corner exactly at a sample; the other corners are anywhere.
void add_corner(Draw& draw, cases::Case& c) {
  const Ray q = ray_through(c, visible_sample(draw, c));
  Corners corners;
  corners[0] = {to_float(q.x), to_float(q.y), 0, to_float(q.w)};
  for (std::size_t i = 1; i < 3; ++i) {
    const WindowPoint p = point_about(draw, c);
    const float w = draw.spread(-8, 8);
    corners[i] = at_window(c, p, 0, w);
  }
  set_level_depths(draw, c, corners);
  add_with_distances(draw, c, corners, {1, 1, 1});
}

/// Adds a triangle that covers a sample of a pixel whose centre lies on the horizon, 1/w = 0, or
/// next to it. Attributes located at the centre are extrapolated, and the terms of Σ E_i cancel
/// there.
///
/// For the centre o, the sample s and any t, the corners are 2o − s + (k + 2) t, s − o − k t and t.
/// Then o has the weights 1, 1, −2, whose sum is 0, and s has 1, 2, k − 2.
void add_horizon(Draw& draw, cases::Case& c) {
  const auto pattern = cases::standard_pattern(c.framebuffer.samples);
  const WindowPoint at = visible_sample(draw, c);
  const WindowPoint pixel{static_cast<double>(static_cast<int>(at.u)),
                          static_cast<double>(static_cast<int>(at.v))};
  const int chosen = draw.between(0, static_cast<int>(pattern.size()) - 1);
  const cases::SamplePosition sample = pattern[static_cast<std::size_t>(chosen)];
  const Ray o = ray_through(c, {pixel.u + 0.5, pixel.v + 0.5});
  const Ray s = ray_through(c, {pixel.u + sample.x / 16.0, pixel.v + sample.y / 16.0});
  const double k = draw.between(3, 6);
  const double along = draw.between(-255, 255) / 128.0;
  const double weight = draw.between(-255, 255) / 256.0;
  const bool is_upright = draw.one_in(2);
  const Ray t{is_upright ? 0 : along, is_upright ? along : 0, weight};
  const auto corner = [&](double of_o, double of_s, double of_t) {
    return cases::ClipVertex{to_float(of_o * o.x + of_s * s.x + of_t * t.x),
                             to_float(of_o * o.y + of_s * s.y + of_t * t.y), 0,
                             to_float(of_o * o.w + of_s * s.w + of_t * t.w)};
  };
  Corners corners{corner(2, -1, k + 2), corner(-1, 1, -k), corner(0, 0, 1)};
  (is_upright ? corners[2].x : corners[2].y) = draw.spread(-48, -16);
  set_exact_depths(draw, corners);
  add_with_distances(draw, c, corners, {1, 1, 1});
}

/// Sets values of very different magnitudes, so that a weight that is not quite 0 shows.
void spread_values(Draw& draw, cases::Case& c) {
  for (float& value : c.attribute_values) value = draw.spread(-60, 60);
}

/// Adds a triangle of any kind except that of add_horizon().
void add_any(Draw& draw, cases::Case& c, float level) {
  enum class Kind { edge, plane, edge_on, one_depth, needle, corner };
  const auto kind = draw.pick(
      std::array{Kind::edge, Kind::edge, Kind::edge, Kind::plane, Kind::plane, Kind::plane,
                 Kind::edge_on, Kind::edge_on, Kind::one_depth, Kind::one_depth, Kind::one_depth,
                 Kind::needle, Kind::needle, Kind::needle, Kind::needle, Kind::corner});
  switch (kind) {
    case Kind::edge:
      add_close_edge(draw, c);
      return;
    case Kind::plane:
      add_plane(draw, c);
      return;
    case Kind::edge_on:
      add_edge_on(draw, c);
      return;
    case Kind::one_depth:
      add_level(draw, c, level);
      return;
    case Kind::needle:
      add_needle(draw, c);
      return;
    case Kind::corner:
      add_corner(draw, c);
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 12;  // many triangles, few pixels
  request.has_clip_distances = false;
  request.is_on_grid = !draw.one_in(3);
  cases::Case c = random_state(draw, request);
  if (!request.is_on_grid) {
    set_fine_viewport(draw, c);
  } else if (draw.one_in(2)) {
    set_large_viewport(draw, c);
  }
  if (c.framebuffer.samples == 1 && draw.one_in(3)) c.framebuffer.samples = 4;
  if (draw.one_in(3)) c.clip_distance_count = 1;
  const bool has_horizon = c.framebuffer.samples > 1 && !draw.one_in(4);
  for (cases::Attribute& attribute : c.attributes) {
    if (draw.one_in(4)) attribute.interpolation = cases::Interpolation::noperspective;
  }
  if (has_horizon) {
    if (c.attributes.empty()) c.attributes.emplace_back().name = "a0";
    c.attributes[0].interpolation = cases::Interpolation::smooth;
    c.attributes[0].location = cases::Location::center;
  }
  const float level = set_level(draw, c);
  const int triangles = draw.between(12, 28 + draw.size() / 10);
  for (int i = 0; i < triangles; ++i) {
    if (has_horizon && draw.one_in(4)) {
      add_horizon(draw, c);
    } else {
      add_any(draw, c, level);
    }
  }
  add_attribute_values(draw, c);
  if (draw.one_in(3)) spread_values(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"hairline", "samples on edges and clip planes, or as close to them as floats get", &make});

}  // namespace
}  // namespace rastercheck::properties::hairline_generator
