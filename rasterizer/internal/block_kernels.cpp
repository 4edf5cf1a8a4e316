// Compiled once for each SIMD target; the best that the processor has is chosen at run time.

#include "rasterizer/internal/block_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/block_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include "rasterizer/internal/rounding-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, kBlockSize>;

template <class D, class M>
std::uint64_t bits_of([[maybe_unused]] D d, M mask) {
  alignas(64) std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) bits |= std::uint64_t{bytes[i]} << (8 * i);
  return bits & ((std::uint64_t{1} << hn::Lanes(d)) - 1);
}

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
      const auto e = hn::Add(hn::Mul(hn::Set(d, row.a[i]), u), hn::Set(d, row.row[i]));
      hn::Store(e, d, weights.e[i].data() + j);
      const auto band = hn::Set(d, row.band[i]);
      possible = hn::And(possible, hn::Ge(e, hn::Neg(band)));
      sure = hn::And(sure, hn::Gt(e, band));
    }
    coverage.possible |= bits_of(d, possible) << j;
    coverage.sure |= bits_of(d, sure) << j;
  }
  return coverage;
}

/// The plane's values for the samples from j.
template <class D>
auto Along([[maybe_unused]] D d, const PlaneRow& plane, const BlockWeights& weights, int j) {
  const auto u = hn::Load(d, weights.u.data() + j);
  return hn::Add(hn::Mul(hn::Set(d, plane.a), u), hn::Set(d, plane.row));
}

std::uint64_t SumWeights(const PlaneRow& plane, double least, int count, BlockWeights& weights) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  std::uint64_t above = 0;
  for (int j = 0; j < count; j += lanes) {
    const auto sum = Along(d, plane, weights, j);
    hn::Store(hn::Div(hn::Set(d, 1.0), sum), d, weights.reciprocal.data() + j);
    above |= bits_of(d, hn::Gt(sum, hn::Set(d, least))) << j;
  }
  return above;
}

template <class D, class V>
void StoreRounded([[maybe_unused]] D d, V value, float* out) {
  const hn::Rebind<float, D> floats;
  hn::StoreU(RoundToFloats(floats, value), floats, out);
}

void EvaluateSmooth(const PlaneRow& numerator, int count, const BlockWeights& weights, float* out) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int j = 0; j < count; j += lanes) {
    const auto reciprocal = hn::Load(d, weights.reciprocal.data() + j);
    StoreRounded(d, hn::Mul(Along(d, numerator, weights, j), reciprocal), out + j);
  }
}

void EvaluateAffine(const PlaneRow& plane, int count, const BlockWeights& weights, float* out) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int j = 0; j < count; j += lanes) StoreRounded(d, Along(d, plane, weights, j), out + j);
}

void EvaluateDepth(const PlaneRow& plane, double least, double greatest, int count,
                   const BlockWeights& weights, float* out) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int j = 0; j < count; j += lanes) {
    const auto depth = hn::Max(Along(d, plane, weights, j), hn::Set(d, least));
    StoreRounded(d, hn::Min(depth, hn::Set(d, greatest)), out + j);
  }
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

void evaluate_depth(const PlaneRow& plane, double least, double greatest, int count,
                    const BlockWeights& weights, float* out) {
  HWY_DYNAMIC_DISPATCH(EvaluateDepth)(plane, least, greatest, count, weights, out);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
