// Answers of pictures do not depend on which rows are asked for, nor on how rows are cut into
// bands.

#include "oracle/picture_truth.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::picture_truth_test {
namespace {

struct Answer {
  int x = 0;
  int y = 0;
  bool may_be_empty = false;
  std::vector<std::uint32_t> triangles;
  std::vector<ValueSpan> values;

  bool operator==(const Answer&) const = default;
};

std::vector<Answer> answers(const PictureTruth& truth, int y0, int y1) {
  std::vector<Answer> all;
  truth.for_each_pixel_of_rows(y0, y1, [&all](int x, int y, std::span<const SampleAnswer> samples) {
    for (const SampleAnswer& sample : samples) {
      all.push_back({x, y, sample.may_be_empty, {}, {}});
      for (const SampleAnswer::Candidate& one : sample.candidates) {
        all.back().triangles.push_back(one.triangle);
        all.back().values.insert(all.back().values.end(), one.values.begin(), one.values.end());
      }
    }
  });
  return all;
}

/// Two triangles that cross each other and all of several bands of 64 rows, and a small one.
cases::Case tall_case() {
  cases::Case c = small_case(cases::Rules::opengl, 3, 200,
                             {{{-1, -1, -0.5F, 1}, {1, -1, 0.5F, 1}, {0.25F, 1, 0.25F, 1}}},
                             {{{0.0F}, {1.0F}, {2.0F}}});
  c.positions.insert(c.positions.end(), {{-1, 1, -0.5F, 1}, {1, 1, 0.25F, 1}, {0, -1, 0.5F, 2}});
  c.positions.insert(c.positions.end(),
                     {{-1, -0.1F, -0.75F, 1}, {1, -0.1F, -0.75F, 1}, {0, 0.1F, -0.75F, 1}});
  c.attribute_values.insert(c.attribute_values.end(), {3, 4, 5, 6, 7, 8});
  c.triangles.push_back({3, 4, 5});
  c.triangles.push_back({6, 7, 8});
  return c;
}

// Kills: a triangle that is dropped although it has pixels in the next band; values of another
// triangle's place in the sorted list.
TEST(PictureTruth, IsTheSameForAllRowsAndForEachRowAlone) {
  for (const cases::DepthTest test : {cases::DepthTest::none, cases::DepthTest::less}) {
    cases::Case c = tall_case();
    c.depth_test = test;
    for (const bool is_open : {false, true}) {
      cases::Contract contract = cases::contract_of(c);
      if (is_open) contract.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
      const SceneTruth scene(c, contract);
      const PictureTruth truth(scene, {true, true});
      std::vector<Answer> one_by_one;
      for (int y = 0; y < c.framebuffer.height; ++y) {
        const std::vector<Answer> row = answers(truth, y, y + 1);
        one_by_one.insert(one_by_one.end(), row.begin(), row.end());
      }
      EXPECT_EQ(one_by_one.size(), 600U);
      EXPECT_TRUE(answers(truth, 0, c.framebuffer.height) == one_by_one);
    }
  }
}

}  // namespace
}  // namespace rastercheck::oracle::picture_truth_test
