// The generators of whole drawings (meshes, grids, cameras), and of triangles that leave the view
// (clipping, guard-band), reach what their names say. The exact oracle decides what is drawn.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "properties/camera_cases.h"
#include "tests/properties/generators/generator_cases.h"

namespace rastercheck::properties::mesh_generators_test {
namespace {

using cases::Case;
using cases::ClipVertex;
using cases::Triangle;
using records::SampleVerdict;
using records::Verdict;

/// The longer side of the box around a triangle, in pixels.
double extent(const Case& c, const Triangle& triangle) {
  std::array<double, 2> lo{INFINITY, INFINITY};
  std::array<double, 2> hi{-INFINITY, -INFINITY};
  for (const std::uint32_t vertex : triangle) {
    const auto p = window(c, c.positions[vertex]);
    for (std::size_t k = 0; k < 2; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  return std::max(hi[0] - lo[0], hi[1] - lo[1]);
}

// --- meshes --------------------------------------------------------------------------------------

/// The case with nothing that hides its triangles: no culling, no depth clipping, no clip
/// distances, one sample.
Case bare(Case c) {
  c.cull = cases::Cull::none;
  c.scissor.reset();
  c.depth_clamp = true;
  c.clip_distances.clear();
  c.clip_distance_count = 0;
  c.attributes.clear();
  c.attribute_values.clear();
  c.framebuffer.samples = 1;
  return c;
}

/// How many triangles require each sample of the framebuffer.
std::vector<int> times_covered(const Case& c) {
  std::vector<int> times(static_cast<std::size_t>(c.framebuffer.width * c.framebuffer.height));
  const oracle::SceneTruth scene(c, exact_contract(c));
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    const oracle::TriangleTruth truth(scene, t);
    const oracle::PixelBox pixels = truth.pixels();
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        if (truth.judge(x, y, 0).verdict != Verdict::required) continue;
        ++times[static_cast<std::size_t>(y * c.framebuffer.width + x)];
      }
    }
  }
  return times;
}

/// True if the mesh covers every sample of the viewport inside the framebuffer exactly once.
bool covers_the_screen_once(const Case& made) {
  const Case c = bare(made);
  const cases::Viewport& viewport = c.viewport;
  const std::array across{viewport.x, viewport.x + viewport.width};
  const std::array down{viewport.y, viewport.y + viewport.height};
  const auto is_within = [](const std::array<float, 2>& range, double at) {
    return std::min(range[0], range[1]) < at && at < std::max(range[0], range[1]);
  };
  const std::vector<int> times = times_covered(c);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const int x = static_cast<int>(i) % c.framebuffer.width;
    const int y = static_cast<int>(i) / c.framebuffer.width;
    if (is_within(across, x + 0.5) && is_within(down, y + 0.5) && times[i] != 1) return false;
  }
  return true;
}

/// True if a vertex lies exactly on another triangle's edge, between the ends of the edge.
bool has_t_junction(const Case& made) {
  Case c = bare(made);
  std::vector<Triangle> joints;
  for (const Triangle& triangle : made.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i];
      const std::uint32_t b = triangle[(i + 1) % 3];
      const auto p = window(c, c.positions[a]);
      const auto q = window(c, c.positions[b]);
      for (std::uint32_t v = 0; v < c.positions.size(); ++v) {
        if (v == a || v == b) continue;
        const auto r = window(c, c.positions[v]);
        const double off = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        const double along = (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]);
        const double length = (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
        if (std::abs(off) < 1e-6 && 0 < along && along < length) joints.push_back({a, v, b});
      }
    }
  }
  c.triangles = joints;
  const oracle::SceneTruth scene(c, exact_contract(c));
  for (std::size_t t = 0; t < joints.size(); ++t) {
    if (oracle::TriangleTruth(scene, t).orientation() == 0) return true;
  }
  return false;
}

/// The largest number of triangles that meet at one vertex.
int most_at_a_vertex(const Case& c) {
  std::map<std::uint32_t, int> triangles;
  for (const Triangle& triangle : c.triangles) {
    for (const std::uint32_t vertex : triangle) ++triangles[vertex];
  }
  const auto most = std::max_element(triangles.begin(), triangles.end(),
                                     [](auto& a, auto& b) { return a.second < b.second; });
  return most->second;
}

TEST(Meshes, CoverTheScreenOnceAndHaveFansAndJunctions) {
  const int whole = count_cases("meshes", covers_the_screen_once);
  const int fans = count_cases("meshes", [](const Case& c) { return most_at_a_vertex(c) >= 12; });
  const int junctions = count_cases("meshes", has_t_junction);
  RecordProperty("whole", whole);
  RecordProperty("fans", fans);
  RecordProperty("junctions", junctions);
  EXPECT_GT(whole, 50);
  EXPECT_GT(fans, 20);
  EXPECT_GT(junctions, 15);
}

// --- grids ---------------------------------------------------------------------------------------

TEST(Grids, HaveFloorsUpToTheHorizonAndSquaresOfLessThanAPixel) {
  const auto has_far_row = [](const Case& c) {
    return draws(c, [&](const Triangle& triangle) {
      float least = INFINITY;
      float most = 0;
      for (const std::uint32_t v : triangle) {
        least = std::min(least, std::abs(c.positions[v].w));
        most = std::max(most, std::abs(c.positions[v].w));
      }
      return most >= 16 && least < most;
    });
  };
  const auto begins_behind = [](const Case& c) {
    return draws(c, [&](const Triangle& triangle) {
      return c.positions[triangle[0]].w < 0 && c.positions[triangle[2]].w > 0;
    });
  };
  const auto has_squares = [](const Case& c) {
    return draws(c, [&](const Triangle& triangle) {
      return std::all_of(triangle.begin(), triangle.end(),
                         [&](std::uint32_t v) { return c.positions[v].w > 0; }) &&
             extent(c, triangle) < 0.5;
    });
  };
  const int far = count_cases("grids", has_far_row);
  const int behind = count_cases("grids", begins_behind);
  const int squares = count_cases("grids", has_squares);
  RecordProperty("far", far);
  RecordProperty("behind", behind);
  RecordProperty("squares", squares);
  EXPECT_GT(far, 20);
  EXPECT_GT(behind, 15);
  EXPECT_GT(squares, 20);
}

// --- cameras -------------------------------------------------------------------------------------

TEST(Cameras, HaveEveryKindDrawn) {
  std::map<CameraKind, int> drawn;
  int wide = 0;
  int deep = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Draw draw(1, "a camera", i);
    const CameraCase made = camera_case(draw);
    const Case& c = made.source;
    ASSERT_TRUE(c.camera.has_value());
    if (!draws(c, [](const Triangle&) { return true; })) continue;
    ++drawn[made.kind];
    const cases::Matrix4& m = c.camera->projection;
    if (made.kind == CameraKind::perspective) {
      wide += m[5] < 0.0625F ? 1 : 0;
      // far/near is (m10 − 1)/(m10 + 1) for depths −1…1, and m10/(m10 + 1) for depths 0…1. If m10
      // is within 1e-4 of −1, both are about 10^4 or more.
      deep += std::abs(m[10] + 1) < 1e-4F ? 1 : 0;
    }
  }
  for (const auto& [kind, times] : drawn) {
    RecordProperty("kind" + std::to_string(static_cast<int>(kind)), times);
  }
  RecordProperty("wide", wide);
  RecordProperty("deep", deep);
  EXPECT_EQ(drawn.size(), 6U);
  for (const auto& [kind, times] : drawn) EXPECT_GT(times, 15) << static_cast<int>(kind);
  EXPECT_GT(wide, 3);
  EXPECT_GT(deep, 15);
}

/// With the exact camera, the planes of some triangles contain the eye, and others just miss it.
TEST(Cameras, HaveEyesInTheTrianglesPlanesAndBeside) {
  int in_plane = 0;
  int beside = 0;
  int all = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Draw draw(1, "a camera", i);
    const CameraCase made = camera_case(draw);
    if (made.kind != CameraKind::eye_in_the_plane) continue;
    ++all;
    const oracle::SceneTruth scene(made.source, exact_contract(made.source));
    bool is_in = false;
    bool is_beside = false;
    for (std::size_t t = 0; t < made.source.triangles.size(); ++t) {
      const int orientation = oracle::TriangleTruth(scene, t).orientation();
      is_in = is_in || orientation == 0;
      is_beside = is_beside || orientation != 0;
    }
    in_plane += is_in ? 1 : 0;
    beside += is_beside ? 1 : 0;
  }
  RecordProperty("all", all);
  RecordProperty("in", in_plane);
  RecordProperty("beside", beside);
  EXPECT_GT(all, 25);
  EXPECT_GT(in_plane, all / 2);
  EXPECT_GT(beside, all / 2);
}

// --- clipping ------------------------------------------------------------------------------------

/// The side of the clip volume on which a vertex with w > 0 lies, in each of the three directions.
std::array<int, 3> side_of(const Case& c, const ClipVertex& p) {
  const auto side = [](double value, double lo, double hi) {
    return value > hi ? 1 : (value < lo ? -1 : 0);
  };
  const double w = p.w;
  return {side(p.x, -w, w), side(p.y, -w, w), side(p.z, double{near_depth(c)} * w, w)};
}

TEST(Clipping, GoesOutInAll26DirectionsByOneTwoAndThreeVertices) {
  std::set<std::pair<std::array<int, 3>, int>> met;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case c = make_case("clipping", i);
    for (const Triangle& triangle : c.triangles) {
      std::map<std::array<int, 3>, int> sides;
      for (const std::uint32_t v : triangle) ++sides[side_of(c, c.positions[v])];
      const int inside = sides[{0, 0, 0}];
      sides.erase({0, 0, 0});
      if (sides.size() == 1 && inside + sides.begin()->second == 3) met.insert(*sides.begin());
    }
  }
  EXPECT_EQ(met.size(), 26U * 3U);
}

/// True if one triangle, in a viewport that fills the framebuffer, reaches all four sides and both
/// depth planes: it requires samples at every border, and some samples are drawn only with depth
/// clamp.
bool meets_all_planes(const Case& made) {
  Case c = bare(made);
  c.viewport = {
      0, 0, static_cast<float>(c.framebuffer.width), static_cast<float>(c.framebuffer.height),
      0, 1};
  c.depth_clamp = false;
  const oracle::SceneTruth scene(c, exact_contract(c));
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    const oracle::TriangleTruth truth(scene, t);
    std::array<bool, 4> borders{};
    for (int y = 0; y < c.framebuffer.height; ++y) {
      for (int x = 0; x < c.framebuffer.width; ++x) {
        if (truth.judge(x, y, 0).verdict != Verdict::required) continue;
        borders[0] = borders[0] || x == 0;
        borders[1] = borders[1] || y == 0;
        borders[2] = borders[2] || x == c.framebuffer.width - 1;
        borders[3] = borders[3] || y == c.framebuffer.height - 1;
      }
    }
    // Both depth planes: some vertices lie in front of the near plane, and others behind the far
    // plane.
    bool is_before = false;
    bool is_behind = false;
    for (const std::uint32_t v : c.triangles[t]) {
      is_before = is_before || side_of(c, c.positions[v])[2] < 0;
      is_behind = is_behind || side_of(c, c.positions[v])[2] > 0;
    }
    const bool is_cut = any_sample(scene, t, [](const SampleVerdict& sample) {
      return sample.reason == records::Reason::clipped;
    });
    if (is_before && is_behind && is_cut &&
        std::all_of(borders.begin(), borders.end(), [](bool reached) { return reached; })) {
      return true;
    }
  }
  return false;
}

TEST(Clipping, HasPolygonsThroughAllPlanesAndWeightsAboutZero) {
  const int hexagons = count_cases("clipping", meets_all_planes);
  const int fans = count_cases("clipping", [](const Case& c) { return most_at_a_vertex(c) >= 8; });
  const auto has_tiny_weights_drawn = [](const Case& c) {
    return draws(c, [&](const Triangle& triangle) {
      return std::any_of(triangle.begin(), triangle.end(),
                         [&](std::uint32_t v) { return std::abs(c.positions[v].w) <= 0x1p-148F; });
    });
  };
  const int tiny = count_cases("clipping", has_tiny_weights_drawn);
  const int drawn =
      count_cases("clipping", [](const Case& c) { return draws(c, [](auto&) { return true; }); });
  RecordProperty("hexagons", hexagons);
  RecordProperty("fans", fans);
  RecordProperty("tiny", tiny);
  RecordProperty("drawn", drawn);
  EXPECT_GT(hexagons, 25);
  EXPECT_GT(fans, 35);
  EXPECT_GT(tiny, 10);
  EXPECT_GT(drawn, 150);
}

// --- guard-band ----------------------------------------------------------------------------------

TEST(GuardBand, HasVerticesOnItAndAFloatBesideOfDrawnTriangles) {
  const auto draws_with_vertex = [](const std::function<bool(double)>& question) {
    return [question](const Case& c) {
      return draws(c, [&](const Triangle& triangle) {
        return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
          const auto p = window(c, c.positions[v]);
          return question(std::abs(p[0])) || question(std::abs(p[1]));
        });
      });
    };
  };
  const int on = count_cases("guard-band", draws_with_vertex([](double p) { return p == 0x1p15; }));
  const int beside = count_cases("guard-band", draws_with_vertex([](double p) {
                                   return p != 0x1p15 && std::abs(p - 0x1p15) < 0x1p-5;
                                 }));
  const int beyond =
      count_cases("guard-band", draws_with_vertex([](double p) { return p > 0x1p30; }));
  RecordProperty("on", on);
  RecordProperty("beside", beside);
  RecordProperty("beyond", beyond);
  EXPECT_GT(on, 30);
  EXPECT_GT(beside, 50);
  EXPECT_GT(beyond, 10);
}

}  // namespace
}  // namespace rastercheck::properties::mesh_generators_test
