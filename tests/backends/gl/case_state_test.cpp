#include "backends/gl/internal/case_state.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace rastercheck::backends::gl::case_state_test {
namespace {

TEST(CaseState, PutsVerticesInOrder) {
  cases::Case c;
  c.attributes.resize(1);
  c.positions = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}};
  c.attribute_values = {20, 21, 22};
  c.clip_distance_count = 1;
  c.clip_distances = {30, 31, 32};
  c.triangles = {{2, 0, 1}};
  Capabilities has;
  has.max_clip_distances = 8;
  Pass pass(2);
  pass[1] = {{}, {0}, 1};
  const std::vector<float> corner2 = {9, 10, 11, 12, 0, 0, 0, 0, 22, 0, 0,
                                      0, 32, 1,  1,  1, 1, 1, 1, 1,  1};
  const std::vector<float> all = vertices_of(has, c, c.triangles, pass);
  ASSERT_EQ(all.size(), 3 * corner2.size());
  EXPECT_EQ(std::vector(all.begin(), all.begin() + 21), corner2);
  EXPECT_EQ(all[21], 1);
  EXPECT_EQ(all[42 + 8], 21);
}

TEST(CaseState, PutsEachVertexOfLinesAndPointsOnce) {
  cases::Case c;
  c.positions = {{1, 2, 3, 4}, {5, 6, 7, 8}};
  c.primitive = cases::Primitive::lines;
  c.triangles = {{0, 1, 1}, {1, 0, 0}};
  EXPECT_EQ(vertices_of({}, c, c.triangles, {}),
            (std::vector<float>{1, 2, 3, 4, 1, 5, 6, 7, 8, 1, 5, 6, 7, 8, 2, 1, 2, 3, 4, 2}));
  c.primitive = cases::Primitive::points;
  c.triangles = {{1, 1, 1}};
  EXPECT_EQ(vertices_of({}, c, c.triangles, {}), (std::vector<float>{5, 6, 7, 8, 1}));
}

// Kills: a number at each vertex of its primitive, where a driver that lets another one provoke
// would draw the same.
TEST(CaseState, NumbersOnlyTheVerticesThatProvoke) {
  cases::Case c;
  c.positions = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}};
  c.primitive = cases::Primitive::lines;
  const std::vector<std::uint32_t> strip{2, 0, cases::kRestart, 1, 0};
  c.rules = cases::Rules::opengl;
  const IndexedDraw last = indexed_draw(c, cases::Topology::strip, strip).value();
  // The last index comes first.
  EXPECT_EQ(vertices_of({}, c, last, {}),
            (std::vector<float>{1, 2, 3, 4, 2, 5, 6, 7, 8, 0, 1, 2, 3, 4, 1, 9, 10, 11, 12, 0}));
}

}  // namespace
}  // namespace rastercheck::backends::gl::case_state_test
