#include "rasterizer/internal/float_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/rasterizer/exact.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer::float_kernels_test {
namespace {

using Three = std::array<double, 3>;
using Values = std::array<float, 3>;

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

double between(Random& random, double low, double high) {
  return low + (high - low) * random.between(0, 1 << 30) / (1 << 30);
}

/// Weights of one sample with a sum of about 1; each is at least −2^-32 of the sum.
Three random_shares(Random& random) {
  Three e{};
  switch (random.between(0, 6)) {
    case 0:  // anything
      for (double& share : e) share = between(random, 0, 1);
      break;
    case 1:  // nearly equal: the last bit decides the pivot, or several are largest
      for (double& share : e) share = 1 + random.between(-4, 4) * random.pick({0x1p-52, 0x1p-24});
      break;
    case 2:  // near the middle, where errors are largest
      for (double& share : e) share = between(random, 0.9, 1.1);
      break;
    case 3:  // one far above the others, whose quotients may underflow
      e = {1, std::abs(random.number(53, -160, -1)), std::abs(random.number(53, -30, -1))};
      break;
    case 4:  // two weights of about one half
      e = {1, 1 + random.between(-2, 2) * 0x1p-24, std::abs(random.number(53, -60, -20))};
      break;
    case 5:  // on an edge or at a vertex
      e = {between(random, 0.1, 1), random.one_in(4) ? 0 : between(random, 0, 1), 0};
      break;
    default:  // outside by the edges' possible error
      e = {between(random, 0.5, 1), between(random, 0, 1), -0x1p-33 * between(random, 0, 1)};
      if (random.one_in(2)) e[1] = -0x1p-33 * between(random, 0, 1);
      break;
  }
  const double sum = e[0] + e[1] + e[2];
  const double size = between(random, 0.5, 1) / sum;
  for (double& share : e) share *= size;
  std::rotate(e.begin(), e.begin() + random.between(0, 2), e.end());
  return e;
}

/// Values of the vertices, below 2^127; `e` are the weights for values that should cancel.
Values random_values(Random& random, const Three& e) {
  const int exponent = random.pick({0, 0, -126, -140, 125, 126, random.between(-149, 126)});
  const auto full = [&] {  // just below a power of two
    return std::ldexp(static_cast<float>(between(random, 1.9, 2 - 0x1p-23)), exponent);
  };
  Values r{};
  switch (random.between(0, 5)) {
    case 0:
      for (float& value : r) value = random.any_real();
      break;
    case 1:  // one negative, two positive
      r = {full(), full(), -full()};
      break;
    case 2:  // one between the others
      r = {full(), -full(), random.real(-149, exponent)};
      break;
    case 3: {  // nearly constant
      r.fill(full());
      for (float& value : r) {
        for (int steps = random.between(0, 3); steps > 0; --steps)
          value = std::nextafter(value, 0.0F);
      }
      break;
    }
    case 4: {  // a value near 0
      r = {full(), full(), -full()};
      const double zero = -(r[0] * e[0] + r[1] * e[1]) / e[2];
      if (std::abs(zero) < 0x1.8p126) r[2] = static_cast<float>(zero);
      return r;
    }
    default:
      for (float& value : r) value = random.real(exponent - 3, exponent);
      break;
  }
  std::rotate(r.begin(), r.begin() + random.between(0, 2), r.end());
  return r;
}

void put(const Three& e, std::size_t sample, BlockWeights& weights) {
  for (std::size_t i = 0; i < 3; ++i) weights.e[i][sample] = e[i];
}

Three at(const BlockWeights& weights, std::size_t sample) {
  return {weights.e[0][sample], weights.e[1][sample], weights.e[2][sample]};
}

/// The error of `value` in scale ULP; the weights are exact and may have any sum.
double scale_ulps(float value, const Values& r, const std::array<Rational, 3>& e) {
  Rational numerator = 0;
  Rational sum = 0;
  Rational scale = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational at_vertex = r[i];
    numerator += at_vertex * e[i];
    sum += e[i];
    scale = std::max<Rational>(scale, abs(at_vertex));
  }
  const Rational exact = numerator / sum;
  const Rational unit = float_ulp(std::max<Rational>(abs(exact), scale));
  const Rational error = abs(Rational(value) - exact) / unit;
  return error.get_d();
}

/// Exact weights that may have been evaluated as `e`, with errors of 2^-32 of their sum in total.
std::array<Rational, 3> disturbed(Random& random, const Three& e) {
  std::array<Rational, 3> exact{e[0], e[1], e[2]};
  if (random.one_in(2)) return exact;
  const Rational half = (exact[0] + exact[1] + exact[2]) * power_of_two(-33);
  const int up = random.between(0, 2);
  exact[static_cast<std::size_t>(up)] += half;
  exact[static_cast<std::size_t>((up + random.between(1, 2)) % 3)] -= half;
  return exact;
}

/// The arithmetic of the kernels, one sample at a time.
struct Scalar {
  std::array<float, 3> steps{};
  std::size_t pivot = 0;

  Scalar(const Three& e, const Three& factors, bool is_smooth) {
    std::array<float, 3> f{};
    for (std::size_t i = 0; i < 3; ++i) {
      f[i] = std::max(static_cast<float>(e[i] * factors[i]), 0.0F);
    }
    if (f[1] > f[0]) pivot = 1;
    if (f[2] > f[pivot]) pivot = 2;
    float next = f[(pivot + 1) % 3];
    float last = f[(pivot + 2) % 3];
    if (is_smooth) {
      const float sum = (next + last) + f[pivot];
      next /= sum;
      last /= sum;
    }
    steps[pivot] = next;
    steps[(pivot + 2) % 3] = -last;
  }

  float value(const Values& r) const {
    const float first = (r[1] - r[0]) * steps[0];
    const float second = (r[2] - r[1]) * steps[1];
    const float third = (r[0] - r[2]) * steps[2];
    return r[pivot] + ((first + second) + third);
  }
};

class FloatKernels : public ::testing::TestWithParam<std::int64_t> {
 protected:
  /// Sets random weights for a block, divided by `scale`.
  void set_weights(double scale) {
    for (std::size_t j = 0; j < kBlockSize; ++j) {
      Three e = random_shares(random_);
      for (double& weight : e) weight /= scale;
      put(e, j, weights_);
    }
  }

  const OnTarget on_target_{GetParam()};
  Random random_{51};
  BlockWeights weights_{};
  FloatWeights shares_;
  std::array<float, kBlockSize> out_{};
};

INSTANTIATE_TEST_SUITE_P(Targets, FloatKernels, ::testing::ValuesIn(all_targets()), target_name);

// Kills: a product and sum that are fused; an approximate quotient; lanes in the wrong order; the
// last vector left out.
TEST_P(FloatKernels, ValuesAreThoseOfScalarArithmetic) {
  for (int i = 0; i < 20; ++i) {
    for (int count = 1; count <= kBlockSize; ++count) {
      const double scale = std::ldexp(1.0, random_.between(-600, 600));
      set_weights(scale);
      const bool is_smooth = random_.one_in(2);
      const Three factors =
          is_smooth ? Three{scale, scale, scale} : Three{scale * 0.75, scale * 0.625, scale};
      if (is_smooth) {
        float_smooth_weights(weights_, scale, count, shares_);
      } else {
        float_affine_weights(weights_, factors, count, shares_);
      }
      const Values r = random_values(random_, at(weights_, 0));
      ASSERT_TRUE(fits_float_precision(r));
      evaluate_float(r, count, shares_, out_.data());
      for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
        const Scalar expected(at(weights_, j), factors, is_smooth);
        ASSERT_EQ(static_cast<std::size_t>(shares_.pivot[j]), expected.pivot);
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_EQ(bits(shares_.steps[k][j]), bits(expected.steps[k])) << count;
        }
        ASSERT_EQ(bits(out_[j]), bits(expected.value(r))) << count;
      }
    }
  }
}

// Kills: the sum Σ r_i E_i / Σ E_i, which misses constants; adding the pivot's value times its
// share.
TEST_P(FloatKernels, ConstantsAreExact) {
  for (int i = 0; i < 200; ++i) {
    set_weights(1);
    float_smooth_weights(weights_, 1, kBlockSize, shares_);
    Values r{};
    r.fill(i == 0 ? std::nextafter(0x1p127F, 0.0F) : random_.any_real());
    evaluate_float(r, kBlockSize, shares_, out_.data());
    for (const float value : out_) ASSERT_EQ(value, r[0]);
    float_affine_weights(weights_, {1.5, 1, 0.5}, kBlockSize, shares_);
    evaluate_float(r, kBlockSize, shares_, out_.data());
    for (const float value : out_) ASSERT_EQ(value, r[0]);
  }
}

// Kills: always starting from the same vertex; shares assigned to the wrong vertex.
TEST_P(FloatKernels, ValuesOfVerticesAreExact) {
  for (int i = 0; i < 200; ++i) {
    for (std::size_t j = 0; j < kBlockSize; ++j) {
      Three e{0.0, -0.0, 0.0};
      e[j % 3] = between(random_, 0x1p-20, 2);
      put(e, j, weights_);
    }
    const Values r = random_values(random_, {0.25, 0.25, 0.5});
    float_smooth_weights(weights_, 1, kBlockSize, shares_);
    evaluate_float(r, kBlockSize, shares_, out_.data());
    for (std::size_t j = 0; j < kBlockSize; ++j) ASSERT_EQ(out_[j], r[j % 3]);
    float_affine_weights(weights_, {1, 1, 1}, kBlockSize, shares_);
    evaluate_float(r, kBlockSize, shares_, out_.data());
    for (std::size_t j = 0; j < kBlockSize; ++j) ASSERT_EQ(out_[j], r[j % 3]);
  }
}

// Samples outside the triangle may have any weights; these must not change other samples.
TEST_P(FloatKernels, OtherSamplesDoNotMatter) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double most = std::numeric_limits<double>::max();
  set_weights(0x1p600);
  const Values r{0x1.8p126F, -0x1.fp126F, 0x1p-140F};
  for (const double factor : {1.0, 0.5}) {
    const Three factors{0x1p600, 0x1p600 * factor, 0x1p600};
    for (std::size_t j = 1; j < kBlockSize; j += 2) {
      put({random_.pick({infinity, -infinity, nan, most, 0.0, -1.0}),
           random_.pick({infinity, -infinity, nan, -most, 0.0, -1.0}), -most},
          j, weights_);
    }
    const bool is_smooth = factor == 1;
    if (is_smooth) {
      float_smooth_weights(weights_, 0x1p600, kBlockSize, shares_);
    } else {
      float_affine_weights(weights_, factors, kBlockSize, shares_);
    }
    evaluate_float(r, kBlockSize, shares_, out_.data());
    for (std::size_t j = 0; j < kBlockSize; j += 2) {
      ASSERT_EQ(bits(out_[j]), bits(Scalar(at(weights_, j), factors, is_smooth).value(r)));
    }
  }
}

/// Runs on the best target; the other targets compute the same bits.
class FloatBounds : public ::testing::Test {
 protected:
  static constexpr int kBlocks = 1'600;  // of 64 samples: 102,400

  /// Checks the error of a value and that it stays within the range of the three vertices; keeps
  /// the worst error.
  void judge(const Values& r, std::size_t sample, const std::array<Rational, 3>& exact,
             double bound) {
    const auto [least, greatest] = std::minmax_element(r.begin(), r.end());
    ASSERT_GE(out_[sample], *least);
    ASSERT_LE(out_[sample], *greatest);
    const double error = scale_ulps(out_[sample], r, exact);
    ASSERT_LE(error, bound) << r[0] << ' ' << r[1] << ' ' << r[2];
    worst_ = std::max(worst_, error);
  }

  Random random_{52};
  BlockWeights weights_{};
  FloatWeights shares_;
  std::array<float, kBlockSize> out_{};
  double worst_ = 0;
};

// Kills: the smallest weight used as pivot; weights that are not scaled; a bound that omits the
// rounding of one operation.
TEST_F(FloatBounds, SmoothValuesAreWithin) {
  for (int i = 0; i < kBlocks; ++i) {
    const int exponent = random_.pick({0, 0, 0, 600, -600, random_.between(-600, 600)});
    const double scale = std::ldexp(1.0, exponent);
    for (std::size_t j = 0; j < kBlockSize; ++j) {
      Three e = random_shares(random_);
      const double size = random_.one_in(16) ? 0x1p-19 : 2;  // times 0.5 … 1
      for (double& weight : e) weight *= size / scale;
      put(e, j, weights_);
    }
    float_smooth_weights(weights_, scale, kBlockSize, shares_);
    for (std::size_t j = 0; j < kBlockSize; ++j) {
      // Each block is evaluated for the values of one sample; the values do not suit the other
      // samples' weights.
      const Values r = random_values(random_, at(weights_, j));
      evaluate_float(r, kBlockSize, shares_, out_.data());
      judge(r, j, disturbed(random_, at(weights_, j)), kFloatSmoothBound);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(worst_, kFloatSmoothBound / 2);
}

TEST_F(FloatBounds, AffineValuesAreWithin) {
  for (int i = 0; i < kBlocks; ++i) {
    const int exponent = random_.pick({0, 0, 0, 500, -500, random_.between(-500, 500)});
    // The factors are w_i / (|det| T), where |det| T = Σ w_i E_i is 1 for all samples, as in a
    // triangle.
    Three w{};
    for (double& value : w) value = std::abs(random_.number(24, -20, 20));
    const Three factors{std::ldexp(w[0], exponent), std::ldexp(w[1], exponent),
                        std::ldexp(w[2], exponent)};
    for (std::size_t j = 0; j < kBlockSize; ++j) {
      Three e = random_shares(random_);
      const double sum = e[0] + e[1] + e[2];
      for (std::size_t k = 0; k < 3; ++k) e[k] = e[k] / sum / factors[k];
      put(e, j, weights_);
    }
    float_affine_weights(weights_, factors, kBlockSize, shares_);
    for (std::size_t j = 0; j < kBlockSize; ++j) {
      const Three e = at(weights_, j);
      const Three shares{e[0] * factors[0], e[1] * factors[1], e[2] * factors[2]};
      const Values r = random_values(random_, shares);
      evaluate_float(r, kBlockSize, shares_, out_.data());
      judge(r, j, disturbed(random_, shares), kFloatAffineBound);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(worst_, kFloatAffineBound / 2);
}

// The worst case that a search of some 10^9 samples found: the bounds are close to the true errors.
// Kills: a bound that grows; an order of operations other than the derived one.
TEST_F(FloatBounds, AreNearlyAttained) {
  const auto error_at_first = [&](const Three& e, const Values& r, bool is_smooth) {
    put(e, 0, weights_);
    if (is_smooth) {
      float_smooth_weights(weights_, 1, 1, shares_);
    } else {
      float_affine_weights(weights_, {1, 1, 1}, 1, shares_);
    }
    evaluate_float(r, 1, shares_, out_.data());
    return scale_ulps(out_[0], r, {e[0], e[1], e[2]});
  };
  const double smooth =
      error_at_first({0x1.00421d000001ep+0, 0x1.02c27affffff5p+0, 0x1.0275930000002p+0},
                     {0x1.fca67cp+0F, -0x1.fe58eap+0F, 0x1.e4602cp+0F}, true);
  EXPECT_NEAR(smooth, 6.197, 0.001);
  const double affine =
      error_at_first({0x1.55ad83000002p-2, 0x1.57b869ffffe0fp-2, 0x1.529a1300001dp-2},
                     {0x1.ff52e8p+0F, -0x1.ffb17ep+0F, 0x1.fce92p+0F}, false);
  EXPECT_NEAR(affine, 3.662, 0.001);
}

TEST(FloatPrecision, HoldsWhatDoesNotOverflow) {
  const float most = std::nextafter(0x1p127F, 0.0F);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(fits_float_precision({most, -most, 0}));
  EXPECT_TRUE(std::isfinite(most - -most));
  for (const float value : {0x1p127F, -0x1p127F, std::numeric_limits<float>::infinity(), nan}) {
    EXPECT_FALSE(fits_float_precision({value, 0, 0}));
    EXPECT_FALSE(fits_float_precision({0, value, 0}));
    EXPECT_FALSE(fits_float_precision({0, 0, value}));
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::float_kernels_test
