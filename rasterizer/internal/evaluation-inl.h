// Serves every route (docs/rasterizer.md, Routes).
//
// The evaluator of a triangle's depth and attributes (exact_values.h, plane.h) for a vector of
// samples, in double and before any rounding. Small triangles, tiles and cells share all of it:
// each caller supplies its planes and samples, and receives the values. Blocks of fragments, which
// decide attribute by attribute whether double suffices, share the operations. Included once per
// SIMD target, as Highway requires.

#include <cstddef>

#if defined(RASTERCHECK_EVALUATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_EVALUATION_INL_H_
#undef RASTERCHECK_EVALUATION_INL_H_
#else
#define RASTERCHECK_EVALUATION_INL_H_
#endif

#include <hwy/highway.h>

#include "rasterizer/internal/depth_store.h"
#include "rasterizer/internal/vectors-inl.h"
#include "rasterizer/rasterizer.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// A U + (B V + C), with `row` = B V + C.
HWY_INLINE Vector OnPlane(Vector a, Vector u, Vector row) { return hn::Add(hn::Mul(a, u), row); }

/// A U + `row` for one row of samples.
HWY_INLINE Vector OnPlane(double a, Vector u, double row) {
  const Doubles d;
  return OnPlane(hn::Set(d, a), u, hn::Set(d, row));
}

HWY_INLINE Vector Clamped(Vector depth, double least, double greatest) {
  const Doubles d;
  return hn::Min(hn::Max(depth, hn::Set(d, least)), hn::Set(d, greatest));
}

/// The numbers stored for clamped depths in a unorm format: stored() (depth_store.h).
HWY_INLINE hn::Vec<Halves> StoredInSteps(Vector depth, double steps) {
  const Doubles d;
  const auto to_whole = hn::Set(d, kToWhole);
  const auto all = hn::Set(d, steps);
  const auto k = hn::Sub(hn::Add(hn::Mul(depth, all), to_whole), to_whole);
  return hn::DemoteTo(Halves(), hn::Div(k, all));
}

/// The numbers stored for clamped depths.
HWY_INLINE hn::Vec<Halves> Stored(Vector depth, double steps) {
  if (HWY_UNLIKELY(steps != 0)) return StoredInSteps(depth, steps);
  return hn::DemoteTo(Halves(), depth);
}

/// 1 / Σ E_i.
HWY_INLINE Vector Reciprocal(Vector sum) { return hn::Div(hn::Set(Doubles(), 1.0), sum); }

/// Evaluates the attributes of a vector of samples. `Planes` has the members
///
///   Count()            number of attributes
///   HasSmooth()        true if any attribute is smooth
///   InterpolationOf(a)
///   Sum()              Σ E_i, the denominator of smooth attributes
///   Value(a)           the numerator of a smooth attribute, or a noperspective attribute itself
///   Flat(a)            a flat attribute itself
///
/// Calls take(a, value, reciprocal) for each attribute. `reciprocal` is 1 / Sum(), or 0 if no
/// attribute is smooth.
template <class Planes, class Take>
HWY_INLINE void EvaluateAttributes(const Planes& planes, const Take& take) {
  auto reciprocal = hn::Zero(Doubles());
  if (planes.HasSmooth()) reciprocal = Reciprocal(planes.Sum());
  for (std::size_t a = 0; a < planes.Count(); ++a) {
    const Interpolation interpolation = planes.InterpolationOf(a);
    if (interpolation == Interpolation::flat) {
      take(a, planes.Flat(a), reciprocal);
    } else if (interpolation == Interpolation::noperspective) {
      take(a, planes.Value(a), reciprocal);
    } else {
      take(a, hn::Mul(planes.Value(a), reciprocal), reciprocal);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#endif  // RASTERCHECK_EVALUATION_INL_H_
