// The generators whose cases depend on the last bit reach their aims: cases of `hairline` need
// decisions that doubles cannot make, and cases of `snap-ties` need ties of rounding to a grid. The
// exact oracle counts both.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "cases/sample_pattern.h"
#include "properties/generators/internal/exact_splits.h"
#include "properties/random_state.h"
#include "tests/properties/generators/generator_cases.h"

namespace rastercheck::properties::close_generators_test {
namespace {

using cases::Case;
using cases::ClipVertex;

// --- hairline ------------------------------------------------------------------------------------

/// The weights of a triangle's vertices at a place of the window, computed in double.
struct RoughWeights {
  std::array<double, 3> e{};
  std::array<double, 3> size{};  ///< sum of the magnitudes of e's terms

  RoughWeights(const Corners& p, const Ray& q) {
    for (std::size_t i = 0; i < 3; ++i) {
      const ClipVertex& a = p[(i + 1) % 3];
      const ClipVertex& b = p[(i + 2) % 3];
      const std::array products{
          double{a.y} * double{b.w} * q.x, -double{a.w} * double{b.y} * q.x,
          double{a.w} * double{b.x} * q.y, -double{a.x} * double{b.w} * q.y,
          double{a.x} * double{b.y} * q.w, -double{a.y} * double{b.x} * q.w,
      };
      for (const double product : products) {
        e[i] += product;
        size[i] += std::abs(product);
      }
    }
  }

  /// True if an edge passes too close to decide in double arithmetic. has_close_plane() does the
  /// same for the plane of the distances g.
  bool has_close_edge() const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(e[i]) <= 0x1p-44 * size[i]) return true;
    }
    return false;
  }
  bool has_close_plane(const std::array<double, 3>& g) const {
    double sum = 0;
    double all = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += g[i] * e[i];
      all += std::abs(g[i]) * size[i];
    }
    return all > 0 && std::abs(sum) <= 0x1p-44 * all;
  }
};

bool has_close_clip_plane(const Case& c, const cases::Triangle& triangle,
                          const RoughWeights& weights) {
  std::array<double, 3> near{};
  std::array<double, 3> far{};
  std::array<double, 3> user{};
  for (std::size_t i = 0; i < 3; ++i) {
    const ClipVertex& p = c.positions[triangle[i]];
    near[i] = double{p.z} - double{near_depth(c)} * double{p.w};
    far[i] = double{p.w} - double{p.z};
    if (c.clip_distance_count > 0) user[i] = c.clip_distances_of(triangle[i])[0];
  }
  return weights.has_close_plane(user) ||
         (!c.depth_clamp && (weights.has_close_plane(near) || weights.has_close_plane(far)));
}

/// Counts of samples that lie on a boundary (on_…), and of samples that are within 2^-36 pixels of
/// one but certainly on one side (by_…): for edges and for clip planes.
struct Close {
  int on_edges = 0;
  int by_edges = 0;
  int on_planes = 0;
  int by_planes = 0;
};

Close close_samples(const Case& c) {
  Close close;
  const oracle::SceneTruth scene(c, exact_contract(c));
  const auto pattern = cases::standard_pattern(c.framebuffer.samples);
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    const oracle::TriangleTruth truth(scene, t);
    const oracle::PixelBox pixels = truth.pixels();
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        for (int s = 0; s < c.framebuffer.samples; ++s) {
          const auto at = pattern[static_cast<std::size_t>(s)];
          const Ray q = ray_through(c, {x + at.x / 16.0, y + at.y / 16.0});
          const RoughWeights weights(corners_of(c, c.triangles[t]), q);
          const bool is_edge = weights.has_close_edge();
          if (!is_edge && !has_close_clip_plane(c, c.triangles[t], weights)) continue;
          const auto distance = truth.distance(x, y, s);
          if (!distance) continue;
          const bool is_on = distance->lo == 0 && distance->hi == 0;
          const bool is_by = !is_on && -0x1p-36 < distance->lo && distance->hi < 0x1p-36 &&
                             (distance->lo > 0 || distance->hi < 0);
          (is_edge ? close.on_edges : close.on_planes) += is_on ? 1 : 0;
          (is_edge ? close.by_edges : close.by_planes) += is_by ? 1 : 0;
        }
      }
    }
  }
  return close;
}

TEST(Hairline, HasSamplesOnBoundariesAndBesideThem) {
  Close cases_with;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Close close = close_samples(make_case("hairline", i));
    cases_with.on_edges += close.on_edges > 0 ? 1 : 0;
    cases_with.by_edges += close.by_edges > 0 ? 1 : 0;
    cases_with.on_planes += close.on_planes > 0 ? 1 : 0;
    cases_with.by_planes += close.by_planes > 0 ? 1 : 0;
  }
  EXPECT_GT(cases_with.on_edges, 70);
  EXPECT_GT(cases_with.by_edges, 50);
  EXPECT_GT(cases_with.on_planes, 45);
  EXPECT_GT(cases_with.by_planes, 15);
}

/// The number of cases among 200 that have a triangle for which `question` is true.
int count(std::string_view generator,
          const std::function<bool(const Case&, const cases::Triangle&)>& question) {
  return count_cases(generator, [&](const Case& c) {
    return std::any_of(c.triangles.begin(), c.triangles.end(),
                       [&](const cases::Triangle& t) { return question(c, t); });
  });
}

TEST(Hairline, HasEdgesThatNoDoubleHolds) {
  // p q − r t for floats, whose products are exact in double.
  const auto needs_a_tail = [](float p, float q, float r, float t) {
    const double a = double{p} * double{q};
    const double b = -double{r} * double{t};
    const double sum = a + b;
    const double shadow = sum - a;
    return (a - (sum - shadow)) + (b - shadow) != 0;
  };
  EXPECT_GT(count("hairline",
                  [&](const Case& c, const cases::Triangle& triangle) {
                    const Corners p = corners_of(c, triangle);
                    return needs_a_tail(p[0].x, p[1].w, p[0].w, p[1].x) ||
                           needs_a_tail(p[0].y, p[1].w, p[0].w, p[1].y) ||
                           needs_a_tail(p[0].x, p[1].y, p[0].y, p[1].x);
                  }),
            150);
}

TEST(Hairline, HasDeterminantsThatAreZeroOrNextToIt) {
  int zero = 0;
  int next_to_zero = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = make_case("hairline", i);
    const oracle::SceneTruth scene(c, exact_contract(c));
    bool has_zero = false;
    bool has_next = false;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      const Corners p = corners_of(c, c.triangles[t]);
      // The determinant is the third weight, evaluated at the third corner.
      const RoughWeights weights(p, {p[2].x, p[2].y, p[2].w});
      if (std::abs(weights.e[2]) > 0x1p-48 * weights.size[2]) continue;
      const int orientation = oracle::TriangleTruth(scene, t).orientation();
      has_zero = has_zero || orientation == 0;
      has_next = has_next || orientation != 0;
    }
    zero += has_zero ? 1 : 0;
    next_to_zero += has_next ? 1 : 0;
  }
  EXPECT_GT(zero, 110);
  EXPECT_GT(next_to_zero, 100);
}

TEST(Hairline, HasPlanesOfOneDepthMidwayBetweenFloats) {
  const auto is_level_and_midway = [](const Case& c, const cases::Triangle& triangle) {
    const Corners p = corners_of(c, triangle);
    const auto is_equal = [](const ClipVertex& a, const ClipVertex& b) {
      return double{a.z} * double{b.w} == double{b.z} * double{a.w};
    };
    if (!is_equal(p[0], p[1]) || !is_equal(p[1], p[2])) return false;
    const double near = near_depth(c);
    const double t = (double{p[0].z} / double{p[0].w} - near) / (1 - near);
    const double n = c.viewport.min_depth;
    const double depth = n + (double{c.viewport.max_depth} - n) * t;
    const auto rounded = static_cast<float>(depth);
    const float other = stepped(rounded, double{rounded} < depth ? 1 : -1);
    return double{rounded} != depth && double{rounded} + double{other} == 2 * depth &&
           (p[0].w != p[1].w || p[1].w != p[2].w);
  };
  EXPECT_GT(count("hairline", is_level_and_midway), 100);
}

/// True if the triangle draws a sample of a pixel at whose centre Σ E_i is positive but less than
/// 2^-20 of the sum of its terms' magnitudes.
bool draws_beside_horizon(const Case& c, const cases::Triangle& triangle,
                          const oracle::TriangleTruth& truth) {
  const oracle::PixelBox pixels = truth.pixels();
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const RoughWeights weights(corners_of(c, triangle), ray_through(c, {x + 0.5, y + 0.5}));
      const double sum = weights.e[0] + weights.e[1] + weights.e[2];
      const double size = weights.size[0] + weights.size[1] + weights.size[2];
      if (std::abs(sum) > 0x1p-20 * size) continue;
      for (int s = 0; s < c.framebuffer.samples; ++s) {
        if (truth.judge(x, y, s).verdict == records::Verdict::required &&
            truth.attribute(0, x, y, s).has_value()) {
          return true;
        }
      }
    }
  }
  return false;
}

TEST(Hairline, HasCentresNextToTheHorizon) {
  int cases_with = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = make_case("hairline", i);
    if (c.framebuffer.samples == 1 || c.attributes.empty() ||
        c.attributes[0].location != cases::Location::center ||
        c.attributes[0].interpolation != cases::Interpolation::smooth) {
      continue;
    }
    const oracle::SceneTruth scene(c, exact_contract(c));
    bool has_one = false;
    for (std::size_t t = 0; t < c.triangles.size() && !has_one; ++t) {
      has_one = draws_beside_horizon(c, c.triangles[t], oracle::TriangleTruth(scene, t));
    }
    cases_with += has_one ? 1 : 0;
  }
  EXPECT_GT(cases_with, 50);
}

// --- near-misses ---------------------------------------------------------------------------------

/// Counts cases with a drawn triangle whose determinant is too close to 0 for its sign to be
/// certain in low precision, and cases with a sample close to an edge of a triangle that is not so
/// thin.
TEST(NearMisses, AreDrawnByDeterminantsAndEdgesThatADoubleCannotTell) {
  int thin = 0;
  int edges = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = make_case("near-misses", i);
    const auto pattern = cases::standard_pattern(c.framebuffer.samples);
    const oracle::SceneTruth scene(c, exact_contract(c));
    bool has_thin = false;
    bool has_edge = false;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      const Corners p = corners_of(c, c.triangles[t]);
      const RoughWeights whole(p, {p[2].x, p[2].y, p[2].w});
      const bool is_thin = std::abs(whole.e[2]) <= 0x1p-20 * whole.size[2];
      const oracle::TriangleTruth truth(scene, t);
      const oracle::PixelBox pixels = truth.pixels();
      for (int y = pixels.y0; y < pixels.y1; ++y) {
        for (int x = pixels.x0; x < pixels.x1; ++x) {
          for (int s = 0; s < c.framebuffer.samples; ++s) {
            if (truth.judge(x, y, s).verdict != records::Verdict::required) continue;
            const auto at = pattern[static_cast<std::size_t>(s)];
            const RoughWeights weights(p, ray_through(c, {x + at.x / 16.0, y + at.y / 16.0}));
            has_thin = has_thin || is_thin;
            has_edge = has_edge || (!is_thin && weights.has_close_edge());
          }
        }
      }
    }
    thin += has_thin ? 1 : 0;
    edges += has_edge ? 1 : 0;
  }
  RecordProperty("thin", thin);
  RecordProperty("edges", edges);
  EXPECT_GT(thin, 100);
  EXPECT_GT(edges, 17);
}

// --- snap-ties -----------------------------------------------------------------------------------

/// Window coordinates in grid units, for w > 0; exact if the coordinates have few bits.
std::array<double, 2> grid_units(const Case& c, const ClipVertex& p) {
  const double grid = power_of_two(c.coverage->subpixel_bits);
  const auto pixels = window(c, p);
  return {pixels[0] * grid, pixels[1] * grid};
}

bool is_midway(double units) { return units - std::floor(units) == 0.5; }

TEST(SnapTies, AreAlwaysSnapped) {
  std::array<int, cases::kMaxSubpixelBits + 1> bits{};
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case c = make_case("snap-ties", i);
    ASSERT_TRUE(c.coverage.has_value());
    EXPECT_EQ(c.coverage->rounding, cases::Rounding::nearest_even);
    EXPECT_EQ(c.coverage->position_error, 0);
    ++bits[static_cast<std::size_t>(c.coverage->subpixel_bits)];
  }
  for (std::size_t b = 4; b < bits.size(); ++b) EXPECT_GT(bits[b], 10) << b;
}

/// True if a coordinate of the vertex is midway between two grid points.
bool is_tie(const Case& c, const ClipVertex& p) {
  const auto units = grid_units(c, p);
  return is_midway(units[0]) || is_midway(units[1]);
}

/// True if a coordinate that is not midway becomes so when moved by one float.
bool is_beside_tie(const Case& c, const ClipVertex& p) {
  for (const int step : {-1, 1}) {
    const std::array moved{ClipVertex{stepped(p.x, step), p.y, p.z, p.w},
                           ClipVertex{p.x, stepped(p.y, step), p.z, p.w}};
    const auto before = grid_units(c, p);
    const auto in_x = grid_units(c, moved[0]);
    const auto in_y = grid_units(c, moved[1]);
    if (is_midway(in_x[0]) && !is_midway(before[0])) return true;
    if (is_midway(in_y[1]) && !is_midway(before[1])) return true;
  }
  return false;
}

TEST(SnapTies, HaveVerticesMidwayAndAFloatBeside) {
  int ties = 0;
  int beside = 0;
  int all = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = make_case("snap-ties", i);
    for (const ClipVertex& p : c.positions) {
      if (p.w <= 0) continue;
      ++all;
      ties += is_tie(c, p) ? 1 : 0;
      beside += is_beside_tie(c, p) ? 1 : 0;
    }
  }
  RecordProperty("vertices", all);
  RecordProperty("ties", ties);
  RecordProperty("beside", beside);
  EXPECT_GT(ties, all / 2);
  EXPECT_GT(beside, all / 10);
}

/// Twice the area of a triangle with w > 0, in grid units, exactly and with rounded corners.
struct Areas {
  double exact = 0;
  double snapped = 0;
};

std::optional<Areas> areas(const Case& c, const cases::Triangle& triangle) {
  std::array<std::array<double, 2>, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    if (c.positions[triangle[i]].w <= 0) return std::nullopt;
    p[i] = grid_units(c, c.positions[triangle[i]]);
  }
  const auto area = [](const auto& a, const auto& b, const auto& d) {
    return (b[0] - a[0]) * (d[1] - a[1]) - (d[0] - a[0]) * (b[1] - a[1]);
  };
  const auto rounded = [](const std::array<double, 2>& q) {
    return std::array{std::nearbyint(q[0]), std::nearbyint(q[1])};
  };
  return Areas{area(p[0], p[1], p[2]), area(rounded(p[0]), rounded(p[1]), rounded(p[2]))};
}

TEST(SnapTies, AreFlattenedAndTurnedByRounding) {
  EXPECT_GT(count("snap-ties",
                  [](const Case& c, const cases::Triangle& triangle) {
                    const auto both = areas(c, triangle);
                    return both && both->exact != 0 && both->snapped == 0;
                  }),
            30);
  EXPECT_GT(count("snap-ties",
                  [](const Case& c, const cases::Triangle& triangle) {
                    const auto both = areas(c, triangle);
                    return both && both->exact * both->snapped < 0;
                  }),
            30);
}

TEST(SnapTies, ReachTheGuardBandAndBeyondTheEye) {
  const auto has_vertex = [](const std::function<bool(const Case&, const ClipVertex&)>& question) {
    return count("snap-ties", [&](const Case& c, const cases::Triangle& triangle) {
      const Corners p = corners_of(c, triangle);
      return std::any_of(p.begin(), p.end(),
                         [&](const ClipVertex& vertex) { return question(c, vertex); });
    });
  };
  const auto farthest = [](const Case& c, const ClipVertex& p) {
    const auto units = grid_units(c, p);
    return std::max(std::abs(units[0]), std::abs(units[1])) /
           power_of_two(c.coverage->subpixel_bits);
  };
  EXPECT_GT(has_vertex([&](const Case& c, const ClipVertex& p) {
              return p.w > 0 && farthest(c, p) == 0x1p15;
            }),
            30);
  EXPECT_GT(has_vertex([&](const Case& c, const ClipVertex& p) {
              const double pixels = p.w > 0 ? farthest(c, p) : 0;
              return pixels != 0x1p15 && std::abs(pixels - 0x1p15) < 0x1p-6;
            }),
            5);
  EXPECT_GT(has_vertex([](const Case&, const ClipVertex& p) { return p.w <= 0; }), 50);
  EXPECT_GT(has_vertex([](const Case&, const ClipVertex& p) { return p.w > 0 && p.z > p.w; }), 20);
}

TEST(SnapTies, ShareVerticesInMeshes) {
  const auto is_mesh = [](const Case& c) { return c.positions.size() < 3 * c.triangles.size(); };
  EXPECT_GT(count_cases("snap-ties", is_mesh), 100);
}

}  // namespace
}  // namespace rastercheck::properties::close_generators_test
