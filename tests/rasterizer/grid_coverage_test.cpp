// Snapped coverage, compared with its definition: the half-planes of the rounded vertices, in
// integers of any size. Also what neighbouring triangles must share where clip planes cut them.

#include "rasterizer/internal/grid_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/grid_polygon.h"
#include "tests/rasterizer/exact.h"
#include "tests/rasterizer/random_draw.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::grid_coverage_test {
namespace {

constexpr std::array<std::span<const float>, 3> kNoDistances{};

using Corners = std::array<glm::vec4, 3>;

/// A triangle as half-planes a x + b y + c > 0 in grid units, or >= 0 for an edge whose samples the
/// fill rule keeps. Made once per triangle, because each number costs an allocation, which is slow
/// under a sanitizer.
class HalfPlanes {
 public:
  HalfPlanes(const std::array<GridPoint, 3>& p, int tie_sign) {
    const int turn = sgn(Line(p[0], p[1], 1).at(p[2]));
    if (turn == 0) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPoint& a = p[i];
      const GridPoint& b = p[(i + 1) % 3];
      const int normal_x = turn * (a.y > b.y ? 1 : a.y < b.y ? -1 : 0);
      const int normal_y = turn * (b.x > a.x ? 1 : b.x < a.x ? -1 : 0);
      const bool keeps_ties = normal_x > 0 || (normal_x == 0 && tie_sign * normal_y > 0);
      planes_.push_back({Line(a, b, turn), keeps_ties});
    }
  }

  bool contain(const GridPoint& sample) const {
    for (const Plane& plane : planes_) {
      const int side = sgn(plane.line.at(sample));
      if (side < 0 || (side == 0 && !plane.keeps_ties)) return false;
    }
    return !planes_.empty();
  }

 private:
  struct Line {
    Line(const GridPoint& from, const GridPoint& to, int turn)
        : a((mpz_class(from.y) - to.y) * turn),
          b((mpz_class(to.x) - from.x) * turn),
          c(-a * from.x - b * from.y) {}
    mpz_class at(const GridPoint& p) const { return a * p.x + b * p.y + c; }
    mpz_class a, b, c;
  };
  struct Plane {
    Line line;
    bool keeps_ties = false;
  };
  std::vector<Plane> planes_;  // none if the triangle has no area
};

/// A corner on the grid or off it, near the window or far from it.
glm::vec4 random_vertex(Random& random, const State& state) {
  const float w = random.pick({1.0F, 3.0F, 0.7F, 0x1p-100F});
  switch (random.between(0, 3)) {
    case 0:
      return at(state, static_cast<float>(random.between(-4, 36)) / 2,
                static_cast<float>(random.between(-4, 36)) / 2, w);
    case 1:
      return at(state, random.real(0, 5), random.real(0, 5), w);
    case 2:
      return at(state, 8 + random.real(-9, -2), 8 + random.real(-9, -2), w);
    default:
      return at(state, random.real(10, 14), random.real(10, 14), w);
  }
}

Snapping random_snapping(Random& random) {
  return {random.pick({0, 2, 4, 4, 8, 16}),
          random.pick({Rounding::nearest_even, Rounding::half_up})};
}

// Kills: an inverted tie of the fill rule; a crossing rounded down; an integer that overflows.
TEST(GridCoverage, IsThatOfTheRoundedVertices) {
  Random random(3);
  std::size_t covered = 0;
  for (int i = 0; i < 3'000; ++i) {
    State state = small_state(16, 16, random.pick({Convention::opengl, Convention::d3d}));
    state.snapping = random_snapping(random);
    state.fill_rule = random.pick({FillRule::top_left, FillRule::bottom_left});
    state.depth_clamp = true;
    const TargetSize size{16, 16, random.pick({1, 4, 16})};
    SmallMesh mesh;
    for (int v = 0; v < 3; ++v) mesh.positions.push_back(random_vertex(random, state));
    mesh.triangles = {{0, 1, 2}};
    const Grid grid = grid_of(state);
    std::array<GridPoint, 3> points;
    for (std::size_t v = 0; v < 3; ++v) {
      ASSERT_TRUE(is_within_guard_band(grid, mesh.positions[v]));
      points[v] = snapped(grid, mesh.positions[v]);
    }
    const std::vector<int> times = times_drawn(fragments_of(state, mesh, size), size);
    const bool points_up = state.convention == Convention::opengl;
    const int tie_sign = (state.fill_rule == FillRule::top_left) == points_up ? -1 : 1;
    const HalfPlanes triangle(points, tie_sign);
    std::size_t place = 0;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        for (const SampleOffset& offset : standard_pattern(size.samples)) {
          const int bits = unit_bits(*state.snapping);
          const GridPoint at = grid_sample(x, y, offset, bits);
          EXPECT_EQ(at.x, std::ldexp(x + offset.x, bits));
          const bool is_covered = triangle.contain(at);
          covered += is_covered ? 1 : 0;
          ASSERT_EQ(times[place], is_covered ? 1 : 0) << i << ": " << x << ", " << y;
          ++place;
        }
      }
    }
  }
  EXPECT_GT(covered, 100'000U);
}

/// A vertex with small integers as coordinates, so that sums of such vertices are exact in float.
/// It may be behind the eye, beyond the depth planes or far outside.
glm::vec4 whole_vertex(Random& random) {
  const int far = random.one_in(3) ? 30'000 : 12;
  return {random.between(-far, far), random.between(-far, far), random.between(-3, 6),
          random.between(-2, 6)};
}

State snapped_state(Random& random) {
  State state = small_state(32, 32, Convention::vulkan);
  state.snapping = random_snapping(random);
  return state;
}

/// The triangle if `is_whole`, otherwise the fan about `hub`, a point within the triangle that is a
/// sum of its vertices. Everything is linear, so that clip planes cut both alike.
SmallMesh fan_of(const Corners& p, const glm::vec4& hub, bool is_whole) {
  SmallMesh mesh;
  mesh.positions = {p[0], p[1], p[2], hub};
  if (is_whole) {
    mesh.triangles = {{0, 1, 2}};
  } else {
    mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  }
  return mesh;
}

// If only the guard band cuts, whose sides lie far outside, a fan covers each sample exactly as
// often as the triangle that it fills. Kills: new vertices that depend on the order of an edge's
// ends; edges that keep their exact line where they are cut.
TEST(GridCoverage, AFanAboutAPointCoversWhatItsTriangleDoes) {
  Random random(4);
  const TargetSize size{32, 32, 4};
  int cut = 0;
  std::size_t covered = 0;
  for (int i = 0; i < 4'000; ++i) {
    State state = snapped_state(random);
    // On a coarse grid the hub may be rounded out of its triangle.
    state.snapping->subpixel_bits = random.pick({4, 4, 8, 16});
    state.depth_clamp = true;
    Corners p;
    for (glm::vec4& q : p) q = whole_vertex(random);
    const glm::vec4 hub = p[0] * static_cast<float>(random.between(1, 4)) +
                          p[1] * static_cast<float>(random.between(1, 4)) +
                          p[2] * static_cast<float>(random.between(1, 4));
    GridPolygon polygon;
    grid_polygon(state, grid_of(state), p, kNoDistances, polygon);
    cut += polygon.is_cut && !polygon.corners.empty() ? 1 : 0;
    const std::vector<int> whole =
        times_drawn(fragments_of(state, fan_of(p, hub, true), size), size);
    const std::vector<int> fan =
        times_drawn(fragments_of(state, fan_of(p, hub, false), size), size);
    for (std::size_t s = 0; s < whole.size(); ++s) {
      covered += static_cast<std::size_t>(whole[s]);
      ASSERT_EQ(fan[s], whole[s]) << "draw " << i << ", sample " << s;
    }
  }
  EXPECT_GT(cut, 1'000);
  EXPECT_GT(covered, 100'000U);
}

/// The corners that lie on the edge opposite a vertex.
std::vector<GridPoint> corners_on_edge(const GridPolygon& polygon, std::size_t opposite) {
  std::vector<GridPoint> on_edge;
  for (const GridCorner& corner : polygon.corners) {
    if (corner.share[opposite] == 0) on_edge.push_back(corner.at);
  }
  return on_edge;
}

// Two triangles share an edge, and different planes cut them. Kills: corners computed from other
// new corners; an edge's ends taken in the triangle's order.
TEST(GridPolygon, NeighboursShareTheCornersOfTheirEdge) {
  Random random(5);
  int compared = 0;
  for (int i = 0; i < 30'000; ++i) {
    State state = snapped_state(random);
    state.depth_clamp = random.one_in(3);
    state.clip_distance_count = 1;
    const auto vertex = [&random] {
      return random.one_in(2) ? whole_vertex(random)
                              : glm::vec4{random.real(-3, 14), random.real(-3, 14),
                                          random.real(-3, 1), random.real(-3, 2)};
    };
    const glm::vec4 a = vertex();
    const glm::vec4 b = vertex();
    const std::array<float, 4> d{random.real(-2, 1), random.real(-2, 1), random.real(-2, 1),
                                 random.real(-2, 1)};
    const auto distance = [&d](std::size_t k) { return std::span<const float>(&d[k], 1); };
    GridPolygon left;
    GridPolygon right;
    const Grid grid = grid_of(state);
    grid_polygon(state, grid, {a, b, vertex()}, {distance(0), distance(1), distance(2)}, left);
    grid_polygon(state, grid, {vertex(), b, a}, {distance(3), distance(1), distance(0)}, right);
    if (left.corners.empty() || right.corners.empty()) continue;
    std::vector<GridPoint> of_left = corners_on_edge(left, 2);
    std::vector<GridPoint> of_right = corners_on_edge(right, 0);
    const auto before = [](const GridPoint& p, const GridPoint& q) {
      return p.x != q.x ? p.x < q.x : p.y < q.y;
    };
    std::sort(of_left.begin(), of_left.end(), before);
    std::sort(of_right.begin(), of_right.end(), before);
    ASSERT_EQ(of_left, of_right) << i;
    compared += left.is_cut && of_left.size() == 2 ? 1 : 0;
  }
  EXPECT_GT(compared, 3'000);
}

// Every corner of a cut polygon is where its shares put it, and lies beyond no plane.
TEST(GridPolygon, CornersLieWithinHalfAUnitOfTheClippedTriangle) {
  Random random(6);
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    State state = snapped_state(random);
    const Corners p{whole_vertex(random), whole_vertex(random), whole_vertex(random)};
    GridPolygon polygon;
    grid_polygon(state, grid_of(state), p, kNoDistances, polygon);
    for (const GridCorner& corner : polygon.corners) {
      glm::dvec4 q{0};
      for (std::size_t v = 0; v < 3; ++v) q += corner.share[v] * glm::dvec4(p[v]);
      const double unit = std::ldexp(1.0, state.snapping->subpixel_bits);
      const double of_point = std::ldexp(1.0, unit_bits(*state.snapping)) / unit;
      // Shares have a relative error below 2^-50, and the vertices' numbers are below 2^15. w is
      // seldom small, but may be.
      const double blur = 0x1p-30 / q.w;
      EXPECT_NEAR(corner.w, q.w, 0x1p-30);
      EXPECT_NEAR(corner.z, q.z, 0x1p-30);
      EXPECT_LE(-0x1p-30, q.z);
      EXPECT_LE(q.z, q.w + 0x1p-30);
      EXPECT_NEAR(static_cast<double>(corner.at.x) / of_point, (16 * q.x / q.w + 16) * unit,
                  0.5 + 0x1p-18 + 32 * blur * unit);
      EXPECT_NEAR(static_cast<double>(corner.at.y) / of_point, (16 * q.y / q.w + 16) * unit,
                  0.5 + 0x1p-18 + 32 * blur * unit);
      compared += polygon.is_cut ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 5'000);
}

}  // namespace
}  // namespace rastercheck::rasterizer::grid_coverage_test
