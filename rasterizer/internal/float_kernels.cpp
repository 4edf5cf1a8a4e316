// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/float_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/float_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// factor · E_i of the samples from j in float32, 0 unless positive. Reads less than a vector of
/// doubles beyond `count`; numbers farther on may be uninitialised.
template <class D>
auto Share(D floats, const double* e, double factor, int j, [[maybe_unused]] int count) {
#if HWY_TARGET == HWY_SCALAR
  const hn::Rebind<double, D> doubles;
  const auto share =
      hn::DemoteTo(floats, hn::Mul(hn::Load(doubles, e + j), hn::Set(doubles, factor)));
#else
  const hn::Repartition<double, D> doubles;
  const hn::Half<D> halves;
  const int lanes = static_cast<int>(hn::Lanes(doubles));
  const auto times = hn::Set(doubles, factor);
  const auto lower = hn::DemoteTo(halves, hn::Mul(hn::Load(doubles, e + j), times));
  auto upper = hn::Zero(halves);
  if (j + lanes < count) {
    upper = hn::DemoteTo(halves, hn::Mul(hn::Load(doubles, e + j + lanes), times));
  }
  const auto share = hn::Combine(floats, upper, lower);
#endif
  return hn::IfThenElseZero(hn::Gt(share, hn::Zero(floats)), share);
}

/// Computes the shares factors_i · E_i, divided by their sum if `kIsSmooth`.
template <bool kIsSmooth>
void SetUpWeights(const BlockWeights& weights, const std::array<double, 3>& factors, int count,
                  FloatWeights& out) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto zero = hn::Zero(d);
  for (int j = 0; j < count; j += lanes) {
    const auto f0 = Share(d, weights.e[0].data(), factors[0], j, count);
    const auto f1 = Share(d, weights.e[1].data(), factors[1], j, count);
    const auto f2 = Share(d, weights.e[2].data(), factors[2], j, count);

    // The pivot: the first of the largest.
    const auto second_beats_first = hn::Gt(f1, f0);
    const auto is_2 = hn::Gt(f2, hn::IfThenElse(second_beats_first, f1, f0));
    const auto is_1 = hn::AndNot(is_2, second_beats_first);
    const auto is_1_index = hn::IfThenElseZero(is_1, hn::Set(d, 1.0F));
    hn::Store(hn::IfThenElse(is_2, hn::Set(d, 2.0F), is_1_index), d, out.pivot.data() + j);

    // The shares of the two vertices after the pivot.
    auto next = hn::IfThenElse(is_2, f0, hn::IfThenElse(is_1, f2, f1));
    auto last = hn::IfThenElse(is_2, f1, hn::IfThenElse(is_1, f0, f2));
    if constexpr (kIsSmooth) {
      const auto pivot = hn::IfThenElse(is_2, f2, hn::IfThenElse(is_1, f1, f0));
      const auto sum = hn::Add(hn::Add(next, last), pivot);
      next = hn::Div(next, sum);
      last = hn::Div(last, sum);
    }

    // The edge that ends at the pivot is followed backwards, so its step is negative.
    const auto back = hn::Neg(last);
    const auto step0 = hn::IfThenElse(is_2, zero, hn::IfThenElse(is_1, back, next));
    const auto step1 = hn::IfThenElse(is_2, back, hn::IfThenElseZero(is_1, next));
    const auto step2 = hn::IfThenElse(is_2, next, hn::IfThenZeroElse(is_1, back));
    hn::Store(step0, d, out.steps[0].data() + j);
    hn::Store(step1, d, out.steps[1].data() + j);
    hn::Store(step2, d, out.steps[2].data() + j);
  }
}

void FloatSmoothWeights(const BlockWeights& weights, double scale, int count, FloatWeights& out) {
  SetUpWeights<true>(weights, {scale, scale, scale}, count, out);
}

void FloatAffineWeights(const BlockWeights& weights, const std::array<double, 3>& factors,
                        int count, FloatWeights& out) {
  SetUpWeights<false>(weights, factors, count, out);
}

void EvaluateFloat(const std::array<float, 3>& r, int count, const FloatWeights& weights,
                   float* out) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto r0 = hn::Set(d, r[0]);
  const auto r1 = hn::Set(d, r[1]);
  const auto r2 = hn::Set(d, r[2]);
  const auto difference0 = hn::Sub(r1, r0);
  const auto difference1 = hn::Sub(r2, r1);
  const auto difference2 = hn::Sub(r0, r2);
  const auto one = hn::Set(d, 1.0F);
  for (int j = 0; j < count; j += lanes) {
    const auto pivot = hn::Load(d, weights.pivot.data() + j);
    const auto start =
        hn::IfThenElse(hn::Gt(pivot, one), r2, hn::IfThenElse(hn::Eq(pivot, one), r1, r0));
    const auto step0 = hn::Mul(difference0, hn::Load(d, weights.steps[0].data() + j));
    const auto step1 = hn::Mul(difference1, hn::Load(d, weights.steps[1].data() + j));
    const auto step2 = hn::Mul(difference2, hn::Load(d, weights.steps[2].data() + j));
    hn::StoreU(hn::Add(start, hn::Add(hn::Add(step0, step1), step2)), d, out + j);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(FloatSmoothWeights);
HWY_EXPORT(FloatAffineWeights);
HWY_EXPORT(EvaluateFloat);

void float_smooth_weights(const BlockWeights& weights, double scale, int count, FloatWeights& out) {
  HWY_DYNAMIC_DISPATCH(FloatSmoothWeights)(weights, scale, count, out);
}

void float_affine_weights(const BlockWeights& weights, const std::array<double, 3>& factors,
                          int count, FloatWeights& out) {
  HWY_DYNAMIC_DISPATCH(FloatAffineWeights)(weights, factors, count, out);
}

bool fits_float_precision(const std::array<float, 3>& r) {
  return std::abs(r[0]) < 0x1p127F && std::abs(r[1]) < 0x1p127F && std::abs(r[2]) < 0x1p127F;
}

void evaluate_float(const std::array<float, 3>& r, int count, const FloatWeights& weights,
                    float* out) {
  HWY_DYNAMIC_DISPATCH(EvaluateFloat)(r, count, weights, out);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
