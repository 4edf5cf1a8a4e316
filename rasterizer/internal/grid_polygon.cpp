#include "rasterizer/internal/grid_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace rastercheck::rasterizer {
namespace {

using Distances = std::array<std::span<const float>, 3>;

/// A clip plane, given by its exact values at the vertices.
struct ClipPlane {
  std::array<ExactSum, 3> g;
  bool has_vertex_beyond() const {
    return std::any_of(g.begin(), g.end(), [](const ExactSum& value) { return value.sign() < 0; });
  }
};

/// Adds factor · a · b.
void add_product(ExactSum& sum, const ExactSum& a, const ExactSum& b, double factor = 1) {
  for (const double x : a.components()) {
    for (const double y : b.components()) sum.add_product(x, factor * y);
  }
}

/// A line of clip space: 0…2 is the edge opposite the vertex with that index; kFirstPlane + p is
/// clip plane p.
using LineIndex = std::size_t;
constexpr LineIndex kFirstPlane = 3;

/// A corner of the polygon, and the line along which the polygon continues from it.
struct Corner {
  std::array<ExactSum, 3> weights;  ///< β; none is negative
  LineIndex next_line = 0;
};

class Clipping {
 public:
  Clipping(const State& state, const Grid& grid, const std::array<glm::vec4, 3>& positions,
           const Distances& distances)
      : grid_(grid), positions_(positions) {
    set_order(distances);
    add_planes(state, distances);
  }

  std::vector<Corner> polygon() const {
    std::vector<Corner> corners(3);
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i].weights[i].add(1);
      corners[i].next_line = (i + 2) % 3;  // the edge opposite vertex i + 2
    }
    for (std::size_t p = 0; p < planes_.size() && !corners.empty(); ++p) corners = cut(corners, p);
    return corners;
  }

  GridCorner on_grid(const Corner& corner, glm::dvec2& window) const {
    GridCorner result;
    ExactSum sum;
    ExactSum x;
    ExactSum y;
    ExactSum w;
    ExactSum z;
    for (const std::size_t i : order_) {
      const glm::vec4& p = positions_[i];
      for (const double weight : corner.weights[i].components()) {
        sum.add(weight);
        add_window_numerator(x, grid_.x, p.x, p.w, weight);
        add_window_numerator(y, grid_.y, p.y, p.w, weight);
        w.add_product(weight, p.w);
        z.add_product(weight, p.z);
      }
    }
    const double whole = sum.nearest();
    const double depth = w.nearest();
    if (!(depth > 0)) return result;
    const glm::dvec2 twice_window{x.nearest() / depth, y.nearest() / depth};
    window = twice_window / 2.0;
    result.at = {rounded_point(twice_window.x), rounded_point(twice_window.y)};
    result.w = depth / whole;
    result.z = z.nearest() / whole;
    for (std::size_t i = 0; i < 3; ++i) {
      ExactSum weight = corner.weights[i];
      result.share[i] = weight.nearest() / whole;
    }
    return result;
  }

 private:
  void set_order(const Distances& distances) {
    std::sort(order_.begin(), order_.end(), [&](std::size_t i, std::size_t j) {
      const auto key = [this](std::size_t k) {
        const glm::vec4& p = positions_[k];
        return std::tuple(p.x, p.y, p.z, p.w);
      };
      if (key(i) != key(j)) return key(i) < key(j);
      return std::lexicographical_compare(distances[i].begin(), distances[i].end(),
                                          distances[j].begin(), distances[j].end());
    });
  }

  template <typename Value>
  void add_plane(const Value& value_at) {
    ClipPlane plane;
    for (std::size_t i = 0; i < 3; ++i) value_at(plane.g[i], i);
    if (plane.has_vertex_beyond()) planes_.push_back(plane);
  }

  void add_planes(const State& state, const Distances& distances) {
    if (!state.depth_clamp) {
      const double near = state.convention == Convention::opengl ? 1 : 0;
      add_plane([&](ExactSum& g, std::size_t i) {
        g.add(positions_[i].z);
        g.add_product(near, positions_[i].w);
      });
      add_plane([&](ExactSum& g, std::size_t i) {
        g.add(positions_[i].w);
        g.add(-double{positions_[i].z});
      });
    }
    for (std::size_t d = 0; d < state.clip_distance_count; ++d) {
      add_plane([&](ExactSum& g, std::size_t i) { g.add(distances[i][d]); });
    }
    for (const double side : {1.0, -1.0}) {
      const auto guard = [&](const GridAxis& axis, auto coordinate) {
        add_plane([&](ExactSum& g, std::size_t i) {
          const glm::vec4& p = positions_[i];
          g.add_product(2.0 * kGuardBand, p.w);
          add_window_numerator(g, axis, p.*coordinate, p.w, side);
        });
      };
      guard(grid_.x, &glm::vec4::x);
      guard(grid_.y, &glm::vec4::y);
    }
  }

  int side_of(const Corner& corner, std::size_t plane) const {
    ExactSum sum;
    for (std::size_t i = 0; i < 3; ++i) add_product(sum, corner.weights[i], planes_[plane].g[i]);
    return sum.sign();
  }

  /// Sutherland and Hodgman's step, on a convex polygon.
  std::vector<Corner> cut(const std::vector<Corner>& corners, std::size_t plane) const {
    std::vector<int> sides;
    sides.reserve(corners.size());
    for (const Corner& corner : corners) sides.push_back(side_of(corner, plane));
    const auto most = std::max_element(sides.begin(), sides.end());
    if (*most <= 0) return {};
    std::vector<Corner> kept;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int here = sides[k];
      const int next = sides[(k + 1) % corners.size()];
      if (here >= 0) kept.push_back(corners[k]);
      if (here >= 0 && next < 0) {
        if (here > 0) kept.push_back(crossing(corners[k].next_line, plane));
        kept.back().next_line = kFirstPlane + plane;
      } else if (here < 0 && next > 0) {
        kept.push_back(crossing(corners[k].next_line, plane));
      }
    }
    return kept;
  }

  /// The corner where a line meets a plane; the polygon continues along the line.
  Corner crossing(LineIndex line, std::size_t plane) const {
    const std::array<ExactSum, 3>& g = planes_[plane].g;
    Corner corner;
    corner.next_line = line;
    if (line < kFirstPlane) {
      // g has different signs at vertices j and k, so it is 0 where their weights are |g_k| and
      // |g_j|.
      const std::size_t j = (line + 1) % 3;
      const std::size_t k = (line + 2) % 3;
      corner.weights[j] = size_of(g[k]);
      corner.weights[k] = size_of(g[j]);
      return corner;
    }
    const std::array<ExactSum, 3>& h = planes_[line - kFirstPlane].g;
    ExactSum sum;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      add_product(corner.weights[i], h[j], g[k]);
      add_product(corner.weights[i], h[k], g[j], -1);
    }
    // Inside the triangle all three weights have the same sign.
    const bool is_negative = std::any_of(corner.weights.begin(), corner.weights.end(),
                                         [](const ExactSum& weight) { return weight.sign() < 0; });
    if (is_negative) {
      for (ExactSum& weight : corner.weights) weight = negated(weight);
    }
    return corner;
  }

  static ExactSum negated(const ExactSum& value) {
    ExactSum result;
    for (const double component : value.components()) result.add(-component);
    return result;
  }
  static ExactSum size_of(const ExactSum& value) {
    return value.sign() < 0 ? negated(value) : value;
  }

  /// The grid point that half of `twice_window` is rounded to.
  std::int64_t rounded_point(double twice_window) const {
    const auto& [bits, rounding] = grid_.snapping;
    const double position = std::ldexp(twice_window, bits - 1);
    const double below = std::floor(position);
    const double rest = position - below;
    auto point = static_cast<std::int64_t>(below);
    if (rounding == Rounding::floor) return point << (grid_.unit_bits - bits);
    if (rest == 0.5) {
      point = tie_point(rounding, point);
    } else if (rest > 0.5) {
      ++point;
    }
    return point << (grid_.unit_bits - bits);
  }

  const Grid& grid_;
  const std::array<glm::vec4, 3>& positions_;
  /// The vertices in a canonical order, independent of the triangle they belong to.
  std::array<std::size_t, 3> order_{0, 1, 2};
  std::vector<ClipPlane> planes_;
};

bool is_inside_depth_planes(const State& state, const glm::vec4& p) {
  const float near = state.convention == Convention::opengl ? -p.w : 0.0F;
  return state.depth_clamp || (p.z >= near && p.z <= p.w);
}

bool is_clipped(const State& state, const Grid& grid, const glm::vec4& position,
                std::span<const float> distances) {
  return !is_within_guard_band(grid, position) || !is_inside_depth_planes(state, position) ||
         std::any_of(distances.begin(), distances.end(), [](float d) { return d < 0; });
}

}  // namespace

void grid_polygon(const State& state, const Grid& grid, const std::array<glm::vec4, 3>& positions,
                  const Distances& distances, GridPolygon& out) {
  out.corners.clear();
  out.is_cut = false;
  for (std::size_t i = 0; i < 3; ++i) {
    out.is_cut = out.is_cut || is_clipped(state, grid, positions[i], distances[i]);
  }
  if (!out.is_cut) {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec4& p = positions[i];
      GridCorner corner{snapped(grid, p), p.w, p.z, {}, false};
      corner.share[i] = 1;
      out.corners.push_back(corner);
    }
    return;
  }
  const Clipping clipping(state, grid, positions, distances);
  out.window.clear();
  for (const Corner& corner : clipping.polygon()) {
    const bool is_vertex = std::count_if(corner.weights.begin(), corner.weights.end(),
                                         [](const ExactSum& w) { return w.sign() != 0; }) == 1;
    GridCorner on_grid = clipping.on_grid(corner, out.window.emplace_back());
    on_grid.is_new = !is_vertex;
    if (is_vertex && on_grid.w > 0) {  // else the vertex is at the eye
      for (std::size_t i = 0; i < 3; ++i) {
        if (corner.weights[i].sign() == 0) continue;
        on_grid = {snapped(grid, positions[i]), positions[i].w, positions[i].z, {}, false};
        on_grid.share[i] = 1;
      }
    }
    out.corners.push_back(on_grid);
  }
  const bool meets_eye = std::any_of(out.corners.begin(), out.corners.end(),
                                     [](const GridCorner& corner) { return corner.w <= 0; });
  if (meets_eye) out.corners.clear();
}

}  // namespace rastercheck::rasterizer
