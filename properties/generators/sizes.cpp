// sizes: triangles of one extent per case, from 2^-8 pixels to 2^12, so that a rasterizer's paths
// for small, middling and large triangles are each tested alone. The smallest triangles come in all
// nine shifts by a subpixel around a sample, and triangles of three subpixels come in all eight
// octants.

#include <array>
#include <cstdint>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::sizes_generator {
namespace {

constexpr double kSubpixel = 0x1p-8;

/// Three corners in window pixels.
using Shape = std::array<WindowPoint, 3>;

void add_shape(cases::Case& c, const Shape& shape, const WindowPoint& at, float depth, float w) {
  std::array<cases::ClipVertex, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = at_window(c, {at.u + shape[i].u, at.v + shape[i].v}, depth, w);
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

float exact_weight(Draw& draw) { return draw.pick(std::array{1.0F, 1.0F, 0.5F, 4.0F}); }

/// Adds a triangle of at most 4×4 subpixels nine times: shifted from samples by −1, 0 or 1
/// subpixels in either direction.
void add_shifts(Draw& draw, cases::Case& c) {
  Shape shape;
  for (WindowPoint& p : shape) {
    p.u = kSubpixel * draw.between(-2, 2);
    p.v = kSubpixel * draw.between(-2, 2);
  }
  const float depth = random_depth(draw, c);
  const float w = exact_weight(draw);
  const bool is_one_sample = draw.one_in(2);
  WindowPoint sample = visible_sample(draw, c);
  for (int shift = 0; shift < 9; ++shift) {
    if (!is_one_sample) sample = visible_sample(draw, c);
    const int right = shift % 3 - 1;
    const int down = shift / 3 - 1;
    const WindowPoint at{sample.u + kSubpixel * right, sample.v + kSubpixel * down};
    add_shape(c, shape, at, depth, w);
  }
}

/// Adds eight triangles of three subpixels or larger, one per octant, all around the same sample or
/// each at a sample of its own.
void add_octants(Draw& draw, cases::Case& c) {
  const double size = 3 * kSubpixel * draw.pick(std::array{1.0, 1.0, 4.0, 256.0});
  const float depth = random_depth(draw, c);
  const float w = exact_weight(draw);
  const bool is_one_sample = draw.one_in(2);
  WindowPoint sample = visible_sample(draw, c);
  constexpr std::array<WindowPoint, 8> kRing{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  for (std::size_t i = 0; i < 8; ++i) {
    if (!is_one_sample) sample = visible_sample(draw, c);
    const WindowPoint& from = kRing[i];
    const WindowPoint& to = kRing[(i + 1) % 8];
    add_shape(c, {WindowPoint{0, 0}, {size * from.u, size * from.v}, {size * to.u, size * to.v}},
              sample, depth, w);
  }
}

/// Adds triangles that are 2^exponent pixels wide or high. Each lies around a sample, which most of
/// them contain.
void add_stratum(Draw& draw, cases::Case& c, int exponent) {
  const double extent = power_of_two(exponent);
  const int triangles = exponent < 3 ? draw.between(8, 16) : (exponent < 5 ? 4 : 2);
  const bool has_one_weight = draw.one_in(2);
  for (int i = 0; i < triangles; ++i) {
    const WindowPoint at = visible_sample(draw, c);
    const double s = 0.25 + 0.5 * double{draw.unit()};
    const double t = 0.25 + 0.5 * double{draw.unit()};
    const double rise = double{draw.uniform(-1, 1)};
    // The first two corners are the left and the right end, the third is above or below, and `at`
    // lies in between.
    const double height = draw.one_in(2) ? 1 : -1;
    Shape shape{WindowPoint{-s, -t * height},
                {1 - s, -t * height + rise / 4},
                {rise / 2, (1 - t) * height}};
    const bool is_upright = draw.one_in(2);
    std::array<cases::ClipVertex, 3> corners;
    const float depth = random_depth(draw, c);
    for (std::size_t k = 0; k < 3; ++k) {
      const double u = extent * (is_upright ? shape[k].v : shape[k].u);
      const double v = extent * (is_upright ? shape[k].u : shape[k].v);
      const float w = has_one_weight ? 1.0F : draw.uniform(0.25F, 4);
      corners[k] = at_window(c, {at.u + u, at.v + v}, depth, w);
    }
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
}

cases::Case make(Draw& draw) {
  const int kind = draw.between(0, 3);
  StateRequest request;
  request.least_side = 16;
  request.most_side = 40;
  request.is_on_grid = kind < 2 || draw.one_in(2);  // on the grid, ties are exact
  cases::Case c = random_state(draw, request);
  switch (kind) {
    case 0:
      add_shifts(draw, c);
      if (draw.one_in(2)) add_octants(draw, c);
      break;
    case 1:
      add_octants(draw, c);
      if (draw.one_in(2)) add_shifts(draw, c);
      break;
    default: {
      const int exponent = draw.between(-8, 12);
      add_stratum(draw, c, exponent);
    }
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"sizes", "triangles of one extent, 2^-8 to 2^12 pixels, at all shifts and octants", &make});

}  // namespace
}  // namespace rastercheck::properties::sizes_generator
