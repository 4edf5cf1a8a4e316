#include "properties/laws/internal/triangulations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::Triangle;

/// How vertices get their w.
enum class MeshWeights { equal, powers_of_two, free };

float random_weight(Draw& draw, MeshWeights weights) {
  if (weights == MeshWeights::equal) return 1;
  if (weights == MeshWeights::free) return draw.uniform(0.1F, 4);
  return draw.pick(std::array{0.25F, 0.5F, 1.0F, 2.0F, 4.0F});
}

/// A mesh with points in pixels.
struct PixelMesh {
  std::vector<WindowPoint> points;
  std::vector<Triangle> triangles;

  std::uint32_t add(const WindowPoint& p) {
    points.push_back(p);
    return static_cast<std::uint32_t>(points.size() - 1);
  }
};

/// A box from `low` to `high`, low < high.
struct PixelBounds {
  WindowPoint low;
  WindowPoint high;
};

/// The viewport, grown by 3 to 12 pixels on every side.
PixelBounds box_about_viewport(Draw& draw, const cases::Case& c) {
  const cases::Viewport& v = c.viewport;
  const double more = double{draw.uniform(3, 12)};
  const double x1 = double{v.x} + double{v.width};
  const double y1 = double{v.y} + double{v.height};
  return {{std::min(double{v.x}, x1) - more, std::min(double{v.y}, y1) - more},
          {std::max(double{v.x}, x1) + more, std::max(double{v.y}, y1) + more}};
}

/// Cuts each cell of a grid of points along a diagonal.
void add_cells(Draw& draw, PixelMesh& mesh, int columns, int rows) {
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto first = static_cast<std::uint32_t>(j) * stride + static_cast<std::uint32_t>(i);
      std::array<std::uint32_t, 4> cell{first, first + 1, first + stride + 1, first + stride};
      if (draw.one_in(2)) std::rotate(cell.begin(), cell.begin() + 1, cell.end());
      mesh.triangles.push_back({cell[0], cell[1], cell[2]});
      mesh.triangles.push_back({cell[0], cell[2], cell[3]});
    }
  }
}

/// A grid with points moved by at most a fifth of a cell, so that cells stay convex; points of the
/// outline move outwards.
PixelMesh jittered_grid(Draw& draw, const cases::Case& c) {
  PixelMesh mesh;
  const PixelBounds box = box_about_viewport(draw, c);
  const int most = 2 + draw.size() / 20;
  const int columns = draw.between(1, most);
  const int rows = draw.between(1, most);
  const double width = (box.high.u - box.low.u) / columns;
  const double height = (box.high.v - box.low.v) / rows;
  const auto moved = [&draw](int at, int last) {
    if (at == 0) return double{draw.uniform(-0.2F, 0)};
    return double{at == last ? draw.uniform(0, 0.2F) : draw.uniform(-0.2F, 0.2F)};
  };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double s = i + moved(i, columns);
      const double t = j + moved(j, rows);
      mesh.add({box.low.u + s * width, box.low.v + t * height});
    }
  }
  add_cells(draw, mesh, columns, rows);
  return mesh;
}

/// A grid with cells of whole pixels and its points on samples.
PixelMesh grid_on_samples(Draw& draw, const cases::Case& c) {
  PixelMesh mesh;
  const PixelBounds box = box_about_viewport(draw, c);
  const WindowPoint sample = visible_sample(draw, c);
  const auto cell_of = [&draw](double size) {
    const int least = std::max(3, static_cast<int>(size / 6));
    return draw.between(least, least + 6);
  };
  const int width = cell_of(box.high.u - box.low.u);
  const int height = cell_of(box.high.v - box.low.v);
  const int left = static_cast<int>(std::ceil((sample.u - box.low.u) / width));
  const int above = static_cast<int>(std::ceil((sample.v - box.low.v) / height));
  const int columns = left + static_cast<int>(std::ceil((box.high.u - sample.u) / width));
  const int rows = above + static_cast<int>(std::ceil((box.high.v - sample.v) / height));
  const bool is_moved = draw.one_in(2);
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const bool is_inner = i > 0 && i < columns && j > 0 && j < rows;
      int du = 0;
      int dv = 0;
      if (is_moved && is_inner) {
        du = draw.between(-width / 5, width / 5);
        dv = draw.between(-height / 5, height / 5);
      }
      mesh.add({sample.u + (i - left) * width + du, sample.v + (j - above) * height + dv});
    }
  }
  add_cells(draw, mesh, columns, rows);
  return mesh;
}

WindowPoint between(const WindowPoint& p, const WindowPoint& q, double share) {
  return {p.u + share * (q.u - p.u), p.v + share * (q.v - p.v)};
}

/// Cuts a triangle in three at a point inside.
void insert_point(Draw& draw, PixelMesh& mesh, std::size_t at) {
  const Triangle of = mesh.triangles[at];
  const double first = draw.between(1, 7) / 8.0;
  const double second = draw.between(1, 7) / 8.0;
  const WindowPoint on_edge = between(mesh.points[of[0]], mesh.points[of[1]], first);
  const std::uint32_t p = mesh.add(between(on_edge, mesh.points[of[2]], second));
  mesh.triangles[at] = {of[0], of[1], p};
  mesh.triangles.push_back({of[1], of[2], p});
  mesh.triangles.push_back({of[2], of[0], p});
}

/// Cuts an edge in two, and also each triangle beside the edge.
void split_edge(Draw& draw, PixelMesh& mesh, std::size_t at) {
  const int corner = draw.between(0, 2);
  const auto i = static_cast<std::size_t>(corner);
  const std::uint32_t from = mesh.triangles[at][i];
  const std::uint32_t to = mesh.triangles[at][(i + 1) % 3];
  const double share = draw.between(1, 7) / 8.0;
  const std::uint32_t p = mesh.add(between(mesh.points[from], mesh.points[to], share));
  const std::size_t count = mesh.triangles.size();
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle of = mesh.triangles[t];
      const std::uint32_t a = of[k];
      const std::uint32_t b = of[(k + 1) % 3];
      const bool is_edge = (a == from && b == to) || (a == to && b == from);
      if (!is_edge) continue;
      mesh.triangles[t] = {a, p, of[(k + 2) % 3]};
      mesh.triangles.push_back({p, b, of[(k + 2) % 3]});
      break;
    }
  }
}

PixelMesh inserted_points(Draw& draw, const cases::Case& c) {
  PixelMesh mesh;
  const PixelBounds box = box_about_viewport(draw, c);
  mesh.add(box.low);
  mesh.add({box.high.u, box.low.v});
  mesh.add(box.high);
  mesh.add({box.low.u, box.high.v});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const int points = draw.between(1, 4 + draw.size() / 5);
  for (int i = 0; i < points; ++i) {
    const int at = draw.between(0, static_cast<int>(mesh.triangles.size()) - 1);
    if (draw.one_in(2)) {
      insert_point(draw, mesh, static_cast<std::size_t>(at));
    } else {
      split_edge(draw, mesh, static_cast<std::size_t>(at));
    }
  }
  return mesh;
}

/// x, y, −x or −y of a vertex, depending on `which`.
float coordinate(const cases::ClipVertex& p, int which) {
  const float n = which % 2 == 0 ? p.x : p.y;
  return which < 2 ? n : -n;
}

/// Sometimes sets clip distances that keep everything or half of the screen, or depths that keep
/// half of it.
void add_planes(Draw& draw, cases::Case& c) {
  const int kind = draw.between(0, 7);
  const int which = draw.between(0, 3);
  if (kind == 0 && !c.coverage) {
    for (cases::ClipVertex& p : c.positions) p.z = coordinate(p, which);
  }
  if (kind == 1 || (kind == 2 && !c.coverage)) {
    c.clip_distance_count = 1;
    for (const cases::ClipVertex& p : c.positions) {
      c.clip_distances.push_back(kind == 1 ? draw.uniform(0.125F, 1) : coordinate(p, which));
    }
  }
}

}  // namespace

Generated triangulated_screen(Draw& draw) {
  Generated made;
  const bool is_on_grid = draw.one_in(2);
  StateRequest request;
  request.is_on_grid = is_on_grid;
  request.has_clip_distances = false;
  request.most_side = 32;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  c.depth_test = cases::DepthTest::none;
  c.cull = cases::Cull::none;
  MeshWeights weights =
      draw.pick(std::array{MeshWeights::equal, MeshWeights::free, MeshWeights::free});
  PixelMesh mesh;
  if (is_on_grid) {
    made.stratum = "grid on samples";
    weights = draw.pick(std::array{MeshWeights::equal, MeshWeights::powers_of_two});
    mesh = grid_on_samples(draw, c);
  } else if (draw.one_in(2)) {
    made.stratum = "jittered grid";
    mesh = jittered_grid(draw, c);
  } else {
    made.stratum = "inserted points";
    mesh = inserted_points(draw, c);
  }
  for (const WindowPoint& p : mesh.points) {
    const float depth = draw.uniform(0.0625F, 0.9375F);
    const float w = random_weight(draw, weights);
    add_vertex(c, at_window(c, p, depth, w));
  }
  const bool is_mirrored = draw.one_in(2);
  for (Triangle triangle : mesh.triangles) {
    if (is_mirrored) std::swap(triangle[0], triangle[1]);
    const int turns = draw.between(0, 2);
    std::rotate(triangle.begin(), triangle.begin() + turns, triangle.end());
    c.triangles.push_back(triangle);
  }
  add_planes(draw, c);
  add_attribute_values(draw, c);
  return made;
}

}  // namespace rastercheck::properties
