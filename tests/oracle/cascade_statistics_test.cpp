// Tests what a judgement counts and keeps where the cascade is most likely to lose or double some
// of it: sums, extremes of equal size, borders of words, batches and chunks.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/oracle/cascade.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::cascade_statistics_test {
namespace {

using records::AttributeKind;
using records::Enclosure;
using records::FragmentClass;
using records::Histogram;

/// A triangle over the whole target, with attributes of one kind that all have the constant value
/// 1.
cases::Case of_ones(int width, int height, std::size_t attributes = 1) {
  const std::vector<float> ones(attributes, 1.0F);
  return small_case(cases::Rules::vulkan, width, height,
                    {{{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}}}, {{ones, ones, ones}});
}

// By hand: 1 + 2^17 is too large by 2^40 ULP of 1, the largest error that is summed.
TEST(CascadeSums, TheLargestErrorThatIsSummedIsSummedByAllLevels) {
  const cases::Case c = of_ones(1, 1);
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth.constant = 0x1.fffffep23F;
  const SceneTruth scene(c, contract);
  for (const float more : {0.0F, 0x1p-6F}) {
    cases::Fragments drawn;
    push(drawn, 0, 0, 0, 0, 0, {1 + 0x1p17F + more});
    for (const Level level : kLevels) {
      const records::Judgement judgement = judge(scene, drawn, from(level)).judgement;
      const records::SignedSum& sum = judgement.errors.at(AttributeKind::smooth).excess.sum;
      EXPECT_EQ(sum.count(), more > 0 ? 0U : 1U) << static_cast<int>(level);
      EXPECT_EQ(sum.beyond(), more > 0 ? 1U : 0U) << static_cast<int>(level);
    }
  }
}

// ---- extremes

/// The places of the extremes of the smooth values, each as "triangle:x,y/sample a attribute".
std::string extremes_of(const records::Judgement& judgement) {
  std::string places;
  const records::Extremes& extremes = judgement.errors.at(AttributeKind::smooth).excess.extremes;
  for (const auto& e : {extremes.most_negative, extremes.most_positive}) {
    places += !e ? "- "
                 : std::to_string(e->place.triangle) + ":" + std::to_string(e->place.x) + "," +
                       std::to_string(e->place.y) + "/" + std::to_string(e->place.sample) + " a" +
                       std::to_string(e->attribute.value()) + " ";
  }
  return places;
}

cases::Fragments all_ones(const SceneTruth& scene) {
  cases::Fragments drawn = perfect(scene);
  std::fill(drawn.attributes.begin(), drawn.attributes.end(), 1.0F);
  return drawn;
}

cases::Contract within_four(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth.constant = 4;
  return contract;
}

// Values are judged attribute by attribute, but extremes are ordered by place.
TEST(CascadeExtremes, OfEqualErrorsTheFirstPlaceCountsWhicheverTheAttribute) {
  for (const bool is_open : {false, true}) {
    const cases::Case c = of_ones(4, 1, 3);
    cases::Contract contract = within_four(c);
    if (is_open) contract.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0.25F};
    const SceneTruth scene(c, contract);
    cases::Fragments drawn = all_ones(scene);
    ASSERT_EQ(drawn.size(), 4U);
    drawn.attributes[3 * 3 + 0] = 1 + 0x1p-23F;
    drawn.attributes[3 * 1 + 1] = 1 + 0x1p-23F;
    drawn.attributes[3 * 1 + 2] = 1 + 0x1p-23F;
    drawn.attributes[3 * 2 + 0] = 1 - 0x1p-23F;
    drawn.attributes[3 * 0 + 2] = 1 - 0x1p-23F;
    for (const Level level : kLevels) {
      EXPECT_EQ(extremes_of(judge(scene, drawn, from(level)).judgement), "0:0,0/0 a2 0:1,0/0 a1 ")
          << static_cast<int>(level);
    }
  }
}

// With a depth test, samples are judged row by row, but extremes are ordered by triangle first.
TEST(CascadeExtremes, OfEqualErrorsTheFirstTriangleCountsWithADepthTestToo) {
  cases::Case c = small_case(cases::Rules::vulkan, 2, 1,
                             {{{0, -3, 0, 1}, {3, 0, 0, 1}, {0, 3, 0, 1}}}, {{{1}, {1}, {1}}});
  c.positions.insert(c.positions.end(), {{0, -3, 0, 1}, {0, 3, 0, 1}, {-3, 0, 0, 1}});
  c.attribute_values.insert(c.attribute_values.end(), 3, 1.0F);
  c.triangles.push_back({3, 4, 5});
  c.depth_test = cases::DepthTest::less;
  const SceneTruth scene(c, within_four(c));
  cases::Fragments drawn;
  push(drawn, 0, 1, 0, 0, 0, {1 + 0x1p-23F});
  push(drawn, 1, 0, 0, 0, 0, {1 + 0x1p-23F});
  for (const Level level : kLevels) {
    EXPECT_EQ(extremes_of(judge(scene, drawn, from(level)).judgement), "- 0:1,0/0 a0 ")
        << static_cast<int>(level);
  }
}

/// The value is x · 2^-120, so that the fragments' errors in ULP of 1 differ by less than doubles
/// can tell: each fragment may be the extreme, and none is known to be.
cases::Case of_almost_nothing(int width) {
  const float far = 0x1p120F;
  return small_case(cases::Rules::vulkan, width, 1,
                    {{{-1, -1, 0, 1}, {far, -1, 0, 1}, {-1, 3, 0, 1}}}, {{{0}, {1}, {0}}});
}

// Candidates for extremes are decided when there are 64 of them. By hand: 0x1.4p-25 is 0.3125 ULP
// of 1, which lies within a bucket, so that intervals decide everything but the extremes.
TEST(CascadeExtremes, OfMoreCandidatesThanAreKeptNoneIsLost) {
  for (const int width : {63, 64, 65, 129, 200}) {
    const cases::Case c = of_almost_nothing(width);
    const SceneTruth scene(c, within_four(c));
    for (const std::size_t largest : {std::size_t{0}, std::size_t{1}, std::size_t{40}}) {
      cases::Fragments drawn = perfect(scene);
      ASSERT_EQ(drawn.size(), static_cast<std::size_t>(width));
      std::fill(drawn.attributes.begin(), drawn.attributes.end(), -0x1.4p-25F);
      for (std::size_t i = 0; i < largest; ++i) drawn.attributes[i] = -0x1.4p-26F;
      for (const Level level : kLevels) {
        const records::Judgement judgement = judge(scene, drawn, from(level)).judgement;
        EXPECT_EQ(extremes_of(judgement), "0:" + std::to_string(largest) + ",0/0 a0 - ")
            << static_cast<int>(level);
        EXPECT_EQ(judgement.errors.at(AttributeKind::smooth).excess.extremes.most_negative->error,
                  (Enclosure{std::nextafter(-0.3125, -1.0), -0.3125}));
      }
    }
  }
}

// ---- borders of words, batches and chunks

TEST(CascadeBorders, EveryFragmentOfARowIsJudgedOnce) {
  for (const int n : {1, 63, 64, 65, 127, 128, 129, 191, 192, 193, 255, 256, 257}) {
    const auto last = static_cast<std::size_t>(n) - 1;
    const cases::Case c = of_ones(n, 2);
    const SceneTruth scene(c, within_four(c));
    cases::Fragments drawn = all_ones(scene);
    ASSERT_EQ(drawn.size(), 2 * last + 2);
    drawn.attributes[last] = 1 - 0x1p-23F;
    drawn.attributes[last + 1] = 1 + 0x1p-22F;
    cases::Fragments without = drawn;
    for (auto* column : {&without.x, &without.y}) column->pop_back();
    without.triangle.pop_back();
    without.sample.pop_back();
    without.depth.pop_back();
    without.attributes.pop_back();
    for (const Level level : kLevels) {
      const records::Judgement judgement = judge(scene, drawn, from(level)).judgement;
      const records::ErrorStatistics& errors = judgement.errors.at(AttributeKind::smooth);
      const auto all = static_cast<std::uint64_t>(2 * n);
      EXPECT_EQ(judgement.counts, (records::Counts{all, 0, 0, 0})) << n;
      if (level == Level::filter) {
        // No sample is near an edge, and samples beyond the end of the row are not asked for.
        EXPECT_EQ(judgement.levels.samples, (records::LevelCounts{all, 0, 0})) << n;
      }
      EXPECT_EQ(errors.classes[FragmentClass::correct], all) << n;
      EXPECT_EQ(errors.excess.histogram.count_in(Histogram::kZeroBucket), all - 2) << n;
      EXPECT_EQ(errors.excess.histogram.count_in(Histogram::bucket_of(1)), 1U) << n;
      EXPECT_EQ(errors.excess.histogram.count_in(Histogram::bucket_of(2)), 1U) << n;
      EXPECT_EQ(extremes_of(judgement), "0:" + std::to_string(last) + ",0/0 a0 0:0,1/0 a0 ") << n;
      const auto missing = judge(scene, without, from(level)).judgement;
      const auto& classes = missing.errors.at(AttributeKind::coverage).classes;
      EXPECT_EQ(classes[FragmentClass::missing], 1U) << n;
      EXPECT_EQ(classes[FragmentClass::correct], all - 1) << n;
    }
  }
}

/// Layers of one triangle over a target, without a depth test. Each has an error of 1 ULP at its
/// first fragment; layer `worst` has an error of 2 ULP.
void expect_layers(int width, int height, std::uint32_t layers, std::uint32_t worst) {
  cases::Case c = of_ones(width, height);
  c.triangles.assign(layers, {0, 1, 2});
  const SceneTruth scene(c, within_four(c));
  const std::size_t each = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  cases::Fragments drawn = all_ones(scene);
  ASSERT_EQ(drawn.size(), layers * each);
  for (std::uint32_t t = 0; t < layers; ++t) drawn.attributes[t * each] = 1 + 0x1p-23F;
  drawn.attributes[worst * each + each - 1] = 1 + 0x1p-22F;
  drawn.x[drawn.size() - 1] = 0;  // a second fragment there: extra, and one is missing
  drawn.y[drawn.size() - 1] = 0;
  const bool is_moved_worst = worst + 1 == layers;
  for (const unsigned jobs : {1U, 2U, 3U}) {
    std::size_t seen = 0;
    std::size_t unordered = 0;
    std::array<std::uint32_t, 4> before{};
    const JudgedDrawing judged =
        judge(scene, drawn, from(Level::filter, jobs), [&](const JudgedSample& s, const auto*) {
          const std::array<std::uint32_t, 4> place{s.place.triangle, s.place.y, s.place.x,
                                                   s.place.sample};
          if (place < before) ++unordered;
          before = place;
          ++seen;
        });
    const records::Judgement& judgement = judged.judgement;
    const std::uint64_t all = layers * each;
    EXPECT_EQ(judgement.counts, (records::Counts{all, 0, 0, 0}));
    EXPECT_EQ(seen, all + 1);
    EXPECT_EQ(unordered, 0U);
    EXPECT_EQ(judged.seen_triangles.size(), layers);
    const records::ErrorStatistics& errors = judgement.errors.at(AttributeKind::smooth);
    const auto& classes = judgement.errors.at(AttributeKind::coverage).classes;
    EXPECT_EQ(classes[FragmentClass::correct], all - 1);
    EXPECT_EQ(classes[FragmentClass::missing], 1U);
    EXPECT_EQ(classes[FragmentClass::extra], 1U);
    EXPECT_EQ(errors.excess.histogram.count_in(Histogram::bucket_of(1)), layers);
    EXPECT_EQ(errors.excess.histogram.count_in(Histogram::bucket_of(2)), is_moved_worst ? 0U : 1U);
    const auto& most = errors.excess.extremes.most_positive;
    EXPECT_EQ(most->place.triangle, is_moved_worst ? 0U : worst);
    EXPECT_EQ(most->error.hi, is_moved_worst ? 1 : 2);
  }
}

// A chunk is 256 triangles.
TEST(CascadeBorders, EveryTriangleOfAChunkIsJudgedOnce) {
  for (const std::uint32_t layers : {63U, 64U, 65U, 127U, 128U, 129U, 255U, 256U, 257U, 513U}) {
    expect_layers(2, 1, layers, layers / 2);
    expect_layers(2, 1, layers, layers - 2);
    expect_layers(2, 1, layers, layers - 1);
  }
}

// A chunk also ends when its triangles have 32768 fragments.
TEST(CascadeBorders, EveryFragmentOfAChunkIsJudgedOnce) {
  expect_layers(128, 128, 3, 1);
  expect_layers(64, 257, 3, 0);
  expect_layers(181, 181, 2, 1);
}

}  // namespace
}  // namespace rastercheck::oracle::cascade_statistics_test
