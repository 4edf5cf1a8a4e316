// grids: rows and columns of many small or distant quads. Some cases are a floor in perspective
// that runs up to the horizon, possibly with its first row behind the eye. The others are small
// rotated squares, most of them about a pixel or less, each with one triangle reversed, at weights
// from 0.1 to 4.

#include <array>
#include <cstdint>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::grids_generator {
namespace {

/// Adds two triangles for a quad with four corners in order; reverses the second one if asked.
void add_quad(cases::Case& c, const std::array<std::uint32_t, 4>& corners, bool is_reversed) {
  c.triangles.push_back({corners[0], corners[1], corners[2]});
  const std::uint32_t third = is_reversed ? corners[3] : corners[2];
  const std::uint32_t last = is_reversed ? corners[2] : corners[3];
  c.triangles.push_back({corners[0], third, last});
}

/// Adds the quads between rows of `columns` + 1 vertices, which were added row by row from vertex
/// `first` on.
void add_quads(Draw& draw, cases::Case& c, std::uint32_t first, int rows, int columns) {
  const bool is_reversed = draw.one_in(4);
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t at =
          first + static_cast<std::uint32_t>(row) * stride + static_cast<std::uint32_t>(column);
      add_quad(c, {at, at + 1, at + stride + 1, at + stride}, is_reversed);
    }
  }
}

/// Adds a floor or a ceiling, seen from a height of one unit. Clip x and y are world coordinates
/// (X, −1) times the cotangents of half the fields of view; w is the distance. The distance grows
/// by the same factor from each row to the next, so the rows approach the horizon (y/w = 0 if the
/// view is level).
void add_floor(Draw& draw, cases::Case& c) {
  const int rows = draw.between(3, 6 + draw.size() / 16);
  const int columns = draw.between(1, 4);
  const float cot_x = draw.uniform(0.25F, 2);
  const float cot_y = draw.one_in(2) ? draw.uniform(0.25F, 2) : -draw.uniform(0.25F, 2);
  const float pitch = draw.one_in(2) ? 0.0F : draw.uniform(-0.5F, 0.5F);
  const float roll = draw.one_in(2) ? 0.0F : draw.uniform(-0.5F, 0.5F);
  const double growth = draw.pick(std::array{1.5, 2.0, 4.0, 16.0});
  const bool begins_behind = draw.one_in(2);
  const double width = draw.pick(std::array{0.5, 2.0, 16.0});
  // z/w runs from the near plane at w = near_w to the far plane at infinity.
  const double near_w = draw.pick(std::array{0.125, 0.01, 0.5});
  const double near_z = double{near_depth(c)};

  const auto first = static_cast<std::uint32_t>(c.positions.size());
  double distance = draw.one_in(2) ? 0.5 : 0.5 + double{draw.unit()};
  for (int row = 0; row <= rows; ++row) {
    const double w = row == 0 && begins_behind ? -distance : distance;
    for (int column = 0; column <= columns; ++column) {
      const double x = (static_cast<double>(column) - columns / 2.0) * width * 2;
      const double clip_x = double{cot_x} * x;
      const double clip_y = double{cot_y} * -1 + double{pitch} * w;
      // z = a w + b with z = near_z w at w = near_w; a = 1, as z/w → 1 at infinity.
      const double z = w - (1 - near_z) * near_w;
      add_vertex(c, {to_float(clip_x - double{roll} * clip_y),
                     to_float(clip_y + double{roll} * clip_x), to_float(z), to_float(w)});
    }
    distance *= growth;
  }
  add_quads(draw, c, first, rows, columns);
}

/// Adds 4×4 squares around samples of a grid, rotated by any angle within 0…45°; the second
/// triangle of each square is reversed.
void add_squares(Draw& draw, cases::Case& c) {
  const WindowPoint from = visible_sample(draw, c);
  const double half_side = draw.pick(std::array{0.15, 0.15, 0.5, 0.75, 2.0});
  const double spacing = half_side < 1 ? 1 : 2 * half_side;
  // The angle is 2 atan(t); t up to √2 − 1 gives 0…45°.
  const double t = draw.one_in(8) ? 0 : double{draw.uniform(0, 0.41421354F)};
  const double cosine = (1 - t * t) / (1 + t * t);
  const double sine = 2 * t / (1 + t * t);
  const float depth = random_depth(draw, c);
  const bool has_one_weight = draw.one_in(2);
  const float weight = draw.uniform(0.1F, 4);
  for (int i = 0; i < 16; ++i) {
    const int column = i % 4;
    const int row = i / 4;
    const double middle_u = from.u + spacing * column;
    const double middle_v = from.v + spacing * row;
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
      const double s = k == 1 || k == 2 ? half_side : -half_side;
      const double r = k >= 2 ? half_side : -half_side;
      const WindowPoint p{middle_u + cosine * s - sine * r, middle_v + sine * s + cosine * r};
      const float w = has_one_weight ? weight : draw.uniform(0.1F, 4);
      corners[k] = add_vertex(c, at_window(c, p, depth, w));
    }
    add_quad(c, corners, true);
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.least_side = 16;
  request.most_side = 40;
  cases::Case c = random_state(draw, request);
  if (draw.one_in(2)) {
    add_floor(draw, c);
  } else {
    const int fields = draw.between(1, 2 + draw.size() / 40);
    for (int i = 0; i < fields; ++i) add_squares(draw, c);
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"grids", "floors up to the horizon, and 4×4 turned squares of a fraction of a pixel", &make});

}  // namespace
}  // namespace rastercheck::properties::grids_generator
