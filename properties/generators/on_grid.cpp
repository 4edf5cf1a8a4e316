// on-grid: triangles as in sprites, CAD and text, with corners exactly on pixel centres and
// corners, on samples, or on the 2^-8 grid. Edges run exactly through samples, so that every tie
// rule is exercised.

#include <array>
#include <cstdint>
#include <utility>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::on_grid_generator {
namespace {

/// A point of the grid with `grid` points per pixel (0: a sample), in or near the visible part.
WindowPoint grid_point(Draw& draw, const cases::Case& c, int grid) {
  if (grid == 0) return visible_sample(draw, c);
  const WindowPoint p = point_about(draw, c);
  const auto whole = [grid](double coordinate) {
    return static_cast<double>(static_cast<int>(coordinate * grid)) / grid;
  };
  return {whole(p.u), whole(p.v)};
}

/// The weights of one triangle or quad: powers of two, which keep positions exact.
struct PowerWeights {
  bool is_equal = true;
  float first = 1;
};

PowerWeights random_weights(Draw& draw) {
  const bool is_equal = !draw.one_in(3);
  const float first = draw.pick(std::array{1.0F, 0.5F, 4.0F});
  return {is_equal, first};
}

float random_weight(Draw& draw, const PowerWeights& weights) {
  return weights.is_equal ? weights.first : draw.pick(std::array{0.25F, 0.5F, 1.0F, 2.0F});
}

/// z/w of a whole shape, or of one corner if the shape is tilted. A multiple of 1/8, possibly on a
/// depth plane.
float grid_depth(Draw& draw, const cases::Case& c) {
  const int least = near_depth(c) < 0 ? -8 : 0;
  const int eighths = draw.between(least, 8);
  return static_cast<float>(eighths) / 8;
}

void add_grid_triangle(Draw& draw, cases::Case& c, int grid) {
  const PowerWeights weights = random_weights(draw);
  const bool is_tilted = draw.one_in(2);
  const float plane = grid_depth(draw, c);
  for (int i = 0; i < 3; ++i) {
    const WindowPoint p = grid_point(draw, c, grid);
    const float depth = is_tilted ? grid_depth(draw, c) : plane;
    const float w = random_weight(draw, weights);
    add_vertex(c, at_window(c, p, depth, w));
  }
  const auto last = static_cast<std::uint32_t>(c.positions.size() - 1);
  c.triangles.push_back({last - 2, last - 1, last});
}

/// Adds a rectangle, or a quadrilateral with its sides slanted by a grid vector. If the sides are
/// equally long, the diagonal meets pixel centres.
void add_quad(Draw& draw, cases::Case& c, int grid) {
  const WindowPoint corner = grid_point(draw, c, grid);
  const int along = draw.between(1, 12);
  const int across = draw.one_in(2) ? along : draw.between(1, 12);
  const int slant = draw.one_in(2) ? 0 : draw.between(-3, 3);
  const WindowPoint right{static_cast<double>(along), static_cast<double>(slant)};
  const WindowPoint down{static_cast<double>(-slant), static_cast<double>(across)};

  const PowerWeights weights = random_weights(draw);
  const float depth = grid_depth(draw, c);
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (int i = 0; i < 4; ++i) {
    const double s = i == 1 || i == 2 ? 1 : 0;
    const double t = i >= 2 ? 1 : 0;
    const WindowPoint p{corner.u + s * right.u + t * down.u, corner.v + s * right.v + t * down.v};
    const float w = random_weight(draw, weights);
    add_vertex(c, at_window(c, p, depth, w));
  }
  c.triangles.push_back({first, first + 1, first + 2});
  c.triangles.push_back({first, first + 2, first + 3});
  if (draw.one_in(4)) std::swap(c.triangles.back()[0], c.triangles.back()[1]);  // folded
}

/// Adds a triangle with an edge exactly through two samples, extended beyond both by integer
/// multiples of their distance, so that every sample on the edge is a tie.
void add_edge_through_samples(Draw& draw, cases::Case& c) {
  const WindowPoint a = visible_sample(draw, c);
  const WindowPoint b = visible_sample(draw, c);
  const double before = static_cast<double>(draw.between(0, 2));
  const double beyond = static_cast<double>(draw.between(1, 3));
  const WindowPoint start{a.u - before * (b.u - a.u), a.v - before * (b.v - a.v)};
  const WindowPoint end{a.u + beyond * (b.u - a.u), a.v + beyond * (b.v - a.v)};
  const WindowPoint third = grid_point(draw, c, 256);
  const float depth = grid_depth(draw, c);
  const cases::ClipVertex first = at_window(c, start, depth, 1);
  const cases::ClipVertex second = at_window(c, end, depth, 1);
  const cases::ClipVertex last = at_window(c, third, depth, 1);
  add_triangle(c, first, second, last);
}

/// Adds a triangle with an edge exactly through a sample. The edge's ends have different weights
/// that are not powers of two.
void add_projective_edge(Draw& draw, cases::Case& c) {
  const WindowPoint sample = visible_sample(draw, c);
  const float depth = grid_depth(draw, c);
  const auto edge = edge_through(draw, c, sample, depth);
  const WindowPoint third = point_about(draw, c);
  const float w = draw.uniform(0.25F, 4);
  const cases::ClipVertex last = at_window(c, third, depth, w);
  add_triangle(c, edge[0], edge[1], last);
}

/// Sets opposite distances at every triangle's first and second vertex. If the two weights are
/// equal, or the edge is one of add_projective_edge(), the clip plane meets the edge at a point
/// that is often a sample.
void add_opposite_distances(Draw& draw, cases::Case& c) {
  for (const cases::Triangle& triangle : c.triangles) {
    for (std::size_t d = 0; d < c.clip_distance_count; ++d) {
      const float distance = draw.uniform(-1, 1);
      c.clip_distances[triangle[0] * c.clip_distance_count + d] = distance;
      c.clip_distances[triangle[1] * c.clip_distance_count + d] = -distance;
    }
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.is_on_grid = true;
  cases::Case c = random_state(draw, request);
  // 0 stands for the samples themselves.
  const int grid = draw.pick(std::array{0, 0, 1, 2, 2, 2, 16, 256});
  const int shapes = draw.between(1, 2 + draw.size() / 30);
  for (int i = 0; i < shapes; ++i) {
    switch (draw.between(0, 4)) {
      case 0:
        add_grid_triangle(draw, c, grid);
        break;
      case 4:
        add_projective_edge(draw, c);
        break;
      case 1:
        add_edge_through_samples(draw, c);
        break;
      default:
        add_quad(draw, c, grid);
    }
  }
  add_attribute_values(draw, c);
  if (draw.one_in(3)) c.clip_distance_count = 1;
  add_clip_distances(draw, c);
  if (!draw.one_in(4)) add_opposite_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"on-grid", "corners on pixels, samples and the 1/256 grid, edges through samples", &make});

}  // namespace
}  // namespace rastercheck::properties::on_grid_generator
