#include <gtest/gtest.h>

#include <string_view>

#include "rasterizer/methods/method.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::methods_test {
namespace {

bool is_registered(std::string_view name) {
  for (const Method& method : methods()) {
    if (method.name == name) return true;
  }
  return false;
}

// Kills: an order that depends on the linker's order of initialisation; a name used twice.
TEST(Methods, AreSortedByNamesThatDiffer) {
  for (std::size_t i = 1; i < methods().size(); ++i) {
    EXPECT_LT(methods()[i - 1].name, methods()[i].name);
  }
}

TEST(Methods, SayWhereTheyComeFromAndWhereTheyFail) {
  ASSERT_FALSE(methods().empty());
  for (const Method& method : methods()) {
    EXPECT_FALSE(method.source.empty()) << method.name;
    EXPECT_FALSE(method.fails.empty()) << method.name;
    EXPECT_NE(method.draw, nullptr) << method.name;
    EXPECT_NE(method.promise, nullptr) << method.name;
    EXPECT_NE(method.operations, nullptr) << method.name;
  }
}

TEST(Methods, RationalLinearIsOneOfThem) { EXPECT_TRUE(is_registered("rational-linear")); }

TEST(Methods, AnUnknownNameIsAnErrorAndDrawsNothing) {
  const State state = small_state(4, 4);
  const SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  Fragments fragments;
  for (const std::string_view name : {"", "rational", "rational-linear ", "Rational-linear"}) {
    EXPECT_EQ(draw_fragments_by(name, state, mesh.mesh(), {4, 4, 1}, fragments).error,
              Error::unknown_method);
  }
  EXPECT_EQ(fragments.size(), 0U);
}

TEST(Methods, CheckTheirArguments) {
  const State state = small_state(4, 4);
  SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  mesh.triangles[0].y = 3;
  for (const Method& method : methods()) {
    Fragments fragments;
    EXPECT_EQ(draw_fragments_by(method.name, state, mesh.mesh(), {4, 4, 1}, fragments).error,
              Error::index);
    EXPECT_EQ(draw_fragments_by(method.name, state, mesh.mesh(), {4, 4, 3}, fragments).error,
              Error::sample_count);
    EXPECT_EQ(fragments.size(), 0U);
  }
}

TEST(Methods, DrawWhatAPlainTriangleCovers) {
  const State state = small_state(4, 4);
  const SmallMesh mesh = triangle(state, {0, 0}, {4.25F, 0}, {0, 4.25F});
  for (const Method& method : methods()) {
    Fragments fragments;
    const DrawResult result =
        draw_fragments_by(method.name, state, mesh.mesh(), {4, 4, 1}, fragments);
    EXPECT_EQ(result.error, std::nullopt);
    EXPECT_EQ(picture(fragments, {4, 4, 1}), (Rows{"####", "###.", "##..", "#..."})) << method.name;
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::methods_test
