#include "rasterizer/assembly.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <numeric>
#include <utility>

#include "tests/rasterizer/failing_allocator.h"

namespace rastercheck::rasterizer::assembly_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::array kConventions{Convention::opengl, Convention::vulkan, Convention::d3d};

std::vector<glm::uvec3> assembled(Topology topology, Convention convention,
                                  const std::vector<std::uint32_t>& indices) {
  std::vector<glm::uvec3> triangles;
  EXPECT_EQ(assemble(topology, indices, convention, triangles), std::nullopt);
  return triangles;
}

std::vector<std::uint32_t> first_numbers(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// The tables of the specifications, spelled out.
TEST(Assembly, MakesTheTrianglesOfAStrip) {
  const auto strip = first_numbers(6);
  for (const Convention convention : {Convention::vulkan, Convention::d3d}) {
    EXPECT_THAT(assembled(Topology::strip, convention, strip),
                ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(1, 3, 2), glm::uvec3(2, 3, 4),
                            glm::uvec3(3, 5, 4)));
  }
  EXPECT_THAT(assembled(Topology::strip, Convention::opengl, strip),
              ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(2, 1, 3), glm::uvec3(2, 3, 4),
                          glm::uvec3(4, 3, 5)));
}

TEST(Assembly, MakesTheTrianglesOfAFan) {
  const auto fan = first_numbers(5);
  for (const Convention convention : {Convention::vulkan, Convention::d3d}) {
    EXPECT_THAT(assembled(Topology::fan, convention, fan),
                ElementsAre(glm::uvec3(1, 2, 0), glm::uvec3(2, 3, 0), glm::uvec3(3, 4, 0)));
  }
  EXPECT_THAT(assembled(Topology::fan, Convention::opengl, fan),
              ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3), glm::uvec3(0, 3, 4)));
}

TEST(Assembly, TakesAListThreeByThree) {
  for (const Convention convention : kConventions) {
    EXPECT_THAT(assembled(Topology::triangles, convention, {7, 5, 6, 1, 1, 2, 8, 9}),
                ElementsAre(glm::uvec3(7, 5, 6), glm::uvec3(1, 1, 2)));
  }
}

// Neighbours in a strip or fan use their shared edge in opposite directions.
TEST(Assembly, WindsNeighboursAlike) {
  for (const Convention convention : kConventions) {
    for (const Topology topology : {Topology::strip, Topology::fan}) {
      std::map<std::pair<unsigned, unsigned>, int> edges;
      for (const glm::uvec3& t : assembled(topology, convention, first_numbers(20))) {
        for (glm::length_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
      }
      int shared = 0;
      for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        shared += edges.contains({edge.second, edge.first}) ? 1 : 0;
      }
      EXPECT_EQ(shared, 2 * 17);
    }
  }
}

TEST(Assembly, BeginsAnewAfterARestart) {
  constexpr std::uint32_t r = kRestart;
  for (const Convention convention : kConventions) {
    const bool is_last = convention == Convention::opengl;
    const glm::uvec3 odd = is_last ? glm::uvec3(2, 1, 3) : glm::uvec3(1, 3, 2);
    // After three restarts the strip begins with an even triangle, whatever came before.
    EXPECT_THAT(assembled(Topology::strip, convention, {0, 1, 2, 3, r, 8, 9, r, r, 4, 5, 6, r}),
                ElementsAre(glm::uvec3(0, 1, 2), odd, glm::uvec3(4, 5, 6)));
    const glm::uvec3 first = is_last ? glm::uvec3(0, 1, 2) : glm::uvec3(1, 2, 0);
    const glm::uvec3 second = is_last ? glm::uvec3(4, 5, 6) : glm::uvec3(5, 6, 4);
    EXPECT_THAT(assembled(Topology::fan, convention, {r, 0, 1, 2, r, 4, 5, 6}),
                ElementsAre(first, second));
    EXPECT_THAT(assembled(Topology::triangles, convention, {0, 1, r, 2, 3, 4, 5}),
                ElementsAre(glm::uvec3(2, 3, 4)));
  }
}

TEST(Assembly, MakesNothingOfLessThanThree) {
  for (const Topology topology : {Topology::triangles, Topology::strip, Topology::fan}) {
    for (const Convention convention : kConventions) {
      EXPECT_THAT(assembled(topology, convention, {}), IsEmpty());
      EXPECT_THAT(assembled(topology, convention, {3}), IsEmpty());
      EXPECT_THAT(assembled(topology, convention, {3, 4}), IsEmpty());
      EXPECT_THAT(assembled(topology, convention, {3, kRestart, 4, 5}), IsEmpty());
    }
  }
}

TEST(Assembly, MakesTheLinesOfStripsAndLists) {
  const auto lines = [](LineTopology topology, const std::vector<std::uint32_t>& indices) {
    std::vector<glm::uvec3> made;
    EXPECT_EQ(assemble_lines(topology, indices, made), std::nullopt);
    return made;
  };
  constexpr std::uint32_t r = kRestart;
  EXPECT_THAT(lines(LineTopology::strip, {4, 5, 6, r, 7, r, r, 8, 9}),
              ElementsAre(glm::uvec3(4, 5, 5), glm::uvec3(5, 6, 6), glm::uvec3(8, 9, 9)));
  EXPECT_THAT(lines(LineTopology::list, {4, 5, 6, r, 7, 8, 9, 7}),
              ElementsAre(glm::uvec3(4, 5, 5), glm::uvec3(7, 8, 8), glm::uvec3(9, 7, 7)));
  EXPECT_THAT(lines(LineTopology::strip, {}), IsEmpty());
}

TEST(Assembly, AppendsToWhatIsThere) {
  std::vector<glm::uvec3> triangles{{9, 9, 9}};
  const std::vector<std::uint32_t> indices{0, 1, 2};
  EXPECT_EQ(assemble(Topology::strip, indices, Convention::vulkan, triangles), std::nullopt);
  EXPECT_THAT(triangles, ElementsAre(glm::uvec3(9, 9, 9), glm::uvec3(0, 1, 2)));
}

TEST(Assembly, LosesNothingWhereMemoryRunsOut) {
  if (!kCanRunOutOfMemory) GTEST_SKIP() << "the sanitizer has an allocator of its own";
  std::vector<glm::uvec3> triangles{{9, 9, 9}};
  const std::vector<std::uint32_t> indices = first_numbers(1000);
  const auto call = [&] {
    return assemble(Topology::strip, indices, Convention::vulkan, triangles);
  };
  EXPECT_EQ(with_allocations(0, call), Error::out_of_memory);
  EXPECT_THAT(triangles, ElementsAre(glm::uvec3(9, 9, 9)));
  EXPECT_EQ(with_allocations(1, call), std::nullopt);
  EXPECT_EQ(triangles.size(), 999U);
}

// Drawn triangles take flat values from the vertices that the tables name.
TEST(Assembly, KeepsTheProvokingVertex) {
  const std::vector<glm::vec4> positions{{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 0, 0.5F, 1},
                                         {1, 0, 0.5F, 1},   {-1, 1, 0.5F, 1}, {1, 1, 0.5F, 1}};
  const std::vector<float> numbers{0, 1, 2, 3, 4, 5};
  for (const Convention convention : kConventions) {
    const float offset = convention == Convention::opengl ? 2.0F : 0.0F;
    const auto triangles = assembled(Topology::strip, convention, first_numbers(6));
    State state;
    state.convention = convention;
    state.viewport.size = {8, 8};
    state.attributes = {{Interpolation::flat, Location::sample}};
    Fragments fragments;
    const Mesh mesh{positions, numbers, {}, triangles};
    ASSERT_EQ(draw_fragments(state, mesh, {8, 8, 1}, fragments).error, std::nullopt);
    ASSERT_GT(fragments.size(), 0U);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      EXPECT_EQ(fragments.attributes[i], static_cast<float>(fragments.triangle[i]) + offset);
    }
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::assembly_test
