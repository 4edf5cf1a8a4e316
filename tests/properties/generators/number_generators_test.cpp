// The generators of special numbers (any-floats, constants), of triangles without area
// (degenerate), of triangles of every extent (sizes), and of depths that formats store
// (depth-borders) reach what their names say. The exact oracle decides what is drawn.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

#include "tests/properties/generators/generator_cases.h"

namespace rastercheck::properties::number_generators_test {
namespace {

using cases::Case;
using cases::ClipVertex;
using cases::Triangle;

// --- any-floats ----------------------------------------------------------------------------------

TEST(AnyFloats, DrawFromNumbersOfAnySize) {
  const auto draws_within = [](float least, float most) {
    return [least, most](const Case& c) {
      return draws(c, [&](const Triangle& triangle) {
        const Corners p = corners_of(c, triangle);
        return std::all_of(p.begin(), p.end(), [&](const ClipVertex& vertex) {
          return least <= std::abs(vertex.w) && std::abs(vertex.w) < most;
        });
      });
    };
  };
  const int drawn = count_cases("any-floats", draws_within(0, INFINITY));
  const int tiny = count_cases("any-floats", draws_within(0, 0x1p-60F));
  const int huge = count_cases("any-floats", draws_within(0x1p60F, INFINITY));
  const int subnormal = count_cases("any-floats", draws_within(0, 0x1p-126F));
  // Triangles whose vertices' w have very different exponents, also behind the eye.
  const int apart = count_cases("any-floats", [](const Case& c) {
    return draws(c, [&](const Triangle& triangle) {
      const Corners p = corners_of(c, triangle);
      const auto [least, most] =
          std::minmax({std::abs(p[0].w), std::abs(p[1].w), std::abs(p[2].w)});
      return least > 0 && double{most} / double{least} > 0x1p30;
    });
  });
  RecordProperty("drawn", drawn);
  RecordProperty("tiny", tiny);
  RecordProperty("huge", huge);
  RecordProperty("subnormal", subnormal);
  RecordProperty("apart", apart);
  EXPECT_GT(drawn, 120);
  EXPECT_GT(tiny, 20);
  EXPECT_GT(huge, 20);
  EXPECT_GT(subnormal, 3);
  EXPECT_GT(apart, 20);
}

// --- degenerate ----------------------------------------------------------------------------------

TEST(Degenerate, HaveNoAreaBesideOthersThatAreDrawn) {
  int flat = 0;
  int beside_drawn = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = make_case("degenerate", i);
    const oracle::SceneTruth scene(c, exact_contract(c));
    bool has_flat = false;
    bool has_drawn = false;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      has_flat = has_flat || oracle::TriangleTruth(scene, t).orientation() == 0;
      has_drawn = has_drawn || is_drawn(scene, t);
    }
    flat += has_flat ? 1 : 0;
    beside_drawn += has_flat && has_drawn ? 1 : 0;
  }
  RecordProperty("flat", flat);
  RecordProperty("beside", beside_drawn);
  EXPECT_GT(flat, 190);
  EXPECT_GT(beside_drawn, 120);
}

/// Corners that differ but coincide on the screen, and three different corners on one line of the
/// screen.
TEST(Degenerate, HaveCornersThatCoincideOnTheScreenAlone) {
  const auto is_flat_with = [](const std::function<bool(const Corners&)>& question) {
    return [question](const Case& c) {
      const oracle::SceneTruth scene(c, exact_contract(c));
      for (std::size_t t = 0; t < c.triangles.size(); ++t) {
        const Triangle& triangle = c.triangles[t];
        if (question(corners_of(c, triangle)) &&
            oracle::TriangleTruth(scene, t).orientation() == 0) {
          return true;
        }
      }
      return false;
    };
  };
  const auto is_one_place = [](const ClipVertex& a, const ClipVertex& b) {
    return a.w != b.w && double{a.x} * b.w == double{b.x} * a.w &&
           double{a.y} * b.w == double{b.y} * a.w;
  };
  const int coincide = count_cases("degenerate", is_flat_with([&](const Corners& p) {
                                     return is_one_place(p[0], p[1]) || is_one_place(p[1], p[2]) ||
                                            is_one_place(p[2], p[0]);
                                   }));
  const int apart = count_cases("degenerate", is_flat_with([&](const Corners& p) {
                                  return p[0].w > 0 && p[1].w > 0 && p[2].w > 0 &&
                                         !(p[0] == p[1]) && !(p[1] == p[2]) && !(p[2] == p[0]) &&
                                         !is_one_place(p[0], p[1]) && !is_one_place(p[1], p[2]) &&
                                         !is_one_place(p[2], p[0]);
                                }));
  const int behind = count_cases("degenerate", is_flat_with([](const Corners& p) {
                                   return p[0].w < 0 || p[1].w < 0 || p[2].w < 0;
                                 }));
  RecordProperty("coincide", coincide);
  RecordProperty("apart", apart);
  RecordProperty("behind", behind);
  EXPECT_GT(coincide, 40);
  EXPECT_GT(apart, 60);
  EXPECT_GT(behind, 60);
}

// --- constants -----------------------------------------------------------------------------------

bool has_one_depth(const Corners& p) {
  return double{p[0].z} * p[1].w == double{p[1].z} * p[0].w &&
         double{p[1].z} * p[2].w == double{p[2].z} * p[1].w;
}

TEST(Constants, AreOfWeightsOfDepthsAndOfAttributes) {
  const auto draws_with = [](const std::function<bool(const Case&, const Triangle&)>& question) {
    return count_cases("constants", [&](const Case& c) {
      return draws(c, [&](const Triangle& triangle) { return question(c, triangle); });
    });
  };
  const auto weights = [](const Case& c, const Triangle& triangle) {
    const Corners p = corners_of(c, triangle);
    return p[0].w == p[1].w && p[1].w == p[2].w;
  };
  const auto depths = [&](const Case& c, const Triangle& triangle) {
    return has_one_depth(corners_of(c, triangle)) && !weights(c, triangle);
  };
  const auto values = [&](const Case& c, const Triangle& triangle) {
    return !c.attributes.empty() && !weights(c, triangle) &&
           c.attributes_of(triangle[0])[0] == c.attributes_of(triangle[1])[0] &&
           c.attributes_of(triangle[0])[0] == c.attributes_of(triangle[2])[0];
  };
  const auto nearly = [](const Case& c, const Triangle& triangle) {
    const Corners p = corners_of(c, triangle);
    const auto [least, most] = std::minmax({p[0].w, p[1].w, p[2].w});
    return least < most && most <= least * (1 + 0x1p-22F);
  };
  const int of_weights = draws_with(weights);
  const int of_depths = draws_with(depths);
  const int of_values = draws_with(values);
  const int of_nearly = draws_with(nearly);
  RecordProperty("weights", of_weights);
  RecordProperty("depths", of_depths);
  RecordProperty("values", of_values);
  RecordProperty("nearly", of_nearly);
  EXPECT_GT(of_weights, 80);
  EXPECT_GT(of_depths, 70);
  EXPECT_GT(of_values, 70);
  EXPECT_GT(of_nearly, 5);
}

// --- sizes ---------------------------------------------------------------------------------------

/// The longer side of the box around a triangle with w > 0, in pixels.
double extent(const Case& c, const Triangle& triangle) {
  double most = 0;
  const Corners p = corners_of(c, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    const ClipVertex& a = p[i];
    const ClipVertex& b = p[(i + 1) % 3];
    const double u = (double{a.x} / a.w - double{b.x} / b.w) * c.viewport.width / 2;
    const double v = (double{a.y} / a.w - double{b.y} / b.w) * c.viewport.height / 2;
    most = std::max({most, std::abs(u), std::abs(v)});
  }
  return most;
}

TEST(Sizes, AreDrawnOfEveryExtentAndOnTies) {
  std::map<int, int> cases_of;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case c = make_case("sizes", i);
    std::set<int> exponents;
    draws(c, [&](const Triangle& triangle) {
      const oracle::SceneTruth scene(c, exact_contract(c));
      const auto t = static_cast<std::size_t>(&triangle - c.triangles.data());
      if (is_drawn(scene, t)) exponents.insert(std::ilogb(extent(c, triangle)));
      return false;
    });
    for (const int exponent : exponents) ++cases_of[exponent];
  }
  const int ties = count_cases("sizes", [](const Case& c) {
    const oracle::SceneTruth scene(c, exact_contract(c));
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      const bool is_tie = any_sample(scene, t, [](const records::SampleVerdict& sample) {
        return sample.reason == records::Reason::tie &&
               sample.verdict == records::Verdict::required;
      });
      if (is_tie && extent(c, c.triangles[t]) < 0.5) return true;
    }
    return false;
  });
  for (int e = -8; e <= 12; ++e) {
    RecordProperty("extent" + std::to_string(e), cases_of[e]);
    EXPECT_GT(cases_of[e], 2) << e;
  }
  RecordProperty("ties", ties);
  EXPECT_GT(ties, 25);
}

// --- depth-borders -------------------------------------------------------------------------------

/// The window depth of a vertex, computed in double.
double depth(const Case& c, const ClipVertex& p) {
  const double share = double{p.z} / double{p.w};
  const bool is_opengl = c.rules == cases::Rules::opengl;
  const double n{c.viewport.min_depth};
  const double f{c.viewport.max_depth};
  return n + (f - n) * (is_opengl ? (share + 1) / 2 : share);
}

/// How far a depth is from the middle between two numbers of the case's format, in its steps.
double from_middle(const Case& c, const ClipVertex& p) {
  const double scaled = depth(c, p) * (std::ldexp(1.0, cases::unorm_bits(c.depth_format)) - 1);
  return std::abs(scaled - std::floor(scaled) - 0.5);
}

TEST(DepthBorders, HaveEveryFormatAndBias) {
  const auto count = [](const auto& question) { return count_cases("depth-borders", question); };
  for (const auto format :
       {cases::DepthFormat::float32, cases::DepthFormat::unorm16, cases::DepthFormat::unorm24}) {
    EXPECT_GT(count([&](const Case& c) { return c.depth_format == format; }), 25);
  }
  EXPECT_GT(count([](const Case& c) { return c.depth_bias.constant > 0; }), 40);
  EXPECT_GT(count([](const Case& c) { return c.depth_bias.constant < 0; }), 40);
  EXPECT_GT(count([](const Case& c) { return std::abs(c.depth_bias.constant) > 0x1p20F; }), 10);
  EXPECT_GT(count([](const Case& c) { return c.depth_bias.slope > 0; }), 25);
  EXPECT_GT(count([](const Case& c) { return c.depth_bias.slope < 0; }), 25);
  EXPECT_GT(count([](const Case& c) { return c.depth_bias.clamp > 0; }), 15);
  EXPECT_GT(count([](const Case& c) { return c.depth_bias.clamp < 0; }), 15);
  EXPECT_GT(count([](const Case& c) { return c.depth_bias.is_none(); }), 15);
  EXPECT_GT(count([](const Case& c) { return c.depth_clear.has_value(); }), 10);
}

TEST(DepthBorders, LieMidwayBetweenNumbersOfTheirFormat) {
  const auto is_midway = [](const Case& c) {
    if (cases::unorm_bits(c.depth_format) != 16) return false;
    return draws(c, [&c](const Triangle& triangle) {
      const Corners p = corners_of(c, triangle);
      return std::any_of(p.begin(), p.end(), [&c](const ClipVertex& vertex) {
        return vertex.w > 0 && from_middle(c, vertex) < 0x1p-6;
      });
    });
  };
  EXPECT_GT(count_cases("depth-borders", is_midway), 20);
}

}  // namespace
}  // namespace rastercheck::properties::number_generators_test
