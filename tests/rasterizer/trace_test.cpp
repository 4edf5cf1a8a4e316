// Traces of hand-made triangles: what is drawn, how it was decided, and which samples have no
// trace.

#include "rasterizer/trace.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "rasterizer/simd.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::trace_test {
namespace {

constexpr TargetSize kTarget{8, 8, 1};

/// A triangle (0.5, 0.5), (6.5, 0.5), (0.5, 6.5) with w = 1, 2, 4 in a target of 8 x 8. All corners
/// and the two edges along the axes lie on samples. It has one smooth, one noperspective and one
/// flat attribute.
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
                              const SamplePlace& address) {
  const TraceResult result = trace_sample(state, mesh.mesh(), size, address);
  EXPECT_EQ(result.error, std::nullopt);
  return result.trace;
}

double on_axis(const TracedAxis& axis, double at) { return axis.scale * (2 * at - axis.shift); }

double plane_at(const Trace& trace, const TracedPlane& plane, double u, double v) {
  return plane.a * on_axis(trace.frame->u, u) + (plane.b * on_axis(trace.frame->v, v) + plane.c);
}

double line_at(const Trace& trace, std::size_t i, double u, double v) {
  const TracedPlane& line = (*trace.lines)[i];
  return plane_at(trace, {line.a, line.b, line.c * trace.frame->t}, u, v);
}

void expect_weights_of_lines(const Trace& trace) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*trace.edges)[i], line_at(trace, i, trace.u, trace.v)) << i;
  }
}

/// Expects that evaluating the traced planes and lines at (u, v) gives the traced numbers, that the
/// block kernels' operations on these numbers give the evaluated number, and that the latter rounds
/// to the value.
void expect_value_of_its_parts(const Trace& trace, const TracedValue& value) {
  EXPECT_EQ(value.evaluated.has_value(), !value.shares.has_value());
  if (value.evaluated) {
    EXPECT_EQ(static_cast<float>(*value.evaluated), value.value);
  }
  ASSERT_EQ(value.numerator.has_value(), value.numerator_at.has_value());
  ASSERT_EQ(value.denominator.has_value(), value.denominator_at.has_value());
  if (value.numerator) {
    EXPECT_FALSE(value.is_exact || value.is_from_lines);
    EXPECT_EQ(*value.numerator_at, plane_at(trace, *value.numerator, value.u, value.v));
    if (value.denominator) {
      EXPECT_EQ(*value.denominator_at, plane_at(trace, *value.denominator, value.u, value.v));
      EXPECT_EQ(*value.evaluated, *value.numerator_at * (1 / *value.denominator_at));
    } else {
      EXPECT_EQ(*value.evaluated, *value.numerator_at);
    }
  }
  if (!value.weights) return;
  EXPECT_TRUE(value.is_from_lines);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*value.weights)[i], line_at(trace, i, value.u, value.v));
  }
}

/// Expects that every fragment has a trace with its values, and every other sample a trace that
/// says it is not drawn.
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
        ASSERT_TRUE(trace.has_value());
        ASSERT_EQ(trace->is_drawn, i < fragments.size()) << x << ", " << y;
        expect_weights_of_lines(*trace);
        if (!trace->is_drawn) continue;
        EXPECT_EQ(trace->depth.value, fragments.depth[i]);
        expect_value_of_its_parts(*trace, trace->depth);
        ASSERT_EQ(trace->attributes.size(), count);
        for (std::size_t a = 0; a < count; ++a) {
          EXPECT_EQ(trace->attributes[a].value, fragments.attributes[i * count + a]) << a;
          expect_value_of_its_parts(*trace, trace->attributes[a]);
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

// The doubles before the last rounding are those of the SIMD target that drew.
TEST(Trace, IsOfWhatIsDrawnOnAllVectors) {
  State state = small_state(8, 8);
  SmallMesh mesh = corner(state);
  mesh.positions[1] = at(state, 6.3F, 0.7F, 3, 0.7F);
  mesh.attributes[0] = 0.1F;
  for (const SimdTarget& target : simd_targets()) {
    const OnSimdTarget on(target.name);
    expect_traces_of_all(state, mesh, kTarget);
  }
}

TEST(Trace, SaysWhatTheLinesReceived) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 2, 1, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_TRUE(trace->is_drawn);
  EXPECT_EQ(trace->decision, Decision::in_double);
  EXPECT_FALSE(trace->corners || trace->snapped);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(trace->positions[i], mesh.positions[i]);
    EXPECT_GT((*trace->edges)[i], trace->certificate->bands[i]);
  }
  EXPECT_EQ(trace->u, 2.5);
  EXPECT_EQ(trace->v, 1.5);
  // U = |H| (2u − W), V = |W| (2v − H) and T = |W H| at (2.5, 1.5).
  EXPECT_EQ(on_axis(trace->frame->u, trace->u), -24);
  EXPECT_EQ(on_axis(trace->frame->v, trace->v), -40);
  EXPECT_EQ(trace->frame->t, 64);
}

// By hand: r/w is linear in the window. At (2.5, 1.5), a third of the way to vertex 1 and a sixth
// of the way to vertex 2, the smooth attribute is (1/2 · 1/1 + 1/3 · 2/2 + 1/6 · 5/4) / (1/2 +
// 1/3/2 + 1/6/4).
TEST(Trace, TellsTheQuotientApart) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 2, 1, 0});
  ASSERT_TRUE(trace.has_value());
  const TracedValue& smooth = trace->attributes[0];
  ASSERT_TRUE(smooth.numerator_at && smooth.denominator_at);
  const double numerator = 1.0 / 2 + 1.0 / 3 + 5.0 / 24;
  const double denominator = 1.0 / 2 + 1.0 / 6 + 1.0 / 24;
  EXPECT_NEAR(*smooth.numerator_at / *smooth.denominator_at, numerator / denominator, 0x1p-50);
  EXPECT_NEAR(*smooth.denominator_at, (*trace->edges)[0] + (*trace->edges)[1] + (*trace->edges)[2],
              0x1p-30);
  EXPECT_FALSE(trace->attributes[1].denominator.has_value());
  EXPECT_NEAR(*trace->attributes[1].numerator_at, 10.0 / 2 + 20.0 / 3 + 50.0 / 6, 0x1p-45);
  EXPECT_FALSE(trace->attributes[2].numerator.has_value());
  EXPECT_EQ(trace->attributes[2].evaluated, 7);
}

TEST(Trace, OfFloat32HasShares) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  state.precision = Precision::float32;
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 2, 1, 0});
  ASSERT_TRUE(trace.has_value());
  const auto expect_shares = [](const TracedValue& value, std::array<double, 3> expected) {
    EXPECT_TRUE(value.is_from_lines);
    ASSERT_TRUE(value.shares.has_value());
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*value.shares)[i], expected[i], 0x1p-23);
  };
  const double sum = 1.0 / 2 + 1.0 / 6 + 1.0 / 24;
  expect_shares(trace->attributes[0], {1.0 / 2 / sum, 1.0 / 6 / sum, 1.0 / 24 / sum});
  expect_shares(trace->attributes[1], {1.0 / 2, 1.0 / 3, 1.0 / 6});
  EXPECT_FALSE(trace->depth.shares.has_value());
}

// The near plane cuts two edges in the middle, so that the snapped corners are (2, 2), (6, 2), (4,
// 4) and (2, 4). The first vertex lies a quarter of a grid unit off its grid point.
TEST(Trace, OfAClippedTriangleHasCornersOfItsPart) {
  State state = small_state(8, 8);
  state.snapping = Snapping{8};
  state.basis = Basis::snapped;
  state.attributes = {{}};
  SmallMesh mesh;
  mesh.positions = {at(state, 2 + 0x1p-10F, 2, 1, 0.5F), at(state, 6, 2, 1, 0.5F),
                    at(state, 2, 6, 1, -0.5F)};
  mesh.triangles = {{0, 1, 2}};
  mesh.attributes = {1, 2, 4};
  expect_traces_of_all(state, mesh, {8, 8, 4});
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 4, 2, 0});
  ASSERT_TRUE(trace.has_value());
  ASSERT_TRUE(trace->is_drawn);
  ASSERT_TRUE(trace->corners && trace->snapped);
  const auto expect_corner = [&](std::size_t i, double x, double y, std::array<double, 3> share) {
    const TracedCorner& corner = (*trace->corners)[i];
    EXPECT_EQ(corner.x, x);
    EXPECT_EQ(corner.y, y);
    EXPECT_EQ(corner.share, share);
    EXPECT_EQ(corner.w, 1);
    EXPECT_EQ(corner.z, share[0] / 2 + share[1] / 2 - share[2] / 2);
    EXPECT_FALSE(corner.is_homogeneous);
    EXPECT_EQ((*trace->snapped)[i].x, i == 0 ? 2 : x);
    EXPECT_EQ((*trace->snapped)[i].y, y);
    EXPECT_EQ((*trace->snapped)[i].share, share);
  };
  expect_corner(0, 2 + 0x1p-10, 2, {1, 0, 0});
  expect_corner(1, 6, 2, {0, 1, 0});
  expect_corner(2, 4, 4, {0, 0.5, 0.5});
  EXPECT_FALSE(trace->attributes[0].is_from_vertices);
}

// Coverage is that of the snapped vertices, but values are those of the vertices as given.
TEST(Trace, OfTheIdealBasisHasValuesOfTheVertices) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  state.snapping = Snapping{4};
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 2, 1, 0});
  ASSERT_TRUE(trace.has_value());
  ASSERT_TRUE(trace->snapped.has_value());
  EXPECT_FALSE(trace->corners.has_value());
  EXPECT_EQ((*trace->snapped)[1].x, 6.5);
  EXPECT_EQ((*trace->snapped)[1].w, 2);
  EXPECT_TRUE(trace->depth.is_from_vertices);
  EXPECT_TRUE(trace->attributes[0].is_from_vertices);
}

TEST(Trace, SaysWhyASampleIsNotDrawn) {
  State state = small_state(8, 8);
  SmallMesh mesh = corner(state);
  const auto expect_not_drawn = [&](int x, int y, Decision decision) {
    const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, x, y, 0});
    ASSERT_TRUE(trace.has_value());
    EXPECT_FALSE(trace->is_drawn);
    EXPECT_TRUE(trace->attributes.empty());
    EXPECT_EQ(trace->u, x + 0.5);
    EXPECT_EQ(trace->v, y + 0.5);
    EXPECT_EQ(trace->positions[1], mesh.positions[1]);
    expect_weights_of_lines(*trace);
    EXPECT_EQ(trace->decision, decision) << x << ", " << y;
  };
  expect_not_drawn(5, 5, Decision::in_double);
  expect_not_drawn(6, 0, Decision::exactly);  // a corner that is not owned
  state.scissor = {{3, 0}, {5, 8}};
  expect_not_drawn(1, 1, Decision::outside);
  state.scissor = State{}.scissor;
  state.clip_distance_count = 1;
  mesh.clip_distances = {-1, 1, 1};
  expect_not_drawn(1, 1, Decision::clipped);
  state.snapping = Snapping{8};
  expect_not_drawn(1, 1, Decision::in_whole_numbers);
}

TEST(Trace, OfATriangleThatIsNotSetUpIsNothing) {
  State state = small_state(8, 8);
  SmallMesh mesh = corner(state);
  state.cull = Cull::back;
  state.front_face = FrontFace::ccw;
  EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, 2, 1, 0}).has_value());
  state.cull = Cull::none;
  mesh.positions[0].x = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, 2, 1, 0}).has_value());
  mesh.positions[0] = mesh.positions[1];
  EXPECT_FALSE(trace_of(state, mesh, kTarget, {0, 2, 1, 0}).has_value());
}

// The sample is on an edge that owns it. If double holds the edge exactly, its band is 0.
TEST(Trace, OfATieIsNotDecidedByRounding) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  const std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 3, 0, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_EQ(trace->decision, Decision::exactly);
  EXPECT_EQ((*trace->edges)[2], 0);
  EXPECT_EQ(trace->certificate->bands[2], 0);
}

TEST(Trace, OfSnappedVerticesIsDecidedInWholeNumbers) {
  State state = small_state(8, 8);
  const SmallMesh mesh = corner(state);
  state.snapping = Snapping{8};
  std::optional<Trace> trace = trace_of(state, mesh, kTarget, {0, 3, 0, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_EQ(trace->decision, Decision::in_whole_numbers);
  EXPECT_EQ(trace->frame->t, 64);  // the lines are those of the clip positions
  state.basis = Basis::snapped;
  trace = trace_of(state, mesh, kTarget, {0, 3, 0, 0});
  ASSERT_TRUE(trace.has_value());
  EXPECT_EQ(trace->decision, Decision::in_whole_numbers);
  EXPECT_EQ(on_axis(trace->frame->u, trace->u), 3.5 * 256);
  EXPECT_EQ(on_axis(trace->frame->v, trace->v), 0.5 * 256);
  EXPECT_EQ(trace->frame->t, 1);
}

// A sliver about a row of samples, about 2^-19 of a pixel high, so that its weights are differences
// of numbers a million times as large. The viewport's origin makes double round the samples'
// coordinates.
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
  EXPECT_LT((*trace->edges)[0] + (*trace->edges)[1] + (*trace->edges)[2],
            trace->certificate->least_sum);
  EXPECT_FALSE(trace->certificate->depth_is_certain);
  for (const TracedValue* value : {&trace->attributes[0], &trace->depth}) {
    EXPECT_TRUE(value->is_exact);
    EXPECT_FALSE(value->numerator || value->is_from_lines || value->weights);
    EXPECT_TRUE(value->evaluated.has_value());
  }
}

// The hypotenuse cuts pixel (3, 3), so that only some of its four samples are covered.
TEST(Trace, SaysWhereCentresAndCentroidsAre) {
  State state = small_state(8, 8);
  SmallMesh mesh = corner(state);
  state.attributes = {{{}, Location::sample}, {{}, Location::center}, {{}, Location::centroid}};
  const TargetSize size{8, 8, 4};
  const std::optional<Trace> cut = trace_of(state, mesh, size, {0, 3, 3, 0});
  ASSERT_TRUE(cut && cut->is_drawn);
  ASSERT_FALSE(trace_of(state, mesh, size, {0, 3, 3, 3})->is_drawn);
  const auto expect_at = [](const TracedValue& value, double u, double v) {
    EXPECT_EQ(value.u, u);
    EXPECT_EQ(value.v, v);
  };
  expect_at(cut->attributes[0], 3.375, 3.125);
  expect_at(cut->attributes[1], 3.5, 3.5);
  expect_at(cut->attributes[2], 3.375, 3.125);
  EXPECT_FALSE(cut->attributes[0].weights.has_value());
  EXPECT_TRUE(cut->attributes[1].weights && cut->attributes[2].weights);
  const std::optional<Trace> whole = trace_of(state, mesh, size, {0, 1, 1, 3});
  ASSERT_TRUE(whole.has_value());
  expect_at(whole->attributes[2], 1.5, 1.5);
  // With one sample per pixel, all three locations are the same.
  const std::optional<Trace> one = trace_of(state, mesh, kTarget, {0, 1, 1, 0});
  ASSERT_TRUE(one.has_value());
  EXPECT_TRUE(one->attributes[1].numerator.has_value());
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
}  // namespace rastercheck::rasterizer::trace_test
