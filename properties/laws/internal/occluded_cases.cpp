#include "properties/laws/internal/occluded_cases.h"

#include <array>
#include <string>

#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::ClipVertex;

/// Longer than any side of a framebuffer, in pixels.
constexpr double kFar = 64;

/// The z/w of a window depth that lies the share `share` (0…1) from the nearest to the farthest.
float depth_at(const cases::Case& c, float share) {
  const bool is_reversed = c.viewport.min_depth > c.viewport.max_depth;
  const float near = near_depth(c);
  return near + (1 - near) * (is_reversed ? 1 - share : share);
}

/// A weight under which positions on the grid stay exact, or any other.
float weight(Draw& draw) {
  return draw.one_in(3) ? draw.uniform(0.25F, 4) : draw.pick(std::array{1.0F, 1.0F, 0.5F, 2.0F});
}

ClipVertex vertex_at(Draw& draw, const cases::Case& c, const WindowPoint& p, float share) {
  const float w = weight(draw);
  return at_window(c, p, depth_at(c, share), w);
}

/// The two triangles of a convex quad, whose corners share vertices.
void add_quad(cases::Case& c, const std::array<ClipVertex, 4>& corners) {
  std::array<std::uint32_t, 4> v{};
  for (std::size_t i = 0; i < 4; ++i) v[i] = add_vertex(c, corners[i]);
  c.triangles.push_back({v[0], v[1], v[2]});
  c.triangles.push_back({v[2], v[1], v[3]});
}

/// A direction of few bits, and the one a quarter turn further.
struct Frame {
  WindowPoint origin;
  WindowPoint along;

  WindowPoint at(double a, double b) const {
    return {origin.u + a * along.u - b * along.v, origin.v + a * along.v + b * along.u};
  }
};

Frame random_frame(Draw& draw, const cases::Case& c) {
  constexpr std::array<WindowPoint, 8> kDirections{
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0.25}, {0.5, 1}, {-1, 1}, {1, -0.0625}}};
  const WindowPoint origin = draw.one_in(4) ? visible_point(draw, c) : visible_sample(draw, c);
  return {origin, draw.pick(kDirections)};
}

/// A quad between the lines b = b0 and b = b1 of a frame.
void add_band(Draw& draw, cases::Case& c, const Frame& frame, double b0, double b1, double a0,
              double a1, float share) {
  std::array<ClipVertex, 4> corners;
  const std::array<WindowPoint, 4> places{
      {frame.at(a0, b0), frame.at(a1, b0), frame.at(a0, b1), frame.at(a1, b1)}};
  for (std::size_t i = 0; i < 4; ++i) corners[i] = vertex_at(draw, c, places[i], share);
  add_quad(c, corners);
}

float occluder_share(Draw& draw) { return static_cast<float>(draw.between(1, 8)) / 16; }

/// Two occluders with a gap of a sample or less between them, at or beside a sample.
void add_gap(Draw& draw, cases::Case& c) {
  constexpr std::array<double, 7> kGaps{0, 0x1p-8, 0x1p-6, 0x1p-4, 0.25, 0.5, 1};
  const Frame frame = random_frame(draw, c);
  const double below = draw.pick(kGaps);
  const double above = draw.pick(kGaps);
  const float share = occluder_share(draw);
  add_band(draw, c, frame, above, kFar, -kFar, kFar, share);
  const float other = draw.one_in(2) ? share : occluder_share(draw);
  add_band(draw, c, frame, -kFar, -below, -kFar, kFar, other);
}

/// Occluders whose edges touch: one long edge against two short ones, which meet at a vertex in
/// its middle.
void add_t_junction(Draw& draw, cases::Case& c) {
  const Frame frame = random_frame(draw, c);
  const double meeting = draw.between(-8, 8) / 4.0;
  const float share = occluder_share(draw);
  add_band(draw, c, frame, 0, kFar, -kFar, kFar, share);
  add_band(draw, c, frame, -kFar, 0, -kFar, meeting, share);
  add_band(draw, c, frame, -kFar, 0, meeting, kFar, share);
}

/// Occluders that are cut at the near plane or reach behind the eye.
void add_through_near_plane(Draw& draw, cases::Case& c) {
  const int count = draw.between(1, 2);
  for (int i = 0; i < count; ++i) {
    std::array<ClipVertex, 3> corners;
    for (ClipVertex& corner : corners) {
      const WindowPoint p = point_about(draw, c);
      const float share = draw.uniform(-0.75F, 0.5F);
      corner = vertex_at(draw, c, p, share);
      if (draw.one_in(3)) corner.w = -corner.w;
    }
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
}

/// Occluders with a row of vertices some 2^27 pixels away.
void add_far_row(Draw& draw, cases::Case& c) {
  const double away = draw.pick(std::array{-0x1p27, 0x1p27, -0x1p20, 0x1p31});
  const Frame frame = random_frame(draw, c);
  const double nudge = draw.between(-4, 4) / 16.0;
  const float share = occluder_share(draw);
  add_band(draw, c, frame, nudge, kFar, away, kFar, share);
  if (draw.one_in(2)) add_band(draw, c, frame, -kFar, nudge, away, kFar, share);
}

/// Occluders anywhere, tilted.
void add_tilted_occluders(Draw& draw, cases::Case& c) {
  const int count = draw.between(1, 4);
  for (int i = 0; i < count; ++i) {
    std::array<ClipVertex, 3> corners;
    for (ClipVertex& corner : corners) {
      const WindowPoint p = draw.one_in(3) ? visible_sample(draw, c) : point_about(draw, c);
      const float share = draw.uniform(0, 0.75F);
      corner = vertex_at(draw, c, p, share);
    }
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
}

/// The triangle that is asked about: large or of few pixels, in the middle or across the viewport's
/// side, behind most occluders or tilted through them.
void add_occludee(Draw& draw, cases::Case& c) {
  const bool is_small = draw.one_in(2);
  const bool is_tilted = draw.one_in(4);
  const float share = static_cast<float>(draw.between(7, 15)) / 16;
  WindowPoint about = draw.one_in(3) ? point_about(draw, c) : visible_sample(draw, c);
  std::array<ClipVertex, 3> corners;
  for (ClipVertex& corner : corners) {
    WindowPoint p = point_about(draw, c);
    if (is_small) {
      const double du = draw.between(-48, 48) / 16.0;
      const double dv = draw.between(-48, 48) / 16.0;
      p = {about.u + du, about.v + dv};
    }
    const float own = is_tilted ? draw.uniform(0.25F, 1) : share;
    corner = vertex_at(draw, c, p, own);
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

/// An occludee in the plane of the last occluder, or some floats before or behind it: as many as
/// rounding explains, or as many as a step of a depth buffer of 16 bits.
void add_occludee_of_equal_depth(Draw& draw, cases::Case& c) {
  const cases::Triangle like = c.triangles.back();
  const int floats = draw.pick(std::array{0, 1, 2, 5, 20, 100, 400});
  const int steps = draw.one_in(3) ? floats : -floats;
  std::array<ClipVertex, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = c.positions[like[(i + 1) % 3]];
    corners[i].z = stepped(corners[i].z, steps);
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

}  // namespace

Generated occluded_case(Draw& draw) {
  StateRequest request;
  request.most_side = 32;
  request.is_on_grid = draw.one_in(2);
  Generated made;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  c.attributes.clear();
  c.depth_test = cases::DepthTest::less;
  if (!draw.one_in(4)) c.cull = cases::Cull::none;
  bool is_equal = false;
  switch (draw.between(0, 6)) {
    case 0:
    case 1:
      made.stratum = "gaps";
      add_gap(draw, c);
      break;
    case 2:
      made.stratum = "T-junctions";
      add_t_junction(draw, c);
      break;
    case 3:
      made.stratum = "through the near plane";
      add_through_near_plane(draw, c);
      break;
    case 4:
      made.stratum = "far vertices";
      add_far_row(draw, c);
      break;
    case 5:
      made.stratum = "equal depths";
      add_gap(draw, c);
      is_equal = true;
      break;
    default:
      made.stratum = "tilted";
      add_tilted_occluders(draw, c);
  }
  if (is_equal) {
    add_occludee_of_equal_depth(draw, c);
  } else {
    add_occludee(draw, c);
  }
  add_clip_distances(draw, c);
  return made;
}

}  // namespace rastercheck::properties
