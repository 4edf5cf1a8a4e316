// Serves every route (docs/rasterizer.md, Routes).
//
// Common parts of the kernels: their vectors, masks as bits, rounding to float32. Included once for
// each SIMD target, as Highway requires.

#include <array>
#include <cstddef>
#include <cstdint>

#if defined(RASTERCHECK_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_VECTORS_INL_H_
#undef RASTERCHECK_VECTORS_INL_H_
#else
#define RASTERCHECK_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// At most sixteen lanes: masks are two bytes, and sixteen numbers are whole vectors of any kind.
using Floats = hn::CappedTag<float, 16>;
using Doubles = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Doubles>;
// The following have as many lanes as Doubles.
using Halves = hn::Rebind<float, Doubles>;
using Ints = hn::Rebind<std::int32_t, Doubles>;
using Words = hn::RebindToUnsigned<Doubles>;
using HalfWords = hn::RebindToUnsigned<Halves>;

/// The bits of a mask; bit i is lane i.
template <class D>
HWY_INLINE std::uint64_t BitsOf(D d, hn::Mask<D> lanes) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, lanes, bytes.data());
  return bytes[0] | std::uint64_t{bytes[1]} << 8;
}

/// The lanes whose bits are set; ignores bits beyond the lanes.
template <class D>
HWY_INLINE hn::Mask<D> MaskOf(D d, std::uint64_t bits) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  bytes[0] = static_cast<std::uint8_t>(bits);
  bytes[1] = static_cast<std::uint8_t>(bits >> 8);
  return hn::LoadMaskBits(d, bytes.data());
}

#if HWY_TARGET <= HWY_AVX3
constexpr bool kStoresMasked = true;
#else
constexpr bool kStoresMasked = false;
#endif

/// Stores `value` in the given lanes of `out`, and leaves the other lanes unchanged.
template <class D>
HWY_INLINE void PutWhere(D d, hn::Mask<D> lanes, hn::Vec<D> value, hn::TFromD<D>* out) {
  if (kStoresMasked) {
    hn::BlendedStore(value, lanes, d, out);
  } else {
    hn::StoreU(hn::IfThenElse(lanes, value, hn::LoadU(d, out)), d, out);
  }
}

/// The nearest floats; infinite if beyond the range of float.
HWY_INLINE hn::Vec<Halves> RoundToFloats(Vector values) {
  const Halves floats;
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
  // On these targets DemoteTo clamps numbers to the greatest float.
  const Doubles doubles;
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

#endif  // RASTERCHECK_VECTORS_INL_H_
