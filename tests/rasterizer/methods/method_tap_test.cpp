// Traces of samples drawn by the textbook methods: what each method draws, and what else each kind
// of method tells.

#include "rasterizer/methods/internal/method_tap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "rasterizer/methods/method.h"
#include "tests/rasterizer/methods/method_draw.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::method_tap_test {
namespace {

/// The triangle (0.5, 0.5), (6.5, 0.5), (0.5, 6.5) with w = 1, 2, 4, and a neighbour beyond its
/// hypotenuse, in 8 x 8 pixels. They have one attribute for each interpolation, and smooth ones at
/// all locations.
SmallMesh two_triangles(State& state) {
  using enum Interpolation;
  SmallMesh mesh;
  mesh.positions = {at(state, 0.5F, 0.5F, 1, 0.25F), at(state, 6.5F, 0.5F, 2, 0.5F),
                    at(state, 0.5F, 6.5F, 4, 0.75F), at(state, 7.25F, 7.75F, 3, 0.5F)};
  mesh.triangles = {{1, 3, 2}, {0, 1, 2}};
  state.attributes = {{smooth, {}},
                      {noperspective, {}},
                      {flat, {}},
                      {smooth, Location::center},
                      {smooth, Location::centroid}};
  mesh.attributes = {1, 10, 7, 1, -1, 2, 20, 8, 0, 0, 5, 50, 9, 3, 0.3F, 4, 0, 6, 9, 2};
  return mesh;
}

std::optional<Trace> trace_by(std::string_view method, const State& state, const SmallMesh& mesh,
                              const TargetSize& size, const SamplePlace& address) {
  const TraceResult result = trace_sample_by(method, state, mesh.mesh(), size, address);
  EXPECT_EQ(result.error, std::nullopt) << method;
  return result.trace;
}

void expect_values_of(const Trace& trace, const Fragments& fragments, std::size_t i) {
  EXPECT_EQ(trace.depth.value, fragments.depth[i]);
  EXPECT_EQ(static_cast<float>(trace.depth.evaluated.value()), trace.depth.value);
  const std::size_t count = trace.attributes.size();
  ASSERT_EQ(count * fragments.size(), fragments.attributes.size());
  for (std::size_t a = 0; a < count; ++a) {
    const TracedValue& value = trace.attributes[a];
    EXPECT_EQ(value.value, fragments.attributes[i * count + a]) << a;
    EXPECT_EQ(static_cast<float>(value.evaluated.value()), value.value) << a;
  }
}

/// The index of the fragment at this place, or the number of fragments if there is none.
std::size_t find(const Fragments& fragments, const SamplePlace& at) {
  std::size_t i = 0;
  while (i < fragments.size() && (fragments.triangle[i] != at.triangle || fragments.x[i] != at.x ||
                                  fragments.y[i] != at.y || fragments.sample[i] != at.sample)) {
    ++i;
  }
  return i;
}

// Kills: a trace of another triangle, sample or attribute than the one drawn.
TEST(MethodTap, IsShownWhatEachMethodDraws) {
  State state = small_state(8, 8);
  const SmallMesh mesh = two_triangles(state);
  const TargetSize size{8, 8, 4};
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    const Fragments fragments = drawn_by(method.name, state, mesh, size);
    ASSERT_GT(fragments.size(), 0U);
    for (int i = 0; i < 8 * 8 * 4; ++i) {
      const SamplePlace address{static_cast<std::uint32_t>(i % 2), i / 32, i / 4 % 8, i % 4};
      const std::optional<Trace> trace = trace_by(method.name, state, mesh, size, address);
      ASSERT_TRUE(trace.has_value());
      const std::size_t at = find(fragments, address);
      ASSERT_EQ(trace->is_drawn, at < fragments.size());
      if (trace->is_drawn) expect_values_of(*trace, fragments, at);
    }
  }
}

void expect_vertices(const Trace& trace, const SmallMesh& mesh, bool is_homogeneous) {
  ASSERT_TRUE(trace.corners.has_value());
  const std::array<double, 3> u{0.5, 6.5, 0.5};
  const std::array<double, 3> v{0.5, 0.5, 6.5};
  for (std::size_t i = 0; i < 3; ++i) {
    const TracedCorner& corner = (*trace.corners)[i];
    const glm::vec4& p = mesh.positions[i];
    EXPECT_EQ(trace.positions[i], p);
    EXPECT_EQ(corner.is_homogeneous, is_homogeneous);
    EXPECT_EQ(corner.x, is_homogeneous ? u[i] * p.w : u[i]);
    EXPECT_EQ(corner.y, is_homogeneous ? v[i] * p.w : v[i]);
    EXPECT_EQ(corner.z, p.z);
    EXPECT_EQ(corner.w, p.w);
    std::array<double, 3> share{};
    share[i] = 1;
    EXPECT_EQ(corner.share, share);
  }
}

TEST(MethodTap, IsShownHomogeneousWindowCoordinatesByFormulas) {
  State state = small_state(8, 8);
  const SmallMesh mesh = two_triangles(state);
  const auto trace = trace_by("clipless-homogeneous", state, mesh, {8, 8, 1}, {1, 2, 1, 0});
  ASSERT_TRUE(trace.has_value());
  expect_vertices(*trace, mesh, true);
  EXPECT_TRUE(trace->lines && trace->edges);
  // Values that are not smooth come from draw_fragments, which knows no window coordinates.
  EXPECT_FALSE(trace->attributes[0].is_from_vertices);
  EXPECT_TRUE(trace->attributes[1].is_from_vertices && trace->depth.is_from_vertices);
  EXPECT_TRUE(trace->attributes[1].numerator_at && trace->depth.numerator_at);
}

TEST(MethodTap, IsShownWindowPositionsByScans) {
  State state = small_state(8, 8);
  SmallMesh mesh = two_triangles(state);
  auto trace = trace_by("rational-linear", state, mesh, {8, 8, 1}, {1, 2, 1, 0});
  ASSERT_TRUE(trace.has_value());
  expect_vertices(*trace, mesh, false);
  EXPECT_EQ(trace->decision, Decision::by_span);
  EXPECT_FALSE(trace->frame || trace->lines || trace->edges);
  // The part of a triangle that clipping leaves has corners that are not vertices.
  mesh.positions[2].z = -1;
  trace = trace_by("rational-linear", state, mesh, {8, 8, 1}, {1, 2, 1, 0});
  ASSERT_TRUE(trace && trace->is_drawn);
  EXPECT_FALSE(trace->corners.has_value());
}

// By hand at (2.5, 1.5), a third of the way to vertex 1 and a sixth of the way to vertex 2. The
// value rounded to float32 is farther off.
TEST(MethodTap, IsShownWhatAFormulaMadeBeforeItIsRounded) {
  State state = small_state(8, 8);
  const SmallMesh mesh = two_triangles(state);
  const double expected = (1.0 / 2 + 1.0 / 3 + 5.0 / 24) / (1.0 / 2 + 1.0 / 6 + 1.0 / 24);
  for (const char* method : {"rational-linear", "edge-then-span", "q-matrix", "equal-w"}) {
    const auto trace = trace_by(method, state, mesh, {8, 8, 1}, {1, 2, 1, 0});
    ASSERT_TRUE(trace.has_value());
    const TracedValue& value = trace->attributes[0];
    EXPECT_NEAR(*value.evaluated, expected, 0x1p-48) << method;
    EXPECT_GT(std::abs(value.value - expected), 0x1p-48) << method;
  }
}

// The hypotenuse of triangle 1 cuts pixel (3, 3): the pixel's centre lies on it, and the sample at
// (3.375, 3.125) inside. The centre of pixel (4, 3) lies beyond it.
TEST(MethodTap, IsShownWhereCentresAndCentroidsAre) {
  State state = small_state(8, 8);
  const SmallMesh mesh = two_triangles(state);
  for (const char* method : {"rational-linear", "q-matrix"}) {
    const auto trace = trace_by(method, state, mesh, {8, 8, 4}, {1, 3, 3, 0});
    ASSERT_TRUE(trace && trace->is_drawn) << method;
    const auto expect_at = [&](std::size_t attribute, double u, double v) {
      EXPECT_EQ(trace->attributes[attribute].u, u) << method;
      EXPECT_EQ(trace->attributes[attribute].v, v) << method;
    };
    EXPECT_EQ(trace->u, 3.375);
    EXPECT_EQ(trace->v, 3.125);
    expect_at(0, 3.375, 3.125);
    expect_at(3, 3.5, 3.5);
    expect_at(4, 3.375, 3.125);
  }
  // The centre is not on its row's span, so its value comes from the plane of the clip positions.
  const auto trace = trace_by("rational-linear", state, mesh, {8, 8, 4}, {1, 3, 3, 0});
  EXPECT_TRUE(trace->attributes[3].is_from_vertices);
  EXPECT_FALSE(trace->attributes[4].is_from_vertices);
}

// The value of scanline-linear at centres depends on whether another triangle is clipped.
TEST(MethodTap, IsShownTheTriangleAmongTheOthers) {
  State state = small_state(8, 8);
  SmallMesh mesh = two_triangles(state);
  mesh.positions[3].z = -1;
  const TargetSize size{8, 8, 4};
  const Fragments fragments = drawn_by("scanline-linear", state, mesh, size);
  const SamplePlace address{1, 3, 3, 0};
  const auto trace = trace_by("scanline-linear", state, mesh, size, address);
  ASSERT_TRUE(trace && trace->is_drawn);
  expect_values_of(*trace, fragments, find(fragments, address));
}

TEST(MethodTap, OfABadAddressOrMethodIsRefusedOrNothing) {
  State state = small_state(8, 8);
  const SmallMesh mesh = two_triangles(state);
  const auto error_of = [&](std::string_view method, const SamplePlace& address) {
    return trace_sample_by(method, state, mesh.mesh(), {8, 8, 1}, address).error;
  };
  EXPECT_EQ(error_of("no-method", {}), Error::unknown_method);
  EXPECT_EQ(error_of("q-matrix", {2, 0, 0, 0}), Error::index);
  EXPECT_FALSE(trace_by("q-matrix", state, mesh, {8, 8, 1}, {0, 8, 0, 0}).has_value());
  state.cull = Cull::back;
  state.front_face = FrontFace::ccw;
  for (const char* method : {"rational-linear", "q-matrix"}) {
    EXPECT_FALSE(trace_by(method, state, mesh, {8, 8, 1}, {1, 2, 1, 0}).has_value()) << method;
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::method_tap_test
