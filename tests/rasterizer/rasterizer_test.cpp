#include "rasterizer/rasterizer.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <random>
#include <set>
#include <string_view>
#include <tuple>
#include <vector>

#include "tests/rasterizer/failing_allocator.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::rasterizer_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr TargetSize kFour{4, 4, 1};

/// Two attributes and one clip distance per vertex, so that every argument can be made wrong.
struct Arguments {
  State state = small_state(4, 4);
  SmallMesh mesh;
  TargetSize size = kFour;

  Arguments() {
    state.attributes.resize(2);
    state.clip_distance_count = 1;
    mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
    mesh.attributes = {1, 2, 3, 4, 5, 6};
    mesh.clip_distances = {1, 1, 1};
  }

  /// The error of draw_fragments. If there is one, expects that nothing was drawn.
  std::optional<Error> error() const {
    Fragments fragments = before();
    const DrawResult result = draw_fragments(state, mesh.mesh(), size, fragments);
    if (result.error) {
      EXPECT_EQ(fragments.triangle, before().triangle);
      EXPECT_EQ(fragments.attributes, before().attributes);
      EXPECT_EQ(fragments.derivatives, before().derivatives);
      EXPECT_EQ(result.counts, DrawCounts{});
    }
    return result.error;
  }

  static Fragments before() { return {{7}, {1}, {2}, {0}, {0.5F}, {8, 9}, {4, 5, 6, 7}}; }
};

TEST(DrawFragments, GoodArgumentsAreNoError) { EXPECT_EQ(Arguments().error(), std::nullopt); }

TEST(DrawFragments, AWidthOrHeightBeyondItsRangeIsAnError) {
  for (const int bad : {0, -1, kMaxSize + 1, std::numeric_limits<int>::min()}) {
    Arguments wide;
    wide.size.width = bad;
    EXPECT_EQ(wide.error(), Error::target_size) << bad;
    Arguments high;
    high.size.height = bad;
    EXPECT_EQ(high.error(), Error::target_size) << bad;
  }
  Arguments largest;
  largest.size = {kMaxSize, kMaxSize, 1};
  EXPECT_EQ(largest.error(), std::nullopt);
}

TEST(DrawFragments, OnlyTheStandardSampleCountsAreTaken) {
  const std::set<int> good{1, 2, 4, 8, 16};
  for (int samples = -1; samples <= 33; ++samples) {
    Arguments arguments;
    arguments.size.samples = samples;
    const auto expected =
        good.contains(samples) ? std::nullopt : std::optional(Error::sample_count);
    EXPECT_EQ(arguments.error(), expected) << samples;
  }
}

TEST(DrawFragments, AViewportThatIsNotFiniteIsAnError) {
  for (const float bad : {kInfinity, -kInfinity, kNan}) {
    for (int i = 0; i < 4; ++i) {
      Arguments arguments;
      Viewport& viewport = arguments.state.viewport;
      (i < 2 ? viewport.origin : viewport.size)[i % 2] = bad;
      EXPECT_EQ(arguments.error(), Error::viewport) << i;
    }
  }
}

TEST(DrawFragments, ADepthOutsideZeroToOneIsAnError) {
  for (const float bad : {-0.001F, 1.001F, kInfinity, kNan}) {
    Arguments least;
    least.state.viewport.min_depth = bad;
    EXPECT_EQ(least.error(), Error::viewport) << bad;
    Arguments greatest;
    greatest.state.viewport.max_depth = bad;
    EXPECT_EQ(greatest.error(), Error::viewport) << bad;
  }
  Arguments reversed;
  reversed.state.viewport.min_depth = 1;
  reversed.state.viewport.max_depth = 0;
  EXPECT_EQ(reversed.error(), std::nullopt);
}

TEST(DrawFragments, ADepthBiasThatIsNotFiniteIsAnError) {
  for (const float bad : {kInfinity, -kInfinity, kNan}) {
    for (const auto member : {&DepthBias::constant, &DepthBias::slope, &DepthBias::clamp}) {
      Arguments arguments;
      arguments.state.depth_bias.*member = bad;
      EXPECT_EQ(arguments.error(), Error::depth_bias);
    }
  }
}

TEST(DrawFragments, ANegativeScissorSizeIsAnErrorAndANegativeOriginIsNot) {
  Arguments narrow;
  narrow.state.scissor.size.x = -1;
  EXPECT_EQ(narrow.error(), Error::scissor);
  Arguments low;
  low.state.scissor.size.y = -1;
  EXPECT_EQ(low.error(), Error::scissor);
  Arguments far;
  far.state.scissor.origin = {std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
  far.state.scissor.size = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  EXPECT_EQ(far.error(), std::nullopt);
}

TEST(DrawFragments, TooManyAttributesOrClipDistancesAreAnError) {
  Arguments attributes;
  attributes.state.attributes.resize(kMaxAttributes);
  attributes.mesh.attributes.resize(3 * kMaxAttributes);
  EXPECT_EQ(attributes.error(), std::nullopt);
  attributes.state.attributes.resize(kMaxAttributes + 1);
  attributes.mesh.attributes.resize(3 * (kMaxAttributes + 1));
  EXPECT_EQ(attributes.error(), Error::attribute_count);

  Arguments distances;
  distances.state.clip_distance_count = kMaxClipDistances;
  distances.mesh.clip_distances.resize(3 * kMaxClipDistances);
  EXPECT_EQ(distances.error(), std::nullopt);
  distances.state.clip_distance_count = kMaxClipDistances + 1;
  distances.mesh.clip_distances.resize(3 * (kMaxClipDistances + 1));
  EXPECT_EQ(distances.error(), Error::clip_distance_count);
}

TEST(DrawFragments, ArraysThatDoNotFitTheVerticesAreAnError) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{5}, std::size_t{7}}) {
    Arguments arguments;
    arguments.mesh.attributes.resize(count);
    EXPECT_EQ(arguments.error(), Error::attribute_values) << count;
  }
  for (const std::size_t count : {std::size_t{0}, std::size_t{2}, std::size_t{4}}) {
    Arguments arguments;
    arguments.mesh.clip_distances.resize(count);
    EXPECT_EQ(arguments.error(), Error::clip_distance_values) << count;
  }
}

// Kills: indices that are checked only while triangles are drawn.
TEST(DrawFragments, AnIndexBeyondThePositionsIsAnErrorBeforeAnythingIsDrawn) {
  for (int corner = 0; corner < 3; ++corner) {
    Arguments arguments;
    arguments.mesh.triangles.push_back({0, 1, 2});
    arguments.mesh.triangles[1][corner] = 3;
    EXPECT_EQ(arguments.error(), Error::index) << corner;
    arguments.mesh.triangles[1][corner] = std::numeric_limits<std::uint32_t>::max();
    EXPECT_EQ(arguments.error(), Error::index) << corner;
  }
}

TEST(DrawFragments, AppendsBehindWhatIsThere) {
  const Arguments arguments;
  Fragments fragments = Arguments::before();
  const DrawResult result =
      draw_fragments(arguments.state, arguments.mesh.mesh(), arguments.size, fragments);
  EXPECT_EQ(result.error, std::nullopt);
  ASSERT_EQ(fragments.size(), 7U);
  EXPECT_EQ(fragments.triangle, (std::vector<std::uint32_t>{7, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(fragments.attributes.size(), 14U);
  EXPECT_EQ(fragments.attributes[0], 8);
}

TEST(DrawFragments, AreOrderedByTriangleRowColumnAndSample) {
  const State state = small_state(4, 4);
  const Fragments fragments = fragments_of(state, rectangle(state, {0, 0}, {4, 4}), {4, 4, 4});
  ASSERT_EQ(fragments.size(), 64U);
  for (std::size_t i = 1; i < fragments.size(); ++i) {
    const auto key = [&](std::size_t k) {
      return std::tuple(fragments.triangle[k], fragments.y[k], fragments.x[k], fragments.sample[k]);
    };
    EXPECT_LT(key(i - 1), key(i));
  }
}

TEST(DrawFragments, AnEmptyMeshDrawsNothing) {
  Fragments fragments;
  const DrawResult result = draw_fragments(small_state(4, 4), Mesh{}, kFour, fragments);
  EXPECT_EQ(result.error, std::nullopt);
  EXPECT_EQ(result.counts, DrawCounts{});
  EXPECT_EQ(fragments.size(), 0U);
}

TEST(DrawFragments, TrianglesThatAreNotFiniteAreCountedAndTheOthersDrawn) {
  for (const float bad : {kInfinity, -kInfinity, kNan}) {
    for (int i = 0; i < 4; ++i) {
      const State state = small_state(4, 4);
      SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
      mesh.positions.push_back(mesh.positions[0]);
      mesh.positions[3][i] = bad;
      mesh.triangles = {{3, 1, 2}, {0, 1, 2}, {1, 2, 3}};
      Fragments fragments;
      const DrawResult result = draw_fragments(state, mesh.mesh(), kFour, fragments);
      EXPECT_EQ(result.counts, (DrawCounts{2, 0}));
      EXPECT_EQ(fragments.triangle, std::vector<std::uint32_t>(6, 1));
    }
  }
}

TEST(DrawFragments, TrianglesWithAClipDistanceThatIsNotFiniteAreCounted) {
  Arguments arguments;
  arguments.mesh.clip_distances[2] = kNan;
  Fragments fragments;
  const DrawResult result =
      draw_fragments(arguments.state, arguments.mesh.mesh(), arguments.size, fragments);
  EXPECT_EQ(result.counts, (DrawCounts{1, 0}));
  EXPECT_EQ(fragments.size(), 0U);
}

/// The counts of one triangle drawn alone.
DrawCounts counts_of(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c,
                     const State& state = small_state(4, 4)) {
  const SmallMesh mesh{{a, b, c}, {}, {}, {{0, 1, 2}}};
  Fragments fragments;
  return draw_fragments(state, mesh.mesh(), kFour, fragments).counts;
}

TEST(DrawFragments, DegenerateTrianglesAreCounted) {
  const DrawCounts degenerate{0, 1};
  const glm::vec4 a{0, 0, 0, 1};
  const glm::vec4 b{1, 0, 0, 1};
  EXPECT_EQ(counts_of(a, b, {0, 1, 0, 1}), DrawCounts{});
  EXPECT_EQ(counts_of(a, a, b), degenerate);
  EXPECT_EQ(counts_of(a, b, {0.5F, 0, 0.5F, 1}), degenerate) << "edge-on";
  EXPECT_EQ(counts_of({1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}), degenerate) << "all w zero";
  EXPECT_EQ(counts_of(a, b, {0, 0, 0.5F, 0}), degenerate) << "a vertex at the eye";
  State flat = small_state(4, 4);
  flat.viewport.size.y = 0;
  EXPECT_EQ(counts_of(a, b, {0, 1, 0, 1}, flat), degenerate) << "a viewport without height";
}

// Kills: a determinant in double alone. The third column is the sum of the other two, or next to
// that sum, and the products have up to 69 bits. Scaling to the ends of float's range does not
// change the answers.
TEST(DrawFragments, DegenerateIsDecidedExactly) {
  std::mt19937 random(20260802);
  const auto odd = [&random] { return static_cast<float>(random() % (1U << 23) | 1U); };
  for (int round = 0; round < 300; ++round) {
    const float scale = round % 3 == 0 ? 1 : round % 3 == 1 ? 0x1p-149F : 0x1p104F;
    glm::vec4 a{};
    glm::vec4 b{};
    for (const int axis : {0, 1, 3}) {
      a[axis] = odd();
      b[axis] = odd();
    }
    const glm::vec4 sum = a + b;
    EXPECT_EQ(counts_of(a * scale, b * scale, sum * scale), (DrawCounts{0, 1})) << round;
    for (const int axis : {0, 1, 3}) {
      glm::vec4 beside = sum;
      beside[axis] += 1;
      EXPECT_EQ(counts_of(a * scale, b * scale, beside * scale), DrawCounts{}) << round;
    }
  }
}

TEST(DrawFragments, DrawNothingOutsideTheScissor) {
  State state = small_state(4, 4);
  state.scissor = {{1, 2}, {2, 1}};
  EXPECT_EQ(picture(state, rectangle(state, {0, 0}, {4, 4}), kFour),
            (Rows{"....", "....", ".##.", "...."}));
  state.scissor = {{-3, -1}, {5, 2}};
  EXPECT_EQ(picture(state, rectangle(state, {0, 0}, {4, 4}), kFour),
            (Rows{"##..", "....", "....", "...."}));
  state.scissor = {{2, 2}, {0, 0}};
  EXPECT_EQ(fragments_of(state, rectangle(state, {0, 0}, {4, 4}), kFour).size(), 0U);
}

/// A triangle that covers the viewport and a large area around it.
SmallMesh large_triangle(float extent) {
  return {{{-extent, -extent, 0, 1}, {3 * extent, -extent, 0, 1}, {-extent, 3 * extent, 0, 1}},
          {},
          {},
          {{0, 1, 2}}};
}

TEST(DrawFragments, DrawNothingOutsideTheViewport) {
  State state = small_state(4, 4);
  state.viewport.origin = {1, 2};
  state.viewport.size = {2, 1};
  for (const float extent : {1.0F, 4.0F, 1e4F, 1e30F}) {
    EXPECT_EQ(picture(state, large_triangle(extent), kFour), (Rows{"....", "....", ".##.", "...."}))
        << extent;
  }
}

TEST(DrawFragments, ASampleOnTheViewportsBorderIsInAtTheLeastEndOnly) {
  State state = small_state(4, 4);
  state.viewport.origin = {0.5F, 1.5F};
  state.viewport.size = {2, 1};
  const Rows expected{"....", "##..", "....", "...."};
  EXPECT_EQ(picture(state, large_triangle(4), kFour), expected);
  state.viewport.origin = {2.5F, 2.5F};
  state.viewport.size = {-2, -1};
  EXPECT_EQ(picture(state, large_triangle(4), kFour), expected);
}

TEST(DrawFragments, TheViewportsBorderCountsForEachSample) {
  State state = small_state(4, 4);
  state.viewport.origin = {0.5F, 0};
  state.viewport.size = {1, 1};
  // The samples' x in sixteenths are 6, 14, 2, 10; the viewport is 8 <= x < 24.
  EXPECT_EQ(picture(state, large_triangle(4), {2, 1, 4}), (Rows{".#.##.#."}));
}

TEST(DrawFragments, DrawNothingOutsideTheTarget) {
  State state = small_state(4, 4);
  state.viewport.origin = {-20, -20};
  state.viewport.size = {40, 40};
  for (const int samples : {1, 2, 4, 8, 16}) {
    const TargetSize size{3, 2, samples};
    const Fragments fragments = fragments_of(state, large_triangle(1), size);
    const std::vector<int> times = times_drawn(fragments, size);
    EXPECT_EQ(times, std::vector<int>(static_cast<std::size_t>(6 * samples), 1));
  }
}

// Kills: fragments left behind by a draw that ran out of memory.
TEST(DrawFragments, WhereMemoryRunsOutTheFragmentsAreThoseOfBefore) {
  if (!kCanRunOutOfMemory) GTEST_SKIP() << "the allocator is that of ThreadSanitizer";
  Arguments arguments;
  arguments.state.derivatives = true;
  bool succeeded = false;
  int failures = 0;
  for (int allocations = 0; !succeeded && allocations < 1000; ++allocations) {
    Fragments fragments = Arguments::before();
    const DrawResult result = with_allocations(allocations, [&] {
      return draw_fragments(arguments.state, arguments.mesh.mesh(), arguments.size, fragments);
    });
    succeeded = !result.error;
    if (succeeded) break;
    ++failures;
    EXPECT_EQ(result.error, Error::out_of_memory);
    EXPECT_EQ(result.counts, DrawCounts{});
    const Fragments before = Arguments::before();
    EXPECT_EQ(fragments.triangle, before.triangle);
    EXPECT_EQ(fragments.x, before.x);
    EXPECT_EQ(fragments.y, before.y);
    EXPECT_EQ(fragments.sample, before.sample);
    EXPECT_EQ(fragments.depth, before.depth);
    EXPECT_EQ(fragments.attributes, before.attributes);
    EXPECT_EQ(fragments.derivatives, before.derivatives);
  }
  EXPECT_TRUE(succeeded);
  EXPECT_GT(failures, 5);
}

TEST(Clear, SetsEveryDepthAndZeroesEveryAttribute) {
  Picture framebuffer;
  EXPECT_EQ(clear(framebuffer, {3, 2, 4}, 5, 0.75F), std::nullopt);
  EXPECT_EQ(framebuffer.size.width, 3);
  EXPECT_EQ(framebuffer.size.height, 2);
  EXPECT_EQ(framebuffer.size.samples, 4);
  EXPECT_EQ(framebuffer.attribute_count, 5U);
  EXPECT_EQ(framebuffer.depth, Picture::Values(24, 0.75F));
  EXPECT_EQ(framebuffer.attributes, Picture::Values(120, 0));
}

TEST(Clear, ABadSizeIsAnErrorAndLeavesTheFramebuffer) {
  Picture framebuffer;
  ASSERT_EQ(clear(framebuffer, {1, 1, 1}, 0, 0.5F), std::nullopt);
  EXPECT_EQ(clear(framebuffer, {0, 1, 1}, 0, 1), Error::target_size);
  EXPECT_EQ(clear(framebuffer, {1, kMaxSize + 1, 1}, 0, 1), Error::target_size);
  EXPECT_EQ(clear(framebuffer, {1, 1, 3}, 0, 1), Error::sample_count);
  EXPECT_EQ(clear(framebuffer, {1, 1, 1}, kMaxAttributes + 1, 1), Error::attribute_count);
  EXPECT_EQ(framebuffer.depth, Picture::Values(1, 0.5F));
}

TEST(Clear, WhereMemoryRunsOutTheFramebufferIsThatOfBefore) {
  if (!kCanRunOutOfMemory) GTEST_SKIP() << "the allocator is that of ThreadSanitizer";
  for (const int allocations : {0, 1}) {
    Picture framebuffer;
    ASSERT_EQ(clear(framebuffer, {1, 1, 1}, 1, 0.5F), std::nullopt);
    EXPECT_EQ(with_allocations(allocations,
                               [&] {
                                 return clear(framebuffer, {2, 2, 1}, 1, 1);
                               }),
              Error::out_of_memory);
    EXPECT_EQ(framebuffer.size.width, 1);
    EXPECT_EQ(framebuffer.depth, Picture::Values(1, 0.5F));
    EXPECT_EQ(framebuffer.attributes, Picture::Values(1, 0));
  }
}

/// Two rectangles with one flat attribute: the first over columns 0 to 2 at depth 1/2, the second
/// over columns 1 to 3 at the depth given.
struct Overlap {
  State state = small_state(4, 1);
  SmallMesh mesh;
  Picture framebuffer;

  explicit Overlap(DepthTest test, float second_depth) {
    state.depth_test = test;
    state.attributes = {{Interpolation::flat, Location::sample}};
    mesh = rectangle(state, {0, 0}, {3, 1});
    const SmallMesh second = rectangle(state, {1, 0}, {4, 1});
    for (const glm::vec4& p : second.positions) mesh.positions.push_back(p);
    for (const glm::uvec3& t : second.triangles) mesh.triangles.push_back(t + glm::uvec3(4));
    for (std::size_t i = 0; i < 8; ++i) {
      mesh.positions[i].z = i < 4 ? 0.5F : second_depth;
      mesh.attributes.push_back(i < 4 ? 1.0F : 2.0F);
    }
    EXPECT_EQ(clear(framebuffer, {4, 1, 1}, 1, 1), std::nullopt);
  }

  Picture::Values drawn() {
    EXPECT_EQ(draw(state, mesh.mesh(), framebuffer).error, std::nullopt);
    return framebuffer.attributes;
  }
};

TEST(Draw, TheNearestFragmentStays) {
  Overlap farther(DepthTest::less, 0.75F);
  EXPECT_EQ(farther.drawn(), (Picture::Values{1, 1, 1, 2}));
  EXPECT_EQ(farther.framebuffer.depth, (Picture::Values{0.5F, 0.5F, 0.5F, 0.75F}));
  Overlap nearer(DepthTest::less, 0.25F);
  EXPECT_EQ(nearer.drawn(), (Picture::Values{1, 2, 2, 2}));
}

// Kills: less_or_equal used for less.
TEST(Draw, OfEqualDepthsTheFirstStays) {
  Overlap equal(DepthTest::less, 0.5F);
  EXPECT_EQ(equal.drawn(), (Picture::Values{1, 1, 1, 2}));
  Overlap at_the_cleared_depth(DepthTest::less, 1);
  EXPECT_EQ(at_the_cleared_depth.drawn(), (Picture::Values{1, 1, 1, 0}));
}

TEST(Draw, WithoutADepthTestTheLastStays) {
  Overlap farther(DepthTest::always, 0.75F);
  EXPECT_EQ(farther.drawn(), (Picture::Values{1, 2, 2, 2}));
  EXPECT_EQ(farther.framebuffer.depth, (Picture::Values{0.5F, 0.75F, 0.75F, 0.75F}));
}

TEST(Draw, DrawsOverWhatEarlierDrawsLeft) {
  Overlap overlap(DepthTest::less, 0.75F);
  overlap.drawn();
  overlap.mesh.positions[7].z = overlap.mesh.positions[6].z = overlap.mesh.positions[5].z =
      overlap.mesh.positions[4].z = 0;
  overlap.mesh.triangles.erase(overlap.mesh.triangles.begin(), overlap.mesh.triangles.begin() + 2);
  EXPECT_EQ(overlap.drawn(), (Picture::Values{1, 2, 2, 2}));
}

TEST(Draw, EachSampleHasItsOwnDepthAndAttributes) {
  State state = small_state(1, 1);
  state.depth_test = DepthTest::less;
  state.attributes = {{}, {}};
  SmallMesh mesh = rectangle(state, {0, 0}, {1, 1});
  for (glm::vec4& p : mesh.positions) p.z = (p.x + 1) / 2;
  for (const glm::vec4& p : mesh.positions) {
    mesh.attributes.push_back((p.x + 1) / 2);
    mesh.attributes.push_back((p.y + 1) / 2);
  }
  Picture framebuffer;
  ASSERT_EQ(clear(framebuffer, {1, 1, 2}, 2, 1), std::nullopt);
  ASSERT_EQ(draw(state, mesh.mesh(), framebuffer).error, std::nullopt);
  EXPECT_EQ(framebuffer.depth, (Picture::Values{0.75F, 0.25F}));
  EXPECT_EQ(framebuffer.attributes, (Picture::Values{0.75F, 0.75F, 0.25F, 0.25F}));
}

TEST(Draw, CountsWhatItLeavesOut) {
  const State state = small_state(4, 4);
  SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  mesh.positions.push_back({kNan, 0, 0, 1});
  mesh.triangles = {{0, 0, 1}, {0, 1, 2}, {3, 1, 2}, {1, 2, 1}};
  Picture framebuffer;
  ASSERT_EQ(clear(framebuffer, kFour, 0, 1), std::nullopt);
  EXPECT_EQ(draw(state, mesh.mesh(), framebuffer).counts, (DrawCounts{1, 2}));
}

TEST(Draw, ErrorsLeaveTheFramebuffer) {
  Overlap overlap(DepthTest::less, 0.75F);
  const auto error_of = [](Overlap faulty) {
    const Picture::Values before = faulty.framebuffer.depth;
    const std::optional<Error> error =
        draw(faulty.state, faulty.mesh.mesh(), faulty.framebuffer).error;
    EXPECT_EQ(faulty.framebuffer.depth, before);
    return error;
  };
  Overlap index = overlap;
  index.mesh.triangles.back().z = 8;
  EXPECT_EQ(error_of(index), Error::index);
  Overlap viewport = overlap;
  viewport.state.viewport.origin.x = kNan;
  EXPECT_EQ(error_of(viewport), Error::viewport);
  Overlap values = overlap;
  values.mesh.attributes.pop_back();
  EXPECT_EQ(error_of(values), Error::attribute_values);
  Overlap attributes = overlap;
  attributes.state.attributes.clear();
  EXPECT_EQ(error_of(attributes), Error::attribute_count);
  Overlap size = overlap;
  size.framebuffer.size.width = 0;
  EXPECT_EQ(error_of(size), Error::target_size);
  Overlap samples = overlap;
  samples.framebuffer.size.samples = 3;
  EXPECT_EQ(error_of(samples), Error::sample_count);
}

// Kills: writing beyond arrays that are smaller than the framebuffer's size requires.
TEST(Draw, AFramebufferWhoseArraysAreNotOfItsSizeIsAnError) {
  Overlap depth(DepthTest::less, 0.75F);
  depth.framebuffer.depth.pop_back();
  EXPECT_EQ(draw(depth.state, depth.mesh.mesh(), depth.framebuffer).error, Error::target_size);
  Overlap attributes(DepthTest::less, 0.75F);
  attributes.framebuffer.attributes.pop_back();
  EXPECT_EQ(draw(attributes.state, attributes.mesh.mesh(), attributes.framebuffer).error,
            Error::target_size);
}

// Kills: drawing in place, which leaves half a draw behind.
TEST(Draw, WhereMemoryRunsOutNothingWasDrawn) {
  if (!kCanRunOutOfMemory) GTEST_SKIP() << "the allocator is that of ThreadSanitizer";
  bool succeeded = false;
  for (int allocations = 0; !succeeded && allocations < 1000; ++allocations) {
    Overlap overlap(DepthTest::less, 0.75F);
    const std::optional<Error> error = with_allocations(allocations, [&] {
      return draw(overlap.state, overlap.mesh.mesh(), overlap.framebuffer).error;
    });
    succeeded = !error;
    if (succeeded) break;
    EXPECT_EQ(error, Error::out_of_memory);
    EXPECT_EQ(overlap.framebuffer.depth, Picture::Values(4, 1));
    EXPECT_EQ(overlap.framebuffer.attributes, Picture::Values(4, 0));
  }
  EXPECT_TRUE(succeeded);
}

TEST(ToString, EveryErrorHasASentenceOfItsOwn) {
  std::set<std::string_view> sentences;
  for (int i = 0; i <= static_cast<int>(Error::out_of_memory); ++i) {
    const std::string_view sentence = to_string(static_cast<Error>(i));
    EXPECT_GT(sentence.size(), 20U);
    EXPECT_TRUE(sentences.insert(sentence).second) << sentence;
  }
  EXPECT_EQ(sentences.size(), 19U);
}

}  // namespace
}  // namespace rastercheck::rasterizer::rasterizer_test
