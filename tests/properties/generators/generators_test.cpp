// Every generator makes valid cases, reaches what its name says, and stays small enough for exact
// judging.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "properties/law.h"
#include "tests/properties/generators/generator_cases.h"

namespace rastercheck::properties::generators_test {
namespace {

using cases::Case;
using cases::ClipVertex;

constexpr std::uint64_t kSeed = 1;

using Question = std::function<bool(const Case&)>;

bool any_vertex(const Case& c, const std::function<bool(const ClipVertex&)>& question) {
  return std::any_of(c.positions.begin(), c.positions.end(), question);
}

TEST(Generators, AreKnownByTheirNames) {
  std::vector<std::string_view> names;
  for (const Generator& generator : generators()) names.push_back(generator.name);
  EXPECT_EQ(names, (std::vector<std::string_view>{
                       "any-floats",    "cameras", "clipping", "constants",   "degenerate",
                       "depth-borders", "grazing", "grids",    "guard-band",  "hairline",
                       "huge",          "lines",   "meshes",   "near-misses", "on-grid",
                       "ordinary",      "points",  "sizes",    "slivers",     "snap-ties",
                       "through-eye",   "tiny",    "wide"}));
  EXPECT_EQ(find_generator("tiny")->name, "tiny");
  EXPECT_EQ(find_generator("tin"), nullptr);
}

TEST(Generators, MakeCasesThatComeBackFromTheirFiles) {
  for (const Generator& generator : generators()) {
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Case c = make_case(generator.name, i);
      const Result<Case> read = cases::parse_case(cases::to_json(c), "");
      ASSERT_TRUE(read.has_value()) << generator.name << i << ": " << to_string(read.error());
      EXPECT_EQ(*read, c) << generator.name << i;
      EXPECT_FALSE(c.triangles.empty());
      EXPECT_LE(c.framebuffer.width * c.framebuffer.height, 4096);
      EXPECT_FALSE(c.camera.has_value());
      EXPECT_EQ(c.name, "");
    }
  }
}

TEST(Generators, DependOnTheDrawAlone) {
  for (const Generator& generator : generators()) {
    EXPECT_EQ(make_case(generator.name, 77), make_case(generator.name, 77)) << generator.name;
    EXPECT_NE(make_case(generator.name, 77), make_case(generator.name, 78)) << generator.name;
  }
}

// The cases are the same with every compiler and on every machine. After a deliberate change of a
// generator they differ, and new baselines have to be started.
TEST(Generators, MakeTheSameCasesEverywhere) {
  std::map<std::string, std::uint64_t> hashes;
  for (const Generator& generator : generators()) {
    std::string all;
    for (std::uint64_t i = 0; i < 101; ++i) all += cases::to_json(make_case(generator.name, i));
    hashes[std::string(generator.name)] = fnv1a(all);
  }
  const std::map<std::string, std::uint64_t> expected{
      {"any-floats", 0xb7d8ccb613d65fed},  {"cameras", 0x68dac46df7bb8418},
      {"clipping", 0x49d2f227e95f6519},    {"constants", 0x6eb472d099d11ba5},
      {"degenerate", 0x068279c7ac577d7d},  {"depth-borders", 0xe2b04fce1c1980e3},
      {"grazing", 0x190f44f24704a074},     {"grids", 0x0f3125b87187066f},
      {"guard-band", 0xb72d9052dd68e229},  {"hairline", 0x34d765c9d7be9868},
      {"huge", 0x5e052aebc35b116e},        {"lines", 0x730969ca994fcf74},
      {"meshes", 0xe1507fffaece9cae},      {"points", 0xe46dd8ca6ceaea11},
      {"near-misses", 0x26205016c4aef70a}, {"on-grid", 0x8968933df29444d2},
      {"ordinary", 0x4f929a714d54b515},    {"sizes", 0x552d272d62635266},
      {"slivers", 0x387e7f210dc82052},     {"snap-ties", 0x23f4cfad63f479f5},
      {"through-eye", 0xd9690a5ed41e347c}, {"tiny", 0x75d9d7adcec30aea},
      {"wide", 0x690c3000f33b0e4b}};
  EXPECT_EQ(hashes, expected);
}

/// The number of samples that the triangles of a generator's first 100 cases require.
int required_samples(const Generator& generator) {
  int required = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Case c = make_case(generator.name, i);
    const oracle::SceneTruth scene(c, cases::contract_of(c));
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      any_sample(scene, t, [&required](const records::SampleVerdict& sample) {
        required += sample.verdict == records::Verdict::required ? 1 : 0;
        return false;
      });
    }
  }
  return required;
}

TEST(Generators, DrawSomethingButNotTooMuch) {
  for (const Generator& generator : generators()) {
    const int required = required_samples(generator);
    RecordProperty(std::string(generator.name) + "-required", required);
    EXPECT_GT(required, 100 * 5) << generator.name;
    EXPECT_LT(required, 100 * 1500) << generator.name;
  }
}

/// Each generator reaches every state that is not the default within 400 cases.
TEST(Generators, VaryTheState) {
  for (const Generator& generator : generators()) {
    std::map<std::string, int> seen;
    for (std::uint64_t i = 0; i < 400; ++i) {
      const Case c = make_case(generator.name, i);
      const cases::Viewport& viewport = c.viewport;
      seen["opengl"] += c.rules == cases::Rules::opengl ? 1 : 0;
      seen["vulkan"] += c.rules == cases::Rules::vulkan ? 1 : 0;
      seen["d3d"] += c.rules == cases::Rules::d3d ? 1 : 0;
      seen["turned"] += viewport.height < 0 ? 1 : 0;
      seen["snapped"] += c.coverage.has_value() ? 1 : 0;
      seen["offset"] += viewport.x != 0 ? 1 : 0;
      seen["reversed depth"] += viewport.min_depth > viewport.max_depth ? 1 : 0;
      seen["4 samples"] += c.framebuffer.samples == 4 ? 1 : 0;
      seen["16 samples"] += c.framebuffer.samples == 16 ? 1 : 0;
      if (c.primitive == cases::Primitive::triangles) {
        seen["cull"] += c.cull != cases::Cull::none ? 1 : 0;
      }
      seen["cw"] += c.front_face == cases::FrontFace::cw ? 1 : 0;
      seen["scissor"] += c.scissor.has_value() ? 1 : 0;
      seen["depth clamp"] += c.depth_clamp ? 1 : 0;
      seen["depth test"] += c.depth_test == cases::DepthTest::less ? 1 : 0;
      seen["clip distances"] += c.clip_distance_count > 0 ? 1 : 0;
      seen["no attribute"] += c.attributes.empty() ? 1 : 0;
      seen["three attributes"] += c.attributes.size() == 3 ? 1 : 0;
      for (const cases::Attribute& attribute : c.attributes) {
        seen["flat"] += attribute.interpolation == cases::Interpolation::flat ? 1 : 0;
        seen["centroid"] += attribute.location == cases::Location::centroid ? 1 : 0;
        seen["center"] += attribute.location == cases::Location::center ? 1 : 0;
      }
    }
    for (const auto& [what, times] : seen) EXPECT_GT(times, 3) << generator.name << ": " << what;
  }
}

TEST(Ordinary, HasOneToFourTrianglesOfPositiveWeight) {
  const Question obeys = [](const Case& c) {
    return c.triangles.size() <= 4 &&
           !any_vertex(c, [](const ClipVertex& p) { return p.w < 0.125F || p.w > 8; });
  };
  EXPECT_EQ(count_cases("ordinary", obeys), 200);
  EXPECT_GT(count_cases("ordinary", [](const Case& c) { return c.triangles.size() == 4; }), 3);
}

TEST(ThroughEye, MostlyHasAWeightOfZeroOrLess) {
  const auto reaches_behind = [](const ClipVertex& p) { return p.w <= 0; };
  EXPECT_GT(
      count_cases("through-eye", [&](const Case& c) { return any_vertex(c, reaches_behind); }),
      150);
  const auto is_last_float = [](const ClipVertex& p) { return std::abs(p.w) == 0x1p-149F; };
  EXPECT_GT(count_cases("through-eye", [&](const Case& c) { return any_vertex(c, is_last_float); }),
            10);
  const auto is_zero = [](const ClipVertex& p) { return p.w == 0; };
  EXPECT_GT(count_cases("through-eye", [&](const Case& c) { return any_vertex(c, is_zero); }), 20);
}

/// The least height of the triangle in the window, over its longest side, computed in double.
double least_height(const Case& c, const cases::Triangle& triangle) {
  std::array<double, 3> u{};
  std::array<double, 3> v{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = window(c, c.positions[triangle[i]]);
    u[i] = at[0];
    v[i] = at[1];
  }
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    longest = std::max(longest, std::hypot(u[j] - u[i], v[j] - v[i]));
  }
  const double area = (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]);
  return longest == 0 ? 0 : std::abs(area) / longest;
}

TEST(Slivers, AreThin) {
  int all = 0;
  int below_a_pixel = 0;
  int below_a_grid_step = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = make_case("slivers", i);
    for (const cases::Triangle& triangle : c.triangles) {
      const double height = least_height(c, triangle);
      ++all;
      if (height <= 1.5) ++below_a_pixel;
      if (height < 0x1p-8) ++below_a_grid_step;
    }
  }
  EXPECT_EQ(below_a_pixel, all);
  EXPECT_GT(below_a_grid_step, all / 10);
  EXPECT_LT(below_a_grid_step, all / 2 + all / 4);
}

TEST(OnGrid, MostlyHasItsCornersOnThe256Grid) {
  const auto is_on_grid = [](double coordinate) {
    return coordinate * 256 == std::floor(coordinate * 256);
  };
  const Question obeys = [&](const Case& c) {
    return !any_vertex(c, [&](const ClipVertex& p) {
      const auto at = window(c, p);
      return !is_on_grid(at[0]) || !is_on_grid(at[1]);
    });
  };
  // In the other cases, edges run through samples from vertices whose w is not a power of two.
  EXPECT_GT(count_cases("on-grid", obeys), 70);
  EXPECT_LT(count_cases("on-grid", obeys), 190);
}

TEST(OnGrid, AsksTheTieRule) {
  int ties = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case c = make_case("on-grid", i);
    const oracle::SceneTruth scene(c, cases::contract_of(c));
    bool has_tie = false;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      has_tie = has_tie || any_sample(scene, t, [](const records::SampleVerdict& sample) {
                  return sample.reason == records::Reason::tie;
                });
    }
    if (has_tie) ++ties;
  }
  RecordProperty("ties", ties);
  EXPECT_GT(ties, 160);
}

TEST(Tiny, ReachesBelowThePixelTheGridAndTheFloats) {
  const auto has = [](double least, double most) {
    return [least, most](const Case& c) {
      return std::any_of(c.triangles.begin(), c.triangles.end(), [&](const cases::Triangle& t) {
        const double height = least_height(c, t);
        return least <= height && height < most;
      });
    };
  };
  EXPECT_GT(count_cases("tiny", has(0.1, 8)), 100);
  EXPECT_GT(count_cases("tiny", has(0x1p-12, 0x1p-8)), 50);
  EXPECT_GT(count_cases("tiny", has(0, 0x1p-30)), 50);
  const auto is_subnormal = [](const ClipVertex& p) {
    return p.x != 0 && std::abs(p.x) < 0x1p-126F;
  };
  EXPECT_GT(count_cases("tiny", [&](const Case& c) { return any_vertex(c, is_subnormal); }), 40);
}

TEST(Huge, ReachesBeyondTheGuardBandAnd2To31) {
  const auto beyond = [](double pixels) {
    return [pixels](const Case& c) {
      return any_vertex(c,
                        [&](const ClipVertex& p) { return std::abs(window(c, p)[0]) >= pixels; });
    };
  };
  EXPECT_GT(count_cases("huge", beyond(0x1p15)), 100);
  EXPECT_GT(count_cases("huge", beyond(0x1p31)), 30);
  const Question has_wide_weights = [](const Case& c) {
    const auto& p = c.positions;
    const float least = std::min({p[0].w, p[1].w, p[2].w});
    const float most = std::max({p[0].w, p[1].w, p[2].w});
    return double{most} / double{least} >= 0x1p20;
  };
  EXPECT_GT(count_cases("huge", has_wide_weights), 5);
  const auto is_far_out = [](const ClipVertex& p) { return std::abs(p.x) >= 0x1p90F; };
  EXPECT_GT(count_cases("huge", [&](const Case& c) { return any_vertex(c, is_far_out); }), 5);
}

TEST(Grazing, HasVerticesOnAndBesideThePlanes) {
  const auto is_on_plane = [](const ClipVertex& p) {
    return std::abs(p.x) == p.w || std::abs(p.y) == p.w || std::abs(p.z) == p.w;
  };
  EXPECT_GT(count_cases("grazing", [&](const Case& c) { return any_vertex(c, is_on_plane); }), 150);
  const auto is_beside = [](const ClipVertex& p) {
    return std::abs(p.z) != p.w && std::abs(std::abs(p.z) - p.w) <= p.w * 0x1p-23F;
  };
  EXPECT_GT(count_cases("grazing", [&](const Case& c) { return any_vertex(c, is_beside); }), 20);
  const Question has_zero_distance = [](const Case& c) {
    return std::find(c.clip_distances.begin(), c.clip_distances.end(), 0.0F) !=
           c.clip_distances.end();
  };
  EXPECT_GT(count_cases("grazing", has_zero_distance), 30);
}

TEST(Wide, HasPixelsBeyondTheFirst64OfARow) {
  const Question is_wide = [](const Case& c) {
    return c.framebuffer.width > 64 && c.framebuffer.width <= 200 && c.framebuffer.height <= 12;
  };
  EXPECT_EQ(count_cases("wide", is_wide), 200);
  EXPECT_GT(count_cases("wide", [](const Case& c) { return c.framebuffer.width > 128; }), 40);
  int drawn_beyond = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case c = make_case("wide", i);
    const oracle::SceneTruth scene(c, cases::contract_of(c));
    bool is_beyond = false;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      const oracle::TriangleTruth truth(scene, t);
      const oracle::PixelBox pixels = truth.pixels();
      for (int y = pixels.y0; y < pixels.y1; ++y) {
        for (int x = std::max(pixels.x0, 64); x < pixels.x1; ++x) {
          is_beyond = is_beyond || truth.judge(x, y, 0).verdict == records::Verdict::required;
        }
      }
    }
    drawn_beyond += is_beyond ? 1 : 0;
  }
  RecordProperty("drawn beyond", drawn_beyond);
  EXPECT_GT(drawn_beyond, 200);
}

TEST(GenerateAny, TakesEveryGeneratorAndNamesIt) {
  std::map<std::string, int> strata;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Draw draw(kSeed, "a law", i);
    ++strata[generate_any(draw).stratum];
  }
  EXPECT_EQ(strata.size(), general_generators().size());
  for (const auto& [name, times] : strata) EXPECT_GT(times, 25) << name;
}

}  // namespace
}  // namespace rastercheck::properties::generators_test
