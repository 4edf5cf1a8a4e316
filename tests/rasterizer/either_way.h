#pragma once

// Tests that must pass however a mesh is drawn: each is run with the rasterizer's own way of
// drawing and with the textbook method rational-linear.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>

#include "rasterizer/methods/method.h"
#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer {

/// The parameter is the name of a method; an empty name stands for the rasterizer's own way. The
/// members hide the free functions of the same names, which always draw in the rasterizer's own
/// way.
class EitherWay : public ::testing::TestWithParam<std::string_view> {
 public:
  static auto ways() { return ::testing::Values(std::string_view(), "rational-linear"); }

  static std::string way_name(const ::testing::TestParamInfo<std::string_view>& info) {
    return info.param.empty() ? "OwnWay" : "TextbookMethod";
  }

 protected:
  static DrawResult draw_fragments(const State& state, const Mesh& mesh, const TargetSize& size,
                                   Fragments& fragments) {
    return GetParam().empty() ? rasterizer::draw_fragments(state, mesh, size, fragments)
                              : draw_fragments_by(GetParam(), state, mesh, size, fragments);
  }

  static Fragments fragments_of(const State& state, const SmallMesh& mesh, const TargetSize& size) {
    Fragments fragments;
    EXPECT_EQ(draw_fragments(state, mesh.mesh(), size, fragments).error, std::nullopt);
    return fragments;
  }

  static Rows picture(const Fragments& fragments, const TargetSize& size) {
    return rasterizer::picture(fragments, size);
  }

  static Rows picture(const State& state, const SmallMesh& mesh, const TargetSize& size) {
    return picture(fragments_of(state, mesh, size), size);
  }
};

}  // namespace rastercheck::rasterizer
