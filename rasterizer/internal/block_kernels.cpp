// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/block_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/block_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

#include "rasterizer/internal/evaluation-inl.h"
#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

BlockCoverage EvaluateEdges(const EdgeRow& row, int first, int count, BlockWeights& weights) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto two = hn::Set(d, 2.0);
  const auto scale = hn::Set(d, row.scale);
  const auto shift = hn::Set(d, row.shift);
  BlockCoverage coverage;
  for (int j = 0; j < count; j += lanes) {
    const auto position = hn::Iota(d, first + row.offset + j);
    const auto u = hn::Mul(scale, hn::Sub(hn::Mul(two, position), shift));
    hn::Store(u, d, weights.u.data() + j);
    auto possible = hn::FirstN(d, static_cast<std::size_t>(count - j));
    auto sure = possible;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = OnPlane(row.a[i], u, row.row[i]);
      hn::Store(e, d, weights.e[i].data() + j);
      const auto band = hn::Set(d, row.band[i]);
      possible = hn::And(possible, hn::Ge(e, hn::Neg(band)));
      sure = hn::And(sure, hn::Gt(e, band));
    }
    coverage.possible |= BitsOf(d, possible) << j;
    coverage.sure |= BitsOf(d, sure) << j;
  }
  return coverage;
}

/// The plane's values for the samples from j.
HWY_INLINE Vector Along(const PlaneRow& plane, const BlockWeights& weights, int j) {
  return OnPlane(plane.a, hn::Load(Doubles(), weights.u.data() + j), plane.row);
}

std::uint64_t SumWeights(const PlaneRow& plane, double least, int count, BlockWeights& weights) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  std::uint64_t above = 0;
  for (int j = 0; j < count; j += lanes) {
    const auto sum = Along(plane, weights, j);
    hn::Store(Reciprocal(sum), d, weights.reciprocal.data() + j);
    above |= BitsOf(d, hn::Gt(sum, hn::Set(d, least))) << j;
  }
  return above;
}

HWY_INLINE void StoreValue(Vector value, float* out) {
  hn::StoreU(RoundToFloats(value), Halves(), out);
}
HWY_INLINE void StoreValue(Vector value, double* out) { hn::StoreU(value, Doubles(), out); }

template <typename T>
HWY_INLINE void Smooth(const PlaneRow& numerator, int count, const BlockWeights& weights, T* out) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int j = 0; j < count; j += lanes) {
    const auto reciprocal = hn::Load(d, weights.reciprocal.data() + j);
    StoreValue(hn::Mul(Along(numerator, weights, j), reciprocal), out + j);
  }
}

template <typename T>
HWY_INLINE void Affine(const PlaneRow& plane, int count, const BlockWeights& weights, T* out) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int j = 0; j < count; j += lanes) StoreValue(Along(plane, weights, j), out + j);
}

/// Passes clamped depths to put(j, depth).
template <typename Put>
HWY_INLINE void Depth(const PlaneRow& plane, double least, double greatest, int count,
                      const BlockWeights& weights, const Put& put) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int j = 0; j < count; j += lanes) {
    put(j, Clamped(Along(plane, weights, j), least, greatest));
  }
}

void EvaluateSmooth(const PlaneRow& numerator, int count, const BlockWeights& weights, float* out) {
  Smooth(numerator, count, weights, out);
}

void EvaluateAffine(const PlaneRow& plane, int count, const BlockWeights& weights, float* out) {
  Affine(plane, count, weights, out);
}

void EvaluateDepth(const PlaneRow& plane, double least, double greatest, double steps, int count,
                   const BlockWeights& weights, float* out) {
  if (steps == 0) {
    Depth(plane, least, greatest, count, weights,
          [out](int j, Vector depth) HWY_ATTR { StoreValue(depth, out + j); });
  } else {
    Depth(plane, least, greatest, count, weights, [out, steps](int j, Vector depth) HWY_ATTR {
      hn::StoreU(StoredInSteps(depth, steps), Halves(), out + j);
    });
  }
}

void SmoothInDouble(const PlaneRow& numerator, int count, const BlockWeights& weights,
                    double* out) {
  Smooth(numerator, count, weights, out);
}

void AffineInDouble(const PlaneRow& plane, int count, const BlockWeights& weights, double* out) {
  Affine(plane, count, weights, out);
}

void DepthInDouble(const PlaneRow& plane, double least, double greatest, int count,
                   const BlockWeights& weights, double* out) {
  Depth(plane, least, greatest, count, weights,
        [out](int j, Vector depth) HWY_ATTR { StoreValue(depth, out + j); });
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(EvaluateEdges);
HWY_EXPORT(SumWeights);
HWY_EXPORT(EvaluateSmooth);
HWY_EXPORT(EvaluateAffine);
HWY_EXPORT(EvaluateDepth);
HWY_EXPORT(SmoothInDouble);
HWY_EXPORT(AffineInDouble);
HWY_EXPORT(DepthInDouble);

BlockCoverage evaluate_edges(const EdgeRow& row, int first, int count, BlockWeights& weights) {
  return HWY_DYNAMIC_DISPATCH(EvaluateEdges)(row, first, count, weights);
}

std::uint64_t sum_weights(const PlaneRow& sum, double least, int count, BlockWeights& weights) {
  return HWY_DYNAMIC_DISPATCH(SumWeights)(sum, least, count, weights);
}

void evaluate_smooth(const PlaneRow& numerator, int count, const BlockWeights& weights,
                     float* out) {
  HWY_DYNAMIC_DISPATCH(EvaluateSmooth)(numerator, count, weights, out);
}

void evaluate_affine(const PlaneRow& plane, int count, const BlockWeights& weights, float* out) {
  HWY_DYNAMIC_DISPATCH(EvaluateAffine)(plane, count, weights, out);
}

void evaluate_depth(const PlaneRow& plane, double least, double greatest, double steps, int count,
                    const BlockWeights& weights, float* out) {
  HWY_DYNAMIC_DISPATCH(EvaluateDepth)(plane, least, greatest, steps, count, weights, out);
}

void evaluate_smooth(const PlaneRow& numerator, int count, const BlockWeights& weights,
                     double* out) {
  HWY_DYNAMIC_DISPATCH(SmoothInDouble)(numerator, count, weights, out);
}

void evaluate_affine(const PlaneRow& plane, int count, const BlockWeights& weights, double* out) {
  HWY_DYNAMIC_DISPATCH(AffineInDouble)(plane, count, weights, out);
}

void evaluate_depth(const PlaneRow& plane, double least, double greatest, int count,
                    const BlockWeights& weights, double* out) {
  HWY_DYNAMIC_DISPATCH(DepthInDouble)(plane, least, greatest, count, weights, out);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
