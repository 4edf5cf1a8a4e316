// Conservative coverage, by hand and against two other computations (RULES §11). Pictures show
// window rows from v = 0 on, one character per pixel.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "oracle/judge.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::conservative_test {
namespace {

using cases::ClipVertex;
using cases::Conservative;
using cases::ConservativeCorners;
using cases::ConservativeKind;
using cases::Rules;
using records::Verdict;

char sign_for(Verdict verdict) {
  if (verdict == Verdict::permitted) return '?';
  return verdict == Verdict::required ? '#' : '.';
}

cases::Contract contract_with(const cases::Case& c, const Conservative& conservative) {
  cases::Contract contract = cases::contract_of(c);
  contract.conservative = conservative;
  return contract;
}

/// "#" required, "?" permitted, "." forbidden; rows joined by '|'.
std::string picture(const cases::Case& c, const cases::Contract& contract) {
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  std::string text;
  for (int y = 0; y < c.framebuffer.height; ++y) {
    if (y > 0) text += '|';
    for (int x = 0; x < c.framebuffer.width; ++x) text += sign_for(truth.judge(x, y, 0).verdict);
  }
  return text;
}

std::string picture(const cases::Case& c, const Conservative& conservative) {
  return picture(c, contract_with(c, conservative));
}

constexpr Conservative kOuter{};
constexpr Conservative kInner{.kind = ConservativeKind::inner};
constexpr Conservative kDegenerates{.covers_degenerates = true};

/// A clip position at window (u, v) of a 4 × 4 viewport whose window y follows NDC y.
ClipVertex at_window(float u, float v, float w = 1, float z = 0) {
  return {(u / 2 - 1) * w, (v / 2 - 1) * w, z * w, w};
}

cases::Case triangle(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
  return small_case(Rules::vulkan, 4, 4, {a, b, c});
}

// The hypotenuse u + v = 3 1/4 passes the corner (2, 1), of which pixel (2, 1) has a bit.
TEST(Conservative, OfOneTriangleByHand) {
  const auto c = triangle(at_window(0.25F, 0.25F), at_window(3, 0.25F), at_window(0.25F, 3));
  EXPECT_EQ(picture(c, kOuter), "###?|###.|##..|?...");
  EXPECT_EQ(picture(c, kInner), "....|....|....|....");
  EXPECT_EQ(picture(c, {.error = 0.25F}), "###?|###.|##..|?...");
  EXPECT_EQ(picture(c, {.growth = 0.25F}), "####|###.|##..|#...");
}

// Touching: edges along pixel borders, and a corner at a pixel's corner.
TEST(Conservative, TouchingABorderIsPermitted) {
  const auto c = triangle(at_window(1, 1), at_window(3, 1), at_window(1, 3));
  EXPECT_EQ(picture(c, kOuter), "????|?##?|?#?.|??..");
  EXPECT_EQ(picture(c, kInner), "....|.#..|....|....");
}

// The edge u + 8 v = 12 1/4, shifted by (1/2) (1 + 8) to 16 3/4, meets the shifted edge v = 3/4 at
// u = 10 3/4.
TEST(Conservative, ShiftedEdgesReachFartherAtAcuteCorners) {
  const auto c = triangle(at_window(0.25F, 1.25F), at_window(2.25F, 1.25F), at_window(0.25F, 1.5F));
  EXPECT_EQ(picture(c, {.error = 0.5F}), "???.|###.|?...|....");
  EXPECT_EQ(picture(c, {.error = 0.5F, .corners = ConservativeCorners::edges}),
            "????|###?|?...|....");
}

TEST(Conservative, SamplesOfAPixelAreCoveredTogether) {
  auto c =
      triangle(at_window(0.0625F, 0.0625F), at_window(0.125F, 0.0625F), at_window(0.0625F, 0.125F));
  c.framebuffer.samples = 8;
  const SceneTruth scene(c, contract_with(c, kOuter));
  const TriangleTruth truth(scene, 0);
  for (int s = 0; s < 8; ++s) {
    EXPECT_EQ(truth.judge(0, 0, s).verdict, Verdict::required);
    EXPECT_EQ(truth.judge(1, 0, s).verdict, Verdict::forbidden);
  }
}

TEST(Conservative, TrianglesWithoutAreaCoverWhatTheyTouchIfPromised) {
  auto segment = triangle(at_window(0.5F, 0.5F), at_window(2.5F, 1.5F), at_window(1.5F, 1));
  EXPECT_EQ(picture(segment, kDegenerates), "##..|.##.|....|....");
  EXPECT_EQ(picture(segment, kOuter), "....|....|....|....");
  EXPECT_EQ(picture(segment, kInner), "....|....|....|....");
  segment.cull = cases::Cull::back;
  EXPECT_EQ(picture(segment, kDegenerates), "??..|.??.|....|....");
  auto point = triangle(at_window(1.5F, 1.5F), at_window(1.5F, 1.5F, 2), at_window(1.5F, 1.5F));
  EXPECT_EQ(picture(point, kDegenerates), "....|.#..|....|....");
  point.triangles = {{0, 0, 1}};
  EXPECT_EQ(picture(point, kDegenerates), "....|.?..|....|....");
  // On a border: nothing says which of the two pixels.
  const auto border = triangle(at_window(1, 1.5F), at_window(1, 1.75F), at_window(1, 1.25F));
  EXPECT_EQ(picture(border, kDegenerates), "....|??..|....|....");
}

TEST(Conservative, CulledTrianglesCoverNothing) {
  auto c = triangle(at_window(0, 0), at_window(4, 0), at_window(0, 4));
  c.cull = cases::Cull::back;
  const std::string one = picture(c, kOuter);
  c.cull = cases::Cull::front;
  const std::string other = picture(c, kOuter);
  EXPECT_NE(one, other);
  EXPECT_EQ(std::max(one, other), "....|....|....|....");
}

// The viewport ends in the middle of pixels 2; its far part shows nothing of pixel 3.
TEST(Conservative, TheViewportCutsTheTriangle) {
  auto c = small_case(Rules::vulkan, 4, 4,
                      {ClipVertex{-1, -1, 0, 1}, ClipVertex{7, -1, 0, 1}, ClipVertex{-1, 7, 0, 1}});
  c.viewport = {0, 0, 2.5F, 2.5F, 0, 1};
  EXPECT_EQ(picture(c, kOuter), "###.|###.|###.|....");
  EXPECT_EQ(picture(c, kInner), "##..|##..|....|....");
  c.scissor = cases::Scissor{1, 0, 3, 1};
  EXPECT_EQ(picture(c, kOuter), ".##.|....|....|....");
}

// The plane z = 0 cuts at u = 2, along a border of pixels.
TEST(Conservative, ClipPlanesCutTheTriangle) {
  const auto c =
      triangle(at_window(0, 0, 1, 0.5F), at_window(4, 0, 1, -0.5F), at_window(0, 4, 1, 0.5F));
  EXPECT_EQ(picture(c, kOuter), "##?.|##?.|##?.|#?..");
  EXPECT_EQ(picture(c, kInner), "##..|##..|#...|....");
}

// Only the edge from (0, 0) to (0, 4) is left: it has no area.
TEST(Conservative, AnEdgeLeftByClippingIsOpen) {
  const auto c =
      triangle(at_window(0.5F, 0, 1, 0), at_window(4, 0, 1, -0.5F), at_window(0.5F, 4, 1, 0));
  EXPECT_EQ(picture(c, kOuter), "?...|?...|?...|?...");
}

// Vertices move by up to 1/4 pixel, so squares of half the pixel must meet u + v <= 3 3/8, and
// squares grown by 1/4 must miss it.
TEST(Conservative, SnappedPositionsLeavePixelsOpen) {
  const auto c = triangle(at_window(0.5F, 0.5F), at_window(2.875F, 0.5F), at_window(0.5F, 2.875F));
  cases::Contract contract = contract_with(c, kOuter);
  contract.coverage = cases::Snapping{1, cases::Rounding::nearest_even, 0};
  EXPECT_EQ(picture(c, contract), "###?|##?.|#?..|?...");
}

// --- Against Minkowski sums ----------------------------------------------------------------------

/// Twice the signed area of a, b, c; coordinates in eighths of a pixel.
long turn(const std::array<long, 2>& a, const std::array<long, 2>& b,
          const std::array<long, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The position of a point and a triangle grown by [−half, half]²: 1 inside, 0 on the border, −1
/// outside. The grown triangle is the convex hull of its corners' squares.
int side_of_grown(const std::array<std::array<long, 2>, 3>& corners, long half,
                  const std::array<long, 2>& p) {
  std::vector<std::array<long, 2>> points;
  for (const auto& [u, v] : corners) {
    for (const long du : {-half, half}) {
      for (const long dv : {-half, half}) points.push_back({u + du, v + dv});
    }
  }
  int side = 1;
  for (const auto& a : points) {
    for (const auto& b : points) {
      if (a == b) continue;
      const bool is_hull_edge = std::all_of(points.begin(), points.end(),
                                            [&](const auto& c) { return turn(a, b, c) >= 0; });
      if (!is_hull_edge) continue;
      const long where = turn(a, b, p);
      side = std::min(side, where > 0 ? 1 : where < 0 ? -1 : 0);
    }
  }
  return side;
}

/// The verdict of a pixel, from Minkowski sums; eighths of a pixel.
Verdict by_minkowski(const std::array<std::array<long, 2>, 3>& corners, const Conservative& asked,
                     long x, long y) {
  const std::array<long, 2> center{8 * x + 4, 8 * y + 4};
  const auto eighths = [](float pixels) { return static_cast<long>(8 * pixels); };
  if (asked.kind == ConservativeKind::outer) {
    const long half = 4 + eighths(asked.growth);
    if (side_of_grown(corners, half, center) > 0) return Verdict::required;
    return side_of_grown(corners, half + eighths(asked.error), center) < 0 ? Verdict::forbidden
                                                                           : Verdict::permitted;
  }
  const auto holds = [&](long half) {
    const long orientation = turn(corners[0], corners[1], corners[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      for (const long du : {-half, half}) {
        for (const long dv : {-half, half}) {
          const long where =
              turn(corners[i], corners[(i + 1) % 3], {center[0] + du, center[1] + dv});
          if ((orientation > 0 ? where : -where) < 0) return false;
        }
      }
    }
    return true;
  };
  if (!holds(4)) return Verdict::forbidden;
  return holds(4 + eighths(asked.error)) ? Verdict::required : Verdict::permitted;
}

Conservative random_terms(std::mt19937& random) {
  const auto eighths = [&random] {
    return std::array{0.0F, 0.0F, 0.125F, 0.5F, 1.0F}[random() % 5];
  };
  Conservative asked;
  asked.kind = random() % 3 == 0 ? ConservativeKind::inner : ConservativeKind::outer;
  asked.error = eighths();
  if (asked.kind == ConservativeKind::outer) asked.growth = eighths();
  return asked;
}

// Kills: a forgotten corner of the square, a closed square, an error in other units.
TEST(Conservative, AgreesWithMinkowskiSumsOnSmallTriangles) {
  std::mt19937 random(20261128);
  std::array<int, 3> seen{};
  for (int i = 0; i < 3000; ++i) {
    std::array<std::array<long, 2>, 3> corners{};
    std::array<ClipVertex, 3> vertices;
    const unsigned long step = random() % 3 == 0 ? 4 : 1;  // some along pixel borders
    for (std::size_t k = 0; k < 3; ++k) {
      for (long& coordinate : corners[k]) {
        coordinate = static_cast<long>(random() % (32 / step + 1) * step);
      }
      const float w = std::array{0.5F, 1.0F, 4.0F}[random() % 3];
      vertices[k] = at_window(static_cast<float>(corners[k][0]) / 8,
                              static_cast<float>(corners[k][1]) / 8, w);
    }
    if (turn(corners[0], corners[1], corners[2]) == 0) continue;
    const auto c = small_case(Rules::vulkan, 4, 4, {vertices[0], vertices[1], vertices[2]});
    const Conservative asked = random_terms(random);
    const SceneTruth scene(c, contract_with(c, asked));
    const TriangleTruth truth(scene, 0);
    const PixelBox box = truth.pixels();
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) {
        const Verdict expected = by_minkowski(corners, asked, x, y);
        ++seen[static_cast<std::size_t>(expected)];
        ASSERT_EQ(truth.judge(x, y, 0).verdict, expected) << i << ": " << x << ", " << y;
        ASSERT_TRUE(expected == Verdict::forbidden || box.holds(x, y));
      }
    }
  }
  for (const int count : seen) EXPECT_GT(count, 500);
}

// --- Against cones of weights --------------------------------------------------------------------

using Vector = std::array<long, 3>;

long dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_zero(const Vector& a) { return a == Vector{0, 0, 0}; }

/// Integer clip positions: x and y in quarters, z in halves, w whole; in a viewport of 8 × 8.
struct Positions {
  Vector x;
  Vector y;
  Vector z;
  Vector w;
};

/// The verdict of a pixel under outer coverage, from the cone of weights λ that all conditions
/// leave: its extreme rays are cross products of two conditions that satisfy all others.
Verdict by_cone(const Positions& p, long x, long y, long growth_in_quarters,
                long error_in_quarters) {
  const auto rays_of = [&](long grown) {
    std::vector<Vector> conditions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vector near{};
    Vector far{};
    std::array<Vector, 8> sides{};
    for (std::size_t k = 0; k < 3; ++k) {
      near[k] = p.z[k];
      far[k] = 2 * p.w[k] - p.z[k];
      // 4 X = 4 (4 x + 4 w) with x in quarters: X = x + 4 w.
      const long u = 4 * (p.x[k] + 4 * p.w[k]);
      const long v = 4 * (p.y[k] + 4 * p.w[k]);
      sides[0][k] = u - (4 * x - grown) * p.w[k];
      sides[1][k] = (4 * x + 4 + grown) * p.w[k] - u;
      sides[2][k] = v - (4 * y - grown) * p.w[k];
      sides[3][k] = (4 * y + 4 + grown) * p.w[k] - v;
      sides[4][k] = u;
      sides[5][k] = 32 * p.w[k] - u;
      sides[6][k] = v;
      sides[7][k] = 32 * p.w[k] - v;
    }
    // A plane that is 0 everywhere keeps everything; a side with all points on it, none inside.
    if (!is_zero(near)) conditions.push_back(near);
    if (!is_zero(far)) conditions.push_back(far);
    const bool is_on_side = std::any_of(sides.begin(), sides.end(), is_zero);
    for (const Vector& side : sides) {
      if (!is_zero(side)) conditions.push_back(side);
    }
    std::vector<Vector> rays;
    for (const Vector& a : conditions) {
      for (const Vector& b : conditions) {
        const Vector ray = cross(a, b);
        const bool is_inside =
            !is_zero(ray) && std::all_of(conditions.begin(), conditions.end(),
                                         [&ray](const Vector& c) { return dot(c, ray) >= 0; });
        if (is_inside) rays.push_back(ray);
      }
    }
    Vector middle{};
    for (const Vector& ray : rays) {
      for (std::size_t k = 0; k < 3; ++k) middle[k] += ray[k];
    }
    const bool has_area = !rays.empty() && !is_on_side &&
                          std::all_of(conditions.begin(), conditions.end(),
                                      [&](const Vector& c) { return dot(c, middle) > 0; });
    return std::pair(has_area, !rays.empty() && dot(p.w, middle) > 0);
  };
  if (rays_of(growth_in_quarters).first) return Verdict::required;
  return rays_of(growth_in_quarters + error_in_quarters).second ? Verdict::permitted
                                                                : Verdict::forbidden;
}

// Kills: separating axes where some w <= 0, clip planes without the square.
TEST(Conservative, AgreesWithConesOfWeightsForAllSignsOfW) {
  std::mt19937 random(7);
  std::array<int, 3> seen{};
  int without_area = 0;
  int behind = 0;
  for (int i = 0; i < 1500; ++i) {
    Positions p{};
    std::array<ClipVertex, 3> vertices;
    const bool is_flat = random() % 4 == 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto from = [&random](long least, long greatest) {
        return least + static_cast<long>(random() % static_cast<unsigned>(greatest - least + 1));
      };
      p.w[k] = from(-2, 4);
      p.x[k] = from(-12, 12);
      p.y[k] = from(-12, 12);
      p.z[k] = from(-1, 3);
      if (is_flat && k == 2) {  // on the line through the other two
        for (Vector* const all : {&p.x, &p.y, &p.w}) (*all)[2] = (*all)[0] + (*all)[1];
      }
      vertices[k] = {static_cast<float>(p.x[k]) / 4, static_cast<float>(p.y[k]) / 4,
                     static_cast<float>(p.z[k]) / 2, static_cast<float>(p.w[k])};
    }
    const auto c = small_case(Rules::vulkan, 8, 8, {vertices[0], vertices[1], vertices[2]});
    const long growth = std::array{0L, 1L, 2L}[random() % 3];
    const long error = std::array{0L, 1L, 4L}[random() % 3];
    const Conservative asked{.error = static_cast<float>(error) / 4,
                             .growth = static_cast<float>(growth) / 4,
                             .covers_degenerates = true};
    const SceneTruth scene(c, contract_with(c, asked));
    const TriangleTruth truth(scene, 0);
    const PixelBox box = truth.pixels();
    without_area += truth.orientation() == 0 ? 1 : 0;
    behind += *std::min_element(p.w.begin(), p.w.end()) <= 0 ? 1 : 0;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const Verdict expected = by_cone(p, x, y, growth, error);
        ++seen[static_cast<std::size_t>(expected)];
        ASSERT_EQ(truth.judge(x, y, 0).verdict, expected) << i << ": " << x << ", " << y;
        ASSERT_TRUE(expected == Verdict::forbidden || box.holds(x, y)) << i;
      }
    }
  }
  for (const int count : seen) EXPECT_GT(count, 500);
  EXPECT_GT(without_area, 200);
  EXPECT_GT(behind, 500);
}

// --- Soundness and levels ------------------------------------------------------------------------

/// The verdicts of all samples by a level of the cascade.
std::vector<std::array<int, 2>> counts_by(const cases::Case& c, const cases::Contract& contract,
                                          Level level) {
  const SceneTruth scene(c, contract);
  cases::Fragments nothing;
  nothing.attribute_count = c.attributes.size();
  JudgeOptions options;
  options.first_level = level;
  const JudgedDrawing judged = judge(scene, nothing, options);
  const records::Counts& counts = judged.judgement.counts;
  return {{static_cast<int>(counts.required), static_cast<int>(counts.permitted)}};
}

/// A triangle anywhere about a window of 8 × 8, often with some w <= 0.
cases::Case random_case(std::mt19937& random) {
  std::array<ClipVertex, 3> vertices;
  for (ClipVertex& p : vertices) {
    const auto from = [&random](float least, float greatest) {
      return least + (greatest - least) * static_cast<float>(random() % 4096) / 4096;
    };
    const float w = random() % 6 == 0 ? from(-1, 0.5F) : from(0.5F, 2);
    p = {from(-1.5F, 1.5F), from(-1.5F, 1.5F), from(-0.2F, 1.2F), w};
  }
  return small_case(Rules::vulkan, 8, 8, {vertices[0], vertices[1], vertices[2]});
}

TEST(Conservative, AllLevelsGiveTheSameVerdicts) {
  std::mt19937 random(11);
  for (int i = 0; i < 400; ++i) {
    const cases::Case c = random_case(random);
    cases::Contract contract = contract_with(c, random_terms(random));
    if (i % 3 == 0) contract.coverage = cases::Snapping{4, cases::Rounding::unspecified, 0.25F};
    ASSERT_EQ(counts_by(c, contract, Level::filter), counts_by(c, contract, Level::exact)) << i;
  }
}

/// Rounds a vertex's window position in a window of 8 × 8 down or up to eighths; w must be a power
/// of two.
ClipVertex rounded(const ClipVertex& p, std::mt19937& random) {
  const auto along = [&](float coordinate) {
    const float eighths = (coordinate / p.w + 1) * 32;
    const float at = random() % 2 == 0 ? std::floor(eighths) : std::ceil(eighths);
    return (at / 32 - 1) * p.w;
  };
  return {along(p.x), along(p.y), p.z, p.w};
}

// What a contract with snapping requires, every moved triangle requires, and likewise what it
// forbids. Kills: a reach that is left out, or taken the wrong way round.
TEST(Conservative, SnappedVerdictsHoldForEveryMovedTriangle) {
  std::mt19937 random(5);
  int required = 0;
  for (int i = 0; i < 200; ++i) {
    cases::Case c = random_case(random);
    c.depth_clamp = true;
    for (ClipVertex& p : c.positions) p.w = p.w < 0.75F ? 0.5F : 1.0F;
    Conservative asked = random_terms(random);
    if (asked.kind == ConservativeKind::outer && i % 2 == 0) {
      asked.corners = ConservativeCorners::edges;
    }
    cases::Contract contract = contract_with(c, asked);
    contract.coverage = cases::Snapping{3, cases::Rounding::unspecified, 0};
    const SceneTruth snapped(c, contract);
    const TriangleTruth truth(snapped, 0);
    for (int k = 0; k < 8; ++k) {
      cases::Case other = c;
      for (ClipVertex& p : other.positions) p = rounded(p, random);
      const SceneTruth exact(other, contract_with(other, asked));
      const TriangleTruth of_other(exact, 0);
      for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
          const Verdict open = truth.judge(x, y, 0).verdict;
          const Verdict sure = of_other.judge(x, y, 0).verdict;
          required += open == Verdict::required ? 1 : 0;
          ASSERT_TRUE(open != Verdict::forbidden || sure == Verdict::forbidden) << i;
          ASSERT_TRUE(open != Verdict::required || sure == Verdict::required) << i;
        }
      }
    }
  }
  EXPECT_GT(required, 1000);
}

// --- Values --------------------------------------------------------------------------------------

// At (2.5, 2.5), outside the triangle, the plane u + v has the value 5; the exact bound holds it.
TEST(Conservative, ValuesOutsideTheTriangleAreThePlanes) {
  auto c = triangle(at_window(0, 0), at_window(2.75F, 2.25F), at_window(0.5F, 0.75F));
  c.attributes = {{"sum", cases::Interpolation::smooth, cases::Location::sample}};
  c.attribute_values = {0, 5, 1.25F};
  const SceneTruth scene(c, contract_with(c, kOuter));
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.judge(2, 2, 0).verdict, Verdict::required);
  const std::optional<ValueRange> value = truth.attribute(0, 2, 2, 0);
  ASSERT_TRUE(value.has_value());
  EXPECT_EQ(value->lo.to_string(), "5");
}

// w = 1 at u = 0.25 and 1/4 at u = 2: 1/w grows by 12/7 per pixel and is 4/7 at u = 0: positive
// everywhere; with the ends exchanged, 1/w is 0 at u = 2 1/3 and the centre of pixel 2 has no
// value.
TEST(Conservative, ValuesBehindTheHorizonAreNotJudged) {
  auto c = triangle(at_window(0.25F, 0.25F, 0.25F), at_window(2.0625F, 0.25F, 16),
                    at_window(2.0625F, 0.5F, 16));
  c.attributes = {{"a", cases::Interpolation::smooth, cases::Location::sample},
                  {"b", cases::Interpolation::noperspective, cases::Location::sample}};
  c.attribute_values = {0, 0, 1, 1, 2, 2};
  const SceneTruth scene(c, contract_with(c, kOuter));
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.judge(2, 0, 0).verdict, Verdict::required);
  EXPECT_FALSE(truth.attribute(0, 2, 0, 0).has_value());
  EXPECT_FALSE(truth.attribute(1, 2, 0, 0).has_value());
  EXPECT_FALSE(truth.depth(2, 0, 0).has_value());
  EXPECT_TRUE(truth.attribute(0, 1, 0, 0).has_value());
}

}  // namespace
}  // namespace rastercheck::oracle::conservative_test
