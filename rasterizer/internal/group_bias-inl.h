// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// The offsets of the depths of triangles in the lanes of vectors, in double: the operations of
// level_offset() and sloped_offset() (depth_bias.h). Included once per SIMD target, as Highway
// requires.

#include <cstdint>

#if defined(RASTERCHECK_GROUP_BIAS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_GROUP_BIAS_INL_H_
#undef RASTERCHECK_GROUP_BIAS_INL_H_
#else
#define RASTERCHECK_GROUP_BIAS_INL_H_
#endif

#include <hwy/highway.h>

#include "rasterizer/internal/depth_bias.h"
#include "rasterizer/internal/group_lanes-inl.h"
#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// Offsets, and the lanes in which double suffices for them.
struct OffsetLanes {
  Vector value;
  Lanes certain;
};

/// 2^e <= number < 2^(e + 1); 0 for 0. No number is negative.
HWY_INLINE Vector PowersBelow(Vector numbers) {
  const Words words;
  return hn::BitCast(Doubles(),
                     hn::And(hn::BitCast(words, numbers), hn::Set(words, kExponentBits)));
}

/// r · constant.
HWY_INLINE OffsetLanes LevelsOf(const BiasTerms& bias, const Corners& p) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  const Lanes all = hn::FirstN(d, hn::Lanes(d));
  if (bias.constant == 0) return {zero, all};
  if (bias.unit != 0) return {hn::Set(d, bias.unit * bias.constant), all};
  const auto most = hn::Set(d, bias.greatest);
  auto greatest = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto quotient = hn::Div(p.z[i], p.w[i]);
    auto depth = hn::Add(hn::Set(d, bias.low), hn::Mul(hn::Set(d, bias.span), quotient));
    depth = hn::Min(hn::Max(depth, hn::Set(d, bias.least)), most);
    greatest = hn::Max(greatest, hn::IfThenElse(hn::Gt(p.w[i], zero), depth, most));
  }
  const auto error = hn::Set(d, bias.exponent_error);
  const auto below = PowersBelow(hn::Max(hn::Sub(greatest, error), zero));
  const auto above = PowersBelow(hn::Add(greatest, error));
  return {hn::Mul(hn::Mul(below, hn::Set(d, kFloatStep)), hn::Set(d, bias.constant)),
          hn::Eq(below, above)};
}

/// The offsets of triangles whose depths, without bias, are on these planes. `is_level`: planes of
/// constant depth. `scale` is the factor of the planes' sums.
HWY_INLINE OffsetLanes OffsetsOf(const KernelSetting& setting, const Corners& p, const Edges& edges,
                                 const PlaneLanes& plane, Vector scale, Lanes is_level) {
  const Doubles d;
  const BiasTerms& bias = setting.bias;
  const auto greatest = hn::Set(d, bias.greatest);
  OffsetLanes offset = LevelsOf(bias, p);
  if (bias.slope != 0) {
    const auto u_step = hn::Set(d, std::abs(setting.u_step));
    const auto v_step = hn::Set(d, std::abs(setting.v_step));
    const auto size = hn::Abs(scale);
    const auto u_size = hn::Mul(hn::Mul(SumOfSizes(p.z, edges.a), size), u_step);
    const auto v_size = hn::Mul(hn::Mul(SumOfSizes(p.z, edges.b), size), v_step);
    const auto steepness =
        hn::Max(hn::Mul(hn::Abs(plane.a), u_step), hn::Mul(hn::Abs(plane.b), v_step));
    const auto rise = hn::Mul(hn::Set(d, bias.slope), steepness);
    const auto terms = hn::Add(hn::Mul(hn::Set(d, std::abs(bias.slope)), hn::Max(u_size, v_size)),
                               hn::Abs(offset.value));
    const auto most_terms = hn::Mul(hn::Set(d, kMostBiasTerms), greatest);
    const auto most_rise = hn::Mul(hn::Set(d, kMostBiasRise), greatest);
    const Lanes is_small = hn::And(hn::Le(terms, most_terms), hn::Le(hn::Abs(rise), most_rise));
    offset.certain = hn::And(offset.certain, hn::Or(is_level, is_small));
    offset.value = hn::IfThenElse(is_level, offset.value, hn::Add(rise, offset.value));
  } else {
    const Lanes is_small =
        hn::Le(hn::Abs(offset.value), hn::Mul(hn::Set(d, kMostBiasTerms), greatest));
    offset.certain = hn::And(offset.certain, hn::Or(is_level, is_small));
  }
  const auto clamp = hn::Set(d, bias.clamp);
  if (bias.clamp > 0) offset.value = hn::Min(offset.value, clamp);
  if (bias.clamp < 0) offset.value = hn::Max(offset.value, clamp);
  if (bias.may_leave) {
    offset.certain = hn::And(offset.certain, hn::Le(hn::Abs(offset.value), greatest));
  }
  return offset;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#endif  // RASTERCHECK_GROUP_BIAS_INL_H_
