#include "backends/indexed_draw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace rastercheck::backends::indexed_draw_test {
namespace {

using cases::Topology;
using testing::ElementsAre;

constexpr std::uint32_t kR = cases::kRestart;

cases::Case case_of(cases::Primitive primitive, cases::Rules rules) {
  cases::Case c;
  c.primitive = primitive;
  c.rules = rules;
  c.positions.resize(6);
  return c;
}

IndexedDraw draw_of(cases::Primitive primitive, cases::Rules rules, Topology topology,
                    const std::vector<std::uint32_t>& indices) {
  return indexed_draw(case_of(primitive, rules), topology, indices).value();
}

/// The numbers in the order of the indices.
std::vector<float> numbers_of(const IndexedDraw& draw) {
  std::vector<float> numbers;
  for (const std::uint32_t place : draw.order) {
    if (place != kR) numbers.push_back(draw.numbers[place]);
  }
  return numbers;
}

// Kills: indices that count up, with which a driver may ignore them.
TEST(IndexedDraw, HasAPlaceForEachIndex) {
  const IndexedDraw draw = draw_of(cases::Primitive::triangles, cases::Rules::vulkan,
                                   Topology::strip, {5, 0, 5, kR, 2, 1, 3});
  EXPECT_THAT(draw.order, ElementsAre(5, 4, 3, kR, 2, 1, 0));
  EXPECT_THAT(draw.vertices, ElementsAre(3, 1, 2, 5, 0, 5));
  using cases::Triangle;
  EXPECT_THAT(draw.primitives, ElementsAre(Triangle{5, 0, 5}, Triangle{2, 1, 3}));
}

// The tables of provoking vertices (OpenGL 4.6, table 13.2; Vulkan 1.3, section 20.1): triangle i
// of a strip is provoked by vertex i, or i + 2 of OpenGL's; of a fan by i + 1, or i + 2.
TEST(IndexedDraw, NumbersTheProvokingVertices) {
  using cases::Primitive;
  using cases::Rules;
  const std::vector<std::uint32_t> all{0, 1, 2, 3, 4};
  const auto numbers = [&all](Primitive primitive, Rules rules, Topology topology) {
    return numbers_of(draw_of(primitive, rules, topology, all));
  };
  EXPECT_THAT(numbers(Primitive::triangles, Rules::vulkan, Topology::strip),
              ElementsAre(1, 2, 3, 0, 0));
  EXPECT_THAT(numbers(Primitive::triangles, Rules::opengl, Topology::strip),
              ElementsAre(0, 0, 1, 2, 3));
  EXPECT_THAT(numbers(Primitive::triangles, Rules::vulkan, Topology::fan),
              ElementsAre(0, 1, 2, 3, 0));
  EXPECT_THAT(numbers(Primitive::triangles, Rules::opengl, Topology::fan),
              ElementsAre(0, 0, 1, 2, 3));
  EXPECT_THAT(numbers(Primitive::triangles, Rules::opengl, Topology::triangles),
              ElementsAre(0, 0, 1, 0, 0));
  EXPECT_THAT(numbers(Primitive::lines, Rules::vulkan, Topology::strip),
              ElementsAre(1, 2, 3, 4, 0));
  EXPECT_THAT(numbers(Primitive::lines, Rules::opengl, Topology::triangles),
              ElementsAre(0, 1, 0, 2, 0));
}

TEST(IndexedDraw, RefusesWhatThereIsNot) {
  const std::vector<std::uint32_t> beyond{0, 1, 6};
  const auto no_vertex =
      indexed_draw(case_of(cases::Primitive::lines, cases::Rules::vulkan), Topology::strip, beyond);
  ASSERT_FALSE(no_vertex);
  EXPECT_NE(no_vertex.error().failure, Failure::unsupported);
  for (const auto& [primitive, topology] :
       {std::pair(cases::Primitive::lines, Topology::fan),
        std::pair(cases::Primitive::points, Topology::triangles)}) {
    const auto none = indexed_draw(case_of(primitive, cases::Rules::vulkan), topology, {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().failure, Failure::unsupported);
  }
}

TEST(IndexedDraw, HasRunsBetweenRestarts) {
  const std::vector<std::uint32_t> order{kR, 3, 2, kR, kR, 1, kR};
  const auto runs = runs_of(order);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_THAT(runs[0], ElementsAre(3, 2));
  EXPECT_THAT(runs[1], ElementsAre(1));
  EXPECT_TRUE(runs_of({}).empty());
}

}  // namespace
}  // namespace rastercheck::backends::indexed_draw_test
