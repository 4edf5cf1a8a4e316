#pragma once

// Small draws by textbook methods, for their tests.

#include <gtest/gtest.h>

#include <optional>
#include <string_view>

#include "rasterizer/methods/method.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer {

inline Fragments drawn_by(std::string_view method, const State& state, const SmallMesh& mesh,
                          const TargetSize& size) {
  Fragments fragments;
  EXPECT_EQ(draw_fragments_by(method, state, mesh.mesh(), size, fragments).error, std::nullopt)
      << method;
  return fragments;
}

/// A mesh with this many smooth attributes at sample locations; `values` is [vertex][attribute].
inline SmallMesh with_attributes(State& state, SmallMesh mesh, std::size_t count,
                                 std::vector<float> values) {
  state.attributes.assign(count, Qualifier{});
  mesh.attributes = std::move(values);
  return mesh;
}

/// The operations of a method that find_method() knows.
inline OperationCounts operations_of(std::string_view method) {
  return find_method(method)->operations();
}

}  // namespace rastercheck::rasterizer
