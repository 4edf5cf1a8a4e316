// Vertices that are made by mixing other vertices are exact.

#include "properties/laws/internal/parted_triangles.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace rastercheck::properties::parted_triangles_test {
namespace {

TEST(ShortVertices, MixExactly) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    Draw draw(1, "short vertices", i);
    const cases::Case c = with_short_vertices(generate_any(draw).source);
    cases::Case mixed = c;
    for (const cases::Triangle& triangle : c.triangles) {
      for (const auto& quarters : {std::array{1, 1, 2}, std::array{3, 1, 0}}) {
        const std::uint32_t vertex = add_mixed(mixed, triangle, quarters);
        double x = 0;
        double w = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          x += quarters[k] * double{c.positions[triangle[k]].x} / 4;
          w += quarters[k] * double{c.positions[triangle[k]].w} / 4;
        }
        EXPECT_EQ(double{mixed.positions[vertex].x}, x);
        EXPECT_EQ(double{mixed.positions[vertex].w}, w);
        for (std::size_t a = 0; a < c.attributes.size(); ++a) {
          double r = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            r += quarters[k] * double{c.attributes_of(triangle[k])[a]} / 4;
          }
          EXPECT_EQ(double{mixed.attributes_of(vertex)[a]}, r);
        }
      }
    }
  }
}

}  // namespace
}  // namespace rastercheck::properties::parted_triangles_test
