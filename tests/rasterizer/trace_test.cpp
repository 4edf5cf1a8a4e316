// Traces of triangles made by hand: what is drawn, how it was decided, and what has none.

#include "rasterizer/trace.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer {
namespace {

constexpr TargetSize kTarget{8, 8, 1};

/// (0.5, 0.5), (6.5, 0.5), (0.5, 6.5) in a target of 8 x 8: all corners and the two edges along the
/// axes lie on samples; w = 1, 2, 4. Attributes: one smooth, one noperspective, one flat.
SmallMesh corner(State& state) {
  using enum Interpolation;
  SmallMesh mesh;
  mesh.positions = {at(state, 0.5F, 0.5F, 1, 0.25F), at(state, 6.5F, 0.5F, 2, 0.5F),
                    at(state, 0.5F, 6.5F, 4, 0.75F)};
  mesh.triangles = {{0, 1, 2}};
  state.attributes = {{smooth, {}}, {noperspective, {}}, {flat, {}}};
  mesh.attributes = {1, 10, 7, 2, 20, 8, 5, 50, 9};
  return mesh;
}

std::optional<Trace> trace_of(const State& state, const SmallMesh& mesh, const TargetSize& size,
                              const SampleAddress& address) {
  const TraceResult result = trace_sample(state, mesh.mesh(), size, address);
  EXPECT_EQ(result.error, std::nullopt);
  return result.trace;
}

void expect_weights_of_edges(const Trace& trace) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [a, b, c] = trace.edges.coefficients[i];
    const auto& [u, v, t] = trace.place;
    EXPECT_EQ(trace.weights[i], a * u + (b * v + c * t)) << i;
  }
}

/// Every fragment has a trace of its values, and every other sample has none.
void expect_traces_of_all(const State& state, const SmallMesh& mesh, const TargetSize& size) {
  const Fragments fragments = fragments_of(state, mesh, size);
  ASSERT_GT(fragments.size(), 0U);
  const std::size_t count = state.attributes.size();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (int s = 0; s < size.samples; ++s) {
        std::size_t i = 0;
        while (i < fragments.size() &&
               (fragments.x[i] != x || fragments.y[i] != y || fragments.sample[i] != s)) {
          ++i;
        }
        const std::optional<Trace> trace = trace_of(state, mesh, size, {0, x, y, s});
        ASSERT_EQ(trace.has_value(), i < fragments.size()) << x << ", " << y;
        if (!trace) continue;
        expect_weights_of_edges(*trace);
        EXPECT_EQ(trace->depth.value, fragments.depth[i]);
        ASSERT_EQ(trace->attributes.size(), count);
        for (std::size_t a = 0; a < count; ++a) {
          EXPECT_EQ(trace->attributes[a].value, fragments.attributes[i * count + a]) << a;
        }
      }
    }
  }
}

TEST(Trace, IsOfWhatIsDrawn) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    State state = small_state(8, 8, convention);
    const SmallMesh mesh = corner(state);
    expect_traces_of_all(state, mesh, kTarget);
    expect_traces_of_all(state, mesh, {8, 8, 4});
    state.precision = Precision::float32;
    expect_traces_of_all(state, mesh, kTarget);
    state.snapping = Snapping{4};
    expect_traces_of_all(state, mesh, {8, 8, 8});
    state.basis = Basis::snapped;
    expect_traces_of_all(state, mesh, {8, 8, 8});
  }
}

TEST(Trace, SaysWhatTheEdgesReceived) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 2, 1, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_EQ(trace->decision, Decision::in_double);
  EXPECT_FALSE(trace->edges.is_snapped);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(trace->edges.positions[i], mesh.positions[i]);
    EXPECT_GT(trace->weights[i], trace->edges.bands[i]);
  }
  // U = |H| (2u − W), V = |W| (2v − H), T = |W H| at (2.5, 1.5).
  EXPECT_EQ(trace->place, (std::array<double, 3>{-24, -40, 64}));
}

TEST(Trace, IsNotOfWhatIsNotCovered) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, 6, 6, 0}).has_value());
  EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, 6, 0, 0}).has_value());  // a corner, not owned
  state.cull = Cull::back;
  state.front_face = FrontFace::ccw;
  EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, 2, 1, 0}).has_value());
}

// On an edge that owns it. Where double holds the edge exactly its band is 0.
TEST(Trace, OfATieIsNotDecidedByRounding) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 3, 0, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_EQ(trace->decision, Decision::exactly);
  EXPECT_EQ(trace->weights[2], 0);
  EXPECT_EQ(trace->edges.bands[2], 0);
}

TEST(Trace, OfSnappedVerticesIsDecidedInWholeNumbers) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  state.snapping = Snapping{8};
  std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 3, 0, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_EQ(trace->decision, Decision::in_whole_numbers);
  EXPECT_FALSE(trace->edges.is_snapped);  // values are those of the clip positions
  state.basis = Basis::snapped;
  trace = trace_of(state, mesh, kTarget, {0, 3, 0, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_EQ(trace->decision, Decision::in_whole_numbers);
  EXPECT_TRUE(trace->edges.is_snapped);
  EXPECT_EQ(trace->place, (std::array<double, 3>{3.5 * 256, 0.5 * 256, 1}));
}

// A sliver about a row of samples, 2^-19 of a pixel high: its weights are differences of numbers a
// million times as large. The viewport begins where double rounds the samples' coordinates.
TEST(Trace, OfASliverSaysThatDoubleWasNotEnough) {
  State state = small_state(8, 8);
  state.attributes = {{}};
  SmallMesh mesh;
  mesh.positions = {at(state, 0.1F, 3.5F - 0x1p-20F, 1), at(state, 7.9F, 3.5F - 0x1p-21F, 1.3F),
                    at(state, 7.7F, 3.5F + 0x1p-19F, 0.7F, 0.5F)};
  mesh.triangles = {{0, 1, 2}};
  mesh.attributes = {1, -2, 3};
  state.viewport.origin.x = 0.001F;
  expect_traces_of_all(state, mesh, kTarget);
  const Fragments fragments = fragments_of(state, mesh, kTarget);
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, fragments.x[0], 3, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_LT(trace->weights[0] + trace->weights[1] + trace->weights[2], trace->edges.least_sum);
  EXPECT_TRUE(trace->attributes[0].is_exact);
  EXPECT_FALSE(trace->edges.depth_is_certain);
  EXPECT_TRUE(trace->depth.is_exact);
}

// Pixel (3, 2) is cut by the hypotenuse: of its four samples some are covered.
TEST(Trace, SaysWhereCentresAndCentroidsAre) {
  State state = small_state(8, 8);
  SmallMesh mesh = corner(state);
  state.attributes = {{{}, Location::sample}, {{}, Location::center}, {{}, Location::centroid}};
  const TargetSize size{8, 8, 4};
  const std::optional<Trace> cut = trace_of(state, mesh, size, {0, 3, 3, 0});
  ASSERT_TRUE(cut.has_value());  // (3.375, 3.125)
  ASSERT_FALSE(trace_of(state, mesh, size, {0, 3, 3, 3}).has_value());
  EXPECT_TRUE(cut->attributes[0].is_at_sample);
  EXPECT_FALSE(cut->attributes[1].is_at_sample);
  EXPECT_EQ(cut->attributes[1].u, 3.5);
  EXPECT_EQ(cut->attributes[1].v, 3.5);
  EXPECT_FALSE(cut->attributes[2].is_at_sample);
  EXPECT_EQ(cut->attributes[2].u, 3.375);
  EXPECT_EQ(cut->attributes[2].v, 3.125);
  const std::optional<Trace> whole = trace_of(state, mesh, size, {0, 1, 1, 3});
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(whole->attributes[2].u, 1.5);
  EXPECT_EQ(whole->attributes[2].v, 1.5);
  // With one sample a pixel all three are the same place.
  const std::optional<Trace> one = trace_of(state, mesh, kTarget, {0, 1, 1, 0});
  ASSERT_TRUE(one.has_value());
  EXPECT_TRUE(one->attributes[1].is_at_sample);
}

TEST(Trace, OfABadAddressIsRefusedOrNothing) {
  State state = small_state(8, 8);
  SmallMesh mesh = corner(state);
  EXPECT_EQ(trace_sample(state, mesh.mesh(), kTarget, {1, 0, 0, 0}).error, Error::index);
  constexpr int kLeast = std::numeric_limits<int>::min();
  constexpr int kMost = std::numeric_limits<int>::max();
  for (const int outside : {-1, 8, kLeast, kMost}) {
    EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, outside, 1, 0}).has_value());
    EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, 1, outside, 0}).has_value());
    EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, 1, 1, outside}).has_value());
  }
  EXPECT_EQ(trace_sample(state, mesh.mesh(), {8, 8, 3}, {}).error, Error::sample_count);
  mesh.triangles[0].z = 3;
  EXPECT_EQ(trace_sample(state, mesh.mesh(), kTarget, {}).error, Error::index);
}

}  // namespace
}  // namespace rastercheck::rasterizer
