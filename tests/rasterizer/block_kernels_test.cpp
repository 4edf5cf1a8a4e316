#include "rasterizer/internal/block_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "tests/rasterizer/exact.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer::block_kernels_test {
namespace {

/// The arithmetic of the kernels, one sample at a time.
struct Scalar {
  BlockCoverage coverage;
  std::array<std::array<double, kBlockSize>, 3> e{};

  Scalar(const EdgeRow& row, int first, int count) {
    for (int j = 0; j < count; ++j) {
      const double u = row.scale * (2 * (first + row.offset + j) - row.shift);
      bool is_possible = true;
      bool is_sure = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const double value = row.a[i] * u + row.row[i];
        e[i][static_cast<std::size_t>(j)] = value;
        is_possible = is_possible && value >= -row.band[i];
        is_sure = is_sure && value > row.band[i];
      }
      coverage.possible |= std::uint64_t{is_possible} << j;
      coverage.sure |= std::uint64_t{is_sure} << j;
    }
  }
};

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }
std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// A row whose edges cross zero inside the block or elsewhere; some edges are exactly at the end of
/// their band.
EdgeRow random_row(Random& random, int first) {
  EdgeRow row;
  row.offset = random.between(0, 15) / 16.0;
  const bool is_on_grid = random.one_in(2);
  row.scale = is_on_grid ? 64 : random.number(24, -40, 40);
  row.shift = is_on_grid ? random.between(0, 640) / 4.0 : random.number(53, -10, 14);
  for (std::size_t i = 0; i < 3; ++i) {
    const double middle = first + random.between(-20, 80) + row.offset;
    row.a[i] = is_on_grid ? random.between(-9, 9) : random.number(53, -60, 60);
    row.row[i] = -row.a[i] * (row.scale * (2 * middle - row.shift));
    row.band[i] = random.one_in(2) ? 0 : std::abs(row.a[i] * row.scale * 2);
  }
  return row;
}

class BlockKernels : public ::testing::TestWithParam<std::int64_t> {
 protected:
  const OnTarget on_target_{GetParam()};
  Random random_{50};
  BlockWeights weights_;
};

INSTANTIATE_TEST_SUITE_P(Targets, BlockKernels, ::testing::ValuesIn(all_targets()), target_name);

// Kills: a product and sum that are fused; lanes in the wrong order; a mask shifted wrongly; bits
// beyond the end of the row; > instead of >=.
TEST_P(BlockKernels, EdgesAreThoseOfScalarArithmetic) {
  int doubtful = 0;
  for (int i = 0; i < 40; ++i) {
    for (int count = 1; count <= kBlockSize; ++count) {
      const int first = random_.pick({0, 1, 63, 64, 8'191, 16'384 - count});
      const EdgeRow row = random_row(random_, first);
      const Scalar expected(row, first, count);
      const BlockCoverage coverage = evaluate_edges(row, first, count, weights_);
      ASSERT_EQ(coverage.possible, expected.coverage.possible) << count;
      ASSERT_EQ(coverage.sure, expected.coverage.sure) << count;
      ASSERT_EQ(coverage.possible >> (count - 1) >> 1, 0U);
      doubtful += std::popcount(coverage.possible & ~coverage.sure);
      for (std::size_t e = 0; e < 3; ++e) {
        for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
          ASSERT_EQ(bits(weights_.e[e][j]), bits(expected.e[e][j])) << count;
        }
      }
    }
  }
  EXPECT_GT(doubtful, 1'000);
}

/// The values of a plane along a row, by scalar arithmetic.
struct ScalarPlane {
  ScalarPlane(const PlaneRow& plane, const EdgeRow& of_block, int first, int count) {
    for (int j = 0; j < count; ++j) {
      const double u = of_block.scale * (2 * (first + of_block.offset + j) - of_block.shift);
      values.push_back(plane.a * u + plane.row);
    }
  }
  std::vector<double> values;
};

PlaneRow sum_of(const EdgeRow& row) {
  return {row.a[0] + row.a[1] + row.a[2], row.row[0] + row.row[1] + row.row[2]};
}

TEST_P(BlockKernels, SumsAreThoseOfScalarArithmetic) {
  for (int i = 0; i < 20; ++i) {
    for (int count = 1; count <= kBlockSize; ++count) {
      const EdgeRow row = random_row(random_, 100);
      const PlaneRow sum = sum_of(row);
      const ScalarPlane expected(sum, row, 100, count);
      evaluate_edges(row, 100, count, weights_);
      // Sometimes `least` is exactly one of the sums: only larger sums are above it.
      const double least =
          random_.one_in(2)
              ? expected.values[static_cast<std::size_t>(random_.between(0, count - 1))]
              : std::abs(row.row[0]);
      const std::uint64_t above = sum_weights(sum, least, count, weights_);
      for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
        ASSERT_EQ(bits(weights_.reciprocal[j]), bits(1 / expected.values[j]));
        ASSERT_EQ((above >> j & 1) != 0, expected.values[j] > least) << j;
      }
    }
  }
}

TEST_P(BlockKernels, ValuesAreThoseOfScalarArithmetic) {
  std::array<float, kBlockSize> smooth{};
  std::array<float, kBlockSize> affine{};
  std::array<float, kBlockSize> depth{};
  for (int i = 0; i < 20; ++i) {
    for (int count = 1; count <= kBlockSize; ++count) {
      EdgeRow row = random_row(random_, 0);
      // Makes few sums close to 0.
      for (double& value : row.row) value = std::abs(value) * 4 + std::abs(row.a[0] * row.scale);
      const PlaneRow sum = sum_of(row);
      const ScalarPlane sums(sum, row, 0, count);
      const PlaneRow plane{sum.a * random_.number(24, -60, 20),
                           sum.row * random_.number(24, -20, 20)};
      const ScalarPlane expected(plane, row, 0, count);
      evaluate_edges(row, 0, count, weights_);
      sum_weights(sum, 0, count, weights_);
      evaluate_smooth(plane, count, weights_, smooth.data());
      evaluate_affine(plane, count, weights_, affine.data());
      evaluate_depth(plane, 0.25, 0.75, 0, count, weights_, depth.data());
      for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
        const double value = expected.values[j];
        const double quotient = value * (1 / sums.values[j]);
        if (!(std::abs(quotient) < 0x1p127)) continue;  // happens for uncovered samples only
        ASSERT_EQ(bits(smooth[j]), bits(static_cast<float>(quotient)));
        ASSERT_EQ(bits(affine[j]), bits(static_cast<float>(value)));
        const double held = std::min(std::max(value, 0.25), 0.75);
        ASSERT_EQ(bits(depth[j]), bits(static_cast<float>(held)));
      }
    }
  }
}

// Kills: writing a whole vector beyond the end of the arrays; a full block's mask of 64 bits that
// is cut short.
TEST_P(BlockKernels, AFullBlockHasAFullMask) {
  EdgeRow row;
  row.row = {1, 1, 1};
  row.scale = 1;
  const BlockCoverage coverage = evaluate_edges(row, 0, kBlockSize, weights_);
  EXPECT_EQ(coverage.sure, ~std::uint64_t{0});
  EXPECT_EQ(coverage.possible, ~std::uint64_t{0});
  EXPECT_EQ(sum_weights(sum_of(row), 2, kBlockSize, weights_), ~std::uint64_t{0});
  EXPECT_EQ(sum_weights(sum_of(row), 3, kBlockSize, weights_), 0U);
}

// A sample at exactly 0 of an edge without a band is possible but not sure, whatever the sign of
// the zero.
TEST_P(BlockKernels, ZerosArePossible) {
  EdgeRow row;
  row.row = {1, 0.0, -0.0};
  row.a = {0, 1, -1};
  row.scale = 1;
  row.shift = 21;
  row.offset = 0.5;
  const BlockCoverage coverage = evaluate_edges(row, 0, 32, weights_);
  EXPECT_EQ(coverage.possible, std::uint64_t{1} << 10);
  EXPECT_EQ(coverage.sure, 0U);
}

TEST(BlockKernelTargets, ThereIsMoreThanOne) {
#if HWY_ARCH_X86
  EXPECT_GE(all_targets().size(), 2U);
#endif
}

}  // namespace
}  // namespace rastercheck::rasterizer::block_kernels_test
