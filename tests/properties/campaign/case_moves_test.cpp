// Each move does what its name says, on a triangle small enough to check by hand; and whatever is
// moved, the result is a case that case files can hold.

#include "properties/campaign/internal/case_moves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/contract.h"
#include "oracle/transform.h"
#include "properties/campaign/internal/case_size.h"
#include "properties/float_numbers.h"
#include "properties/law.h"
#include "properties/window_position.h"

namespace rastercheck::properties::case_moves_test {
namespace {

using cases::Case;

/// Window positions (1, 1), (7, 1), (1, 7) in 8×8 pixels, with w of 1, 2 and 4; one attribute with
/// the values 1, 2 and 3. In focus is the centre of pixel (2, 3).
Case triangle() {
  Case c;
  c.rules = cases::Rules::vulkan;
  c.framebuffer = {8, 8, 1};
  c.viewport.width = 8;
  c.viewport.height = 8;
  c.positions = {{-0.75F, -0.75F, 0.25F, 1}, {1.5F, -1.5F, 0.5F, 2}, {-3, 3, 1, 4}};
  c.attributes = {{"r", cases::Interpolation::smooth, cases::Location::sample}};
  c.attribute_values = {1, 2, 3};
  c.triangles = {{0, 1, 2}};
  return c;
}
const MoveFocus kFocus{{0, 3, 2, 0}, 0};
constexpr WindowPoint kSample{2.5, 3.5};

WindowPoint window_of(const Case& c, std::size_t vertex) {
  return window_point(c.viewport, c.positions[vertex]);
}

/// Twice the area of a triangle of points.
double area(const WindowPoint& a, const WindowPoint& b, const WindowPoint& c) {
  return std::fabs((b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v));
}
double distance(const WindowPoint& a, const WindowPoint& b) {
  return std::hypot(a.u - b.u, a.v - b.v);
}

/// Moves the triangle by several choices, and calls `check` with each result.
template <typename Check>
void try_move(const char* name, const Check& check) {
  const CaseMove* const move = find_move(name);
  ASSERT_NE(move, nullptr) << name;
  int changed = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    Draw draw(1, "test", i);
    Case c = triangle();
    if (!move->change(c, kFocus, draw)) {
      EXPECT_EQ(c, triangle()) << name;
      continue;
    }
    ++changed;
    check(c);
  }
  EXPECT_GT(changed, 0) << name;
}

/// Pairs of numbers before and after.
std::vector<std::pair<float, float>> changed_numbers(Case after) {
  Case before = triangle();
  std::vector<std::pair<float, float>> changed;
  const std::vector<float*> old_numbers = numbers_of(before);
  const std::vector<float*> new_numbers = numbers_of(after);
  for (std::size_t i = 0; i < old_numbers.size(); ++i) {
    if (*old_numbers[i] != *new_numbers[i]) changed.emplace_back(*old_numbers[i], *new_numbers[i]);
  }
  return changed;
}

TEST(CaseMoves, HaveDifferentNames) {
  std::set<std::string_view> names;
  for (const CaseMove& move : case_moves()) EXPECT_TRUE(names.insert(move.name).second);
  EXPECT_EQ(find_move("nothing"), nullptr);
}

TEST(CaseMoves, OneNumberToANeighbouringFloat) {
  try_move("one number to a neighbouring float",
           [](const Case& c) { EXPECT_EQ(changed_numbers(c).size(), 1U); });
}

TEST(CaseMoves, AllNumbersToNeighbouringFloats) {
  try_move("all numbers to neighbouring floats", [](const Case& c) {
    const auto changed = changed_numbers(c);
    EXPECT_GT(changed.size(), 8U);
    for (const auto& [before, after] : changed) {
      EXPECT_LE(std::fabs(after - before), 8 * ulp_of(before));
    }
  });
}

TEST(CaseMoves, ANumberEqualToAnotherVertexs) {
  try_move("a number equal to another vertex's", [](const Case& c) {
    const auto changed = changed_numbers(c);
    ASSERT_EQ(changed.size(), 1U);
    Case before = triangle();
    const auto numbers = numbers_of(before);
    EXPECT_TRUE(std::any_of(numbers.begin(), numbers.end(),
                            [&](const float* number) { return *number == changed[0].second; }));
  });
}

TEST(CaseMoves, PositionsScaled) {
  try_move("positions scaled", [](const Case& c) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(distance(window_of(c, i), window_of(triangle(), i)), 1e-5);
      const float factor = c.positions[0].w / triangle().positions[0].w;
      EXPECT_FLOAT_EQ(c.positions[i].w / triangle().positions[i].w, factor);
    }
  });
}

TEST(CaseMoves, AVertexTowardsTheHorizon) {
  try_move("a vertex towards the horizon", [](const Case& c) {
    const auto [least, greatest] =
        std::minmax({c.positions[0].w, c.positions[1].w, c.positions[2].w});
    EXPECT_GE(greatest / least, 4);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(distance(window_of(c, i), window_of(triangle(), i)), 1e-5);
    }
  });
}

TEST(CaseMoves, AVertexTowardsASliver) {
  const double before =
      area(window_of(triangle(), 0), window_of(triangle(), 1), window_of(triangle(), 2));
  EXPECT_DOUBLE_EQ(before, 36);
  try_move("a vertex towards a sliver", [&](const Case& c) {
    EXPECT_LT(area(window_of(c, 0), window_of(c, 1), window_of(c, 2)), before);
  });
}

TEST(CaseMoves, AnEdgeThroughTheSample) {
  try_move("an edge through the sample", [](const Case& c) {
    double nearest = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const WindowPoint a = window_of(c, i);
      const WindowPoint b = window_of(c, (i + 1) % 3);
      nearest = std::min(nearest, area(a, b, kSample) / distance(a, b));
    }
    EXPECT_LT(nearest, 1e-5);
  });
}

TEST(CaseMoves, AVertexOntoTheSample) {
  try_move("a vertex onto the sample", [](const Case& c) {
    const bool is_there = std::any_of(c.positions.begin(), c.positions.end(),
                                      [&](const auto& p) { return is_exactly_at(c, p, kSample); });
    EXPECT_TRUE(is_there);
  });
}

TEST(CaseMoves, ScaledAboutTheSample) {
  try_move("scaled about the sample", [](const Case& c) {
    const auto factor = [&c](std::size_t i) {
      return distance(window_of(c, i), kSample) / distance(window_of(triangle(), i), kSample);
    };
    EXPECT_NEAR(factor(0), factor(1), 1e-4);
    EXPECT_NEAR(factor(0), factor(2), 1e-4);
    EXPECT_NE(factor(0), 1);
  });
}

TEST(CaseMoves, TheTriangleMoved) {
  try_move("the triangle moved", [](const Case& c) {
    const auto moved = [&c](std::size_t i) {
      return WindowPoint{window_of(c, i).u - window_of(triangle(), i).u,
                         window_of(c, i).v - window_of(triangle(), i).v};
    };
    EXPECT_GT(std::hypot(moved(0).u, moved(0).v), 1.0 / 256);
    for (std::size_t i = 1; i < 3; ++i) EXPECT_LT(distance(moved(i), moved(0)), 1e-5);
  });
}

TEST(CaseMoves, TheVerticesInAnotherOrder) {
  try_move("the vertices in another order", [](const Case& c) {
    EXPECT_NE(c.triangles[0], triangle().triangles[0]);
    EXPECT_THAT(c.triangles[0], testing::UnorderedElementsAre(0, 1, 2));
  });
}

TEST(CaseMoves, ADepthOntoAClipPlaneIsForDepths) {
  const CaseMove* const move = find_move("a depth onto a clip plane");
  Case c = triangle();
  Draw draw(1, "test", 0);
  EXPECT_FALSE(move->change(c, kFocus, draw));
  ASSERT_TRUE(move->change(c, {kFocus.at, std::nullopt}, draw));
  EXPECT_TRUE(std::any_of(c.positions.begin(), c.positions.end(),
                          [](const auto& p) { return p.z == 0 || p.z == p.w; }));
}

/// By hand: the barycentrics of (2.5, 3.5) in the window are (1/3, 1/4, 5/12); divided by w, they
/// are (1/3, 1/8, 5/48), whose sum is 9/16.
TEST(CaseMoves, KnowVertexShares) {
  const auto shares = vertex_shares(triangle(), kFocus);
  ASSERT_TRUE(shares);
  EXPECT_NEAR((*shares)[0], 16.0 / 27, 1e-6);
  EXPECT_NEAR((*shares)[1], 2.0 / 9, 1e-6);
  EXPECT_NEAR((*shares)[2], 5.0 / 27, 1e-6);
  Case flat = triangle();
  flat.attributes[0].interpolation = cases::Interpolation::noperspective;
  const auto on_screen = vertex_shares(flat, kFocus);
  ASSERT_TRUE(on_screen);
  EXPECT_NEAR((*on_screen)[0], 1.0 / 3, 1e-6);
  EXPECT_NEAR((*on_screen)[1], 1.0 / 4, 1e-6);
}

TEST(CaseMoves, ValuesTowardsCancellation) {
  const auto shares = vertex_shares(triangle(), kFocus);
  try_move("values towards cancellation", [&](const Case& c) {
    double sum = 0;
    double sizes = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += (*shares)[i] * c.attribute_values[i];
      sizes += std::fabs((*shares)[i] * c.attribute_values[i]);
    }
    EXPECT_LT(std::fabs(sum) / sizes, 1e-6);
    EXPECT_EQ(changed_numbers(c).size(), 1U);
  });
}

TEST(CaseMoves, AValueToTheTopOfItsBinade) {
  try_move("a value to the top of its binade", [](const Case& c) {
    const auto changed = changed_numbers(c);
    ASSERT_EQ(changed.size(), 1U);
    const auto [before, after] = changed[0];
    EXPECT_EQ(std::ilogb(after), std::ilogb(before));
    EXPECT_EQ(std::ilogb(stepped(after, 8)), std::ilogb(before) + 1);
  });
}

TEST(CaseMoves, ValuesOfEqualMagnitude) {
  try_move("values of equal magnitude", [](const Case& c) {
    for (const float value : c.attribute_values) EXPECT_EQ(std::fabs(value), 3);
  });
}

TEST(CaseMoves, ValuesScaled) {
  try_move("values scaled", [](const Case& c) {
    EXPECT_FLOAT_EQ(c.attribute_values[1] / c.attribute_values[0], 2);
    EXPECT_NE(c.attribute_values[0], 1);
  });
}

// Kills: a move that makes NaN or infinity of the largest and smallest numbers, or that leaves the
// case changed although it says that it does not apply.
TEST(CaseMoves, MakeCasesThatFilesCanHold) {
  const Law* const law = find_law("values-stay-within-the-bound");
  ASSERT_NE(law, nullptr);
  for (std::uint64_t i = 0; i < 150; ++i) {
    const auto made = oracle::to_clip_case(random_case(*law, 1, i, {}).source, "");
    if (!made || made->triangles.empty()) continue;
    Draw draw(1, "test", i);
    for (const CaseMove& move : case_moves()) {
      for (const std::optional<std::uint32_t> attribute :
           {std::optional<std::uint32_t>(), std::optional<std::uint32_t>(0)}) {
        if (attribute && made->attributes.empty()) continue;
        Case c = *made;
        if (!move.change(c, {{0, 1, 1, 0}, attribute}, draw)) {
          EXPECT_EQ(c, static_cast<const Case&>(*made)) << move.name << ", case " << i;
          continue;
        }
        const Result<Case> read = cases::parse_case(cases::to_json(c), "moved");
        ASSERT_TRUE(read) << move.name << ", case " << i << ": " << to_string(read.error());
        EXPECT_EQ(*read, c) << move.name;
      }
    }
  }
}

}  // namespace
}  // namespace rastercheck::properties::case_moves_test
