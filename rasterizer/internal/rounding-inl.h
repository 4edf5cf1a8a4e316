// Doubles rounded to float32. Included once for each SIMD target, as Highway has it.

#include <array>
#include <cstddef>

#if defined(RASTERCHECK_ROUNDING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_ROUNDING_INL_H_
#undef RASTERCHECK_ROUNDING_INL_H_
#else
#define RASTERCHECK_ROUNDING_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The nearest floats, infinite where a number is beyond them all.
template <class F>
HWY_INLINE hn::Vec<F> RoundToFloats(F floats, hn::Vec<hn::Rebind<double, F>> values) {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
  // There DemoteTo holds numbers to the greatest of float32.
  const hn::Rebind<double, F> doubles;
  alignas(16) std::array<double, 2> from{};
  alignas(16) std::array<float, 4> to{};
  hn::Store(values, doubles, from.data());
  for (std::size_t i = 0; i < hn::Lanes(doubles); ++i) to[i] = static_cast<float>(from[i]);
  return hn::Load(floats, to.data());
#else
  return hn::DemoteTo(floats, values);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#endif  // RASTERCHECK_ROUNDING_INL_H_
