// meshes: many triangles that share vertices and edges, as in models: random triangulations that
// fill the whole screen, dense fans around a hub on or off the screen, strips, and edges that
// contain a vertex of another triangle. If one triangle draws a sample, its neighbours must leave
// the sample out.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::meshes_generator {
namespace {

/// A point of the window in whole subpixels, 2^-8 of a pixel.
struct LatticePoint {
  int u = 0;
  int v = 0;
};

constexpr int kSubpixels = 256;

LatticePoint grid_point(const WindowPoint& p) {
  return {static_cast<int>(p.u * kSubpixels), static_cast<int>(p.v * kSubpixels)};
}

WindowPoint window_point(const LatticePoint& p) {
  return {static_cast<double>(p.u) / kSubpixels, static_cast<double>(p.v) / kSubpixels};
}

/// Twice the area of a triangle, in square subpixels.
std::int64_t area(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return std::int64_t{b.u - a.u} * (c.v - a.v) - std::int64_t{c.u - a.u} * (b.v - a.v);
}

/// Chooses weights and depths for a mesh's vertices. The weights are all 1, powers of two (which
/// keep positions exact), or arbitrary.
class VertexMaker {
 public:
  VertexMaker(Draw& draw, const cases::Case& c) {
    kind_ = draw.between(0, 2);
    depth_ = random_depth(draw, c);
    is_level_ = draw.one_in(2);
  }

  std::uint32_t add(Draw& draw, cases::Case& c, const WindowPoint& p) const {
    float w = 1;
    if (kind_ == 1) w = draw.pick(std::array{0.25F, 0.5F, 1.0F, 2.0F, 4.0F});
    if (kind_ == 2) w = draw.uniform(0.1F, 4);
    const float depth = is_level_ ? depth_ : random_depth(draw, c);
    return add_vertex(c, at_window(c, p, depth, w));
  }

 private:
  int kind_;
  float depth_;
  bool is_level_;
};

/// Adds a triangle, starting with a random vertex.
void add_turned(Draw& draw, cases::Case& c, cases::Triangle triangle) {
  const int turns = draw.between(0, 2);
  std::rotate(triangle.begin(), triangle.begin() + turns, triangle.end());
  c.triangles.push_back(triangle);
}

/// A triangulation of a rectangle whose triangles all have the same orientation. Grows by inserting
/// points into triangles and by flipping diagonals of convex quadrilaterals.
class Triangulation {
 public:
  Triangulation(const LatticePoint& lo, const LatticePoint& hi)
      : points_{lo, {hi.u, lo.v}, hi, {lo.u, hi.v}}, triangles_{{0, 1, 2}, {0, 2, 3}} {}

  const std::vector<LatticePoint>& points() const { return points_; }
  const std::vector<cases::Triangle>& triangles() const { return triangles_; }

  /// Cuts the triangle that contains p into three; does nothing if p is on an edge.
  void insert(const LatticePoint& p) {
    const auto holds = [&](const cases::Triangle& t) {
      return area(points_[t[0]], points_[t[1]], p) > 0 &&
             area(points_[t[1]], points_[t[2]], p) > 0 && area(points_[t[2]], points_[t[0]], p) > 0;
    };
    const auto found = std::find_if(triangles_.begin(), triangles_.end(), holds);
    if (found == triangles_.end()) return;
    const auto last = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    const cases::Triangle t = *found;
    *found = {t[0], t[1], last};
    triangles_.push_back({t[1], t[2], last});
    triangles_.push_back({t[2], t[0], last});
  }

  /// Flips the diagonal between a triangle and its neighbour at one edge, if the quadrilateral is
  /// convex.
  void turn_diagonal(std::size_t triangle, std::size_t edge) {
    cases::Triangle& first = triangles_[triangle];
    const std::uint32_t a = first[edge];
    const std::uint32_t b = first[(edge + 1) % 3];
    const std::uint32_t c = first[(edge + 2) % 3];
    for (cases::Triangle& second : triangles_) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (second[i] != b || second[(i + 1) % 3] != a) continue;
        const std::uint32_t d = second[(i + 2) % 3];
        if (area(points_[a], points_[d], points_[c]) <= 0) return;
        if (area(points_[d], points_[b], points_[c]) <= 0) return;
        first = {a, d, c};
        second = {d, b, c};
        return;
      }
    }
  }

 private:
  std::vector<LatticePoint> points_;
  std::vector<cases::Triangle> triangles_;
};

/// Fills the screen and a border around it with triangles of any shape.
void add_triangulation(Draw& draw, cases::Case& c) {
  const int border = draw.between(1, 3);
  const int far = draw.one_in(4) ? 4000 : border;
  Triangulation made(
      {-far * kSubpixels, -far * kSubpixels},
      {(c.framebuffer.width + far) * kSubpixels, (c.framebuffer.height + far) * kSubpixels});
  const int points = draw.between(2, 6 + draw.size() / 8);
  const bool is_at_samples = draw.one_in(2);
  for (int i = 0; i < points; ++i) {
    const WindowPoint p = is_at_samples ? visible_sample(draw, c) : visible_point(draw, c);
    made.insert(grid_point(p));
    const int triangles = static_cast<int>(made.triangles().size());
    const int triangle = draw.between(0, triangles - 1);
    const int edge = draw.between(0, 2);
    made.turn_diagonal(static_cast<std::size_t>(triangle), static_cast<std::size_t>(edge));
  }
  const VertexMaker vertices(draw, c);
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (const LatticePoint& p : made.points()) vertices.add(draw, c, window_point(p));
  const bool is_mirrored = draw.one_in(2);
  for (const cases::Triangle& t : made.triangles()) {
    const std::size_t second = is_mirrored ? 2 : 1;
    add_turned(draw, c, {first + t[0], first + t[second], first + t[3 - second]});
  }
}

/// Adds a fan with a square rim around a hub on or off the screen. Many triangles meet at the hub,
/// and most of them are narrow.
void add_fan(Draw& draw, cases::Case& c) {
  WindowPoint hub = visible_sample(draw, c);
  const bool is_off_screen = draw.one_in(3);
  const double size = std::max(c.framebuffer.width, c.framebuffer.height);
  if (is_off_screen) hub.u += draw.one_in(2) ? size : -size;
  const double radius =
      is_off_screen ? 3 * size : draw.pick(std::array{2.0, 6.0, 16.0, 64.0, 4096.0, 65536.0});
  const int per_side = draw.between(2, 4 + draw.size() / 10);
  const VertexMaker vertices(draw, c);
  const std::uint32_t centre = vertices.add(draw, c, hub);
  constexpr std::array kCorners{WindowPoint{-1, -1}, WindowPoint{1, -1}, WindowPoint{1, 1},
                                WindowPoint{-1, 1}};
  for (std::size_t side = 0; side < 4; ++side) {
    const WindowPoint& from = kCorners[side];
    const WindowPoint& to = kCorners[(side + 1) % 4];
    for (int i = 0; i < per_side; ++i) {
      const double t = static_cast<double>(i) / per_side;
      vertices.add(draw, c,
                   WindowPoint{hub.u + radius * (from.u + t * (to.u - from.u)),
                               hub.v + radius * (from.v + t * (to.v - from.v))});
    }
  }
  const auto rim = static_cast<std::uint32_t>(4 * per_side);
  for (std::uint32_t i = 0; i < rim; ++i) {
    add_turned(draw, c, {centre, centre + 1 + i, centre + 1 + (i + 1) % rim});
  }
}

/// Adds a strip that bends, with two vertices at each step, one on either side of a path.
void add_strip(Draw& draw, cases::Case& c) {
  const VertexMaker vertices(draw, c);
  WindowPoint at = visible_point(draw, c);
  const double half_width = double{draw.uniform(0.25F, 4)};
  const double step = double{draw.uniform(0.5F, 6)};
  const int steps = draw.between(2, 5 + draw.size() / 12);
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  WindowPoint along{1, double{draw.uniform(-1, 1)}};
  for (int i = 0; i < steps; ++i) {
    vertices.add(draw, c, {at.u - half_width * along.v, at.v + half_width * along.u});
    vertices.add(draw, c, {at.u + half_width * along.v, at.v - half_width * along.u});
    at = {at.u + step * along.u, at.v + step * along.v};
    const double bend = double{draw.uniform(-0.5F, 0.5F)};
    along = {along.u - bend * along.v, along.v + bend * along.u};
  }
  const auto last = static_cast<std::uint32_t>(c.positions.size());
  for (std::uint32_t i = first; i + 2 < last; ++i) {
    const bool is_odd = (i - first) % 2 != 0;
    c.triangles.push_back({is_odd ? i + 1 : i, is_odd ? i : i + 1, i + 2});
  }
}

/// Adds an edge with vertices exactly on it, with one triangle on one side and two or more on the
/// other, so that the two sides compute the edge's line from different end points.
void add_t_junction(Draw& draw, cases::Case& c) {
  const LatticePoint from = grid_point(visible_sample(draw, c));
  const int parts = draw.between(2, 4);
  const int most = kSubpixels * draw.between(1, 12);
  const int step_u = draw.between(-most, most);
  const int step_v = draw.between(-most, most);
  const auto joint = [&](int i) { return LatticePoint{from.u + i * step_u, from.v + i * step_v}; };
  // The corners that are not on the edge, one on either side.
  const int height = draw.between(1, 4);
  const int shift = draw.between(-1, 1);
  const LatticePoint apex{from.u + shift * step_u - height * step_v,
                          from.v + shift * step_v + height * step_u};
  const LatticePoint other{from.u + shift * step_u + height * step_v,
                           from.v + shift * step_v - height * step_u};
  const float w = draw.pick(std::array{1.0F, 0.5F, 4.0F});
  const float depth = random_depth(draw, c);
  const auto add = [&](const LatticePoint& p) {
    return add_vertex(c, at_window(c, window_point(p), depth, w));
  };
  const std::uint32_t above = add(apex);
  const std::uint32_t below = add(other);
  const std::uint32_t first = add(joint(0));
  for (int i = 1; i <= parts; ++i) add(joint(i));
  const auto count = static_cast<std::uint32_t>(parts);
  add_turned(draw, c, {first, first + count, above});
  for (std::uint32_t i = 0; i < count; ++i) add_turned(draw, c, {first + i + 1, first + i, below});
}

enum class MeshKind { triangulation, fan, strips, t_junctions };

cases::Case make(Draw& draw) {
  const auto kind = draw.pick(std::array{MeshKind::triangulation, MeshKind::triangulation,
                                         MeshKind::fan, MeshKind::strips, MeshKind::t_junctions});
  StateRequest request;
  request.least_side = 12;
  request.most_side = 32;
  // Off the grid, a vertex within an edge would not lie exactly on its line.
  request.is_on_grid = kind == MeshKind::t_junctions || draw.one_in(2);
  cases::Case c = random_state(draw, request);
  const int shapes = draw.between(2, 4 + draw.size() / 25);
  switch (kind) {
    case MeshKind::triangulation:
      add_triangulation(draw, c);
      break;
    case MeshKind::fan:
      add_fan(draw, c);
      break;
    case MeshKind::strips:
      for (int i = 0; i < shapes; ++i) add_strip(draw, c);
      break;
    case MeshKind::t_junctions:
      for (int i = 0; i < shapes; ++i) add_t_junction(draw, c);
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"meshes", "triangulations of the whole screen, dense fans, strips, vertices within edges",
     &make});

}  // namespace
}  // namespace rastercheck::properties::meshes_generator
