// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/coordinate_kernels.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/coordinate_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// Wraps any s to [0, 1].
template <Wrap kWrap>
HWY_INLINE Vector Wrapped(Vector s) {
  const Doubles d;
  const auto one = hn::Set(d, 1.0);
  auto c = s;
  if (kWrap == Wrap::repeat) c = hn::Sub(s, hn::Floor(s));
  if (kWrap == Wrap::mirror) {
    const auto two = hn::Set(d, 2.0);
    const auto m = hn::Sub(s, hn::Mul(two, hn::Floor(hn::Mul(s, hn::Set(d, 0.5)))));
    c = hn::IfThenElse(hn::Lt(m, one), m, hn::Sub(two, m));
  }
  c = hn::IfThenElseZero(hn::Gt(c, hn::Zero(d)), c);
  return kWrap == Wrap::clamp ? hn::Min(c, one) : c;
}

/// The error bound of c · size (find_texels).
HWY_INLINE Vector MarginOf(Vector s, double error, double size) {
  const Doubles d;
  const auto own = hn::Mul(hn::Abs(s), hn::Set(d, FragmentBatch::kErrorShare));
  const auto e = hn::Max(own, hn::Set(d, error));
  return hn::Mul(hn::Add(e, hn::Set(d, 0x1p-51)), hn::Set(d, size));
}

template <Wrap kWrap>
HWY_INLINE LaneMask FindTexelsAlong(const TextureAxis& axis, double error, std::size_t lanes,
                                    std::int32_t* at) {
  const Doubles d;
  const Ints integers;
  const double texels = axis.size;
  const double infinity = std::numeric_limits<double>::infinity();
  const double most = error < infinity ? error : infinity;  // `error` may be NaN
  const auto quarter = hn::Set(d, 0.25);
  const auto one = hn::Set(d, 1.0);
  const auto size = hn::Set(d, texels);
  const auto before_last = hn::Set(d, texels - 1);
  const auto last = hn::Set(integers, axis.size - 1);
  LaneMask open{};
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    const auto s = hn::Load(d, axis.values + i);
    const auto p = hn::Mul(Wrapped<kWrap>(s), size);
    // Rounds towards 0, which is down because p >= 0.
    hn::Store(hn::Min(hn::DemoteTo(integers, p), last), integers, at + i);
    if (axis.size == 1) continue;
    const auto margin = MarginOf(s, most, texels);
    const auto nearest = hn::Round(p);
    auto is_certain = hn::Gt(hn::Abs(hn::Sub(p, nearest)), margin);
    if (kWrap != Wrap::repeat) {
      const auto is_edge = hn::Or(hn::Lt(nearest, one), hn::Gt(nearest, before_last));
      is_certain = hn::Or(is_certain, is_edge);
    }
    // If the margin is NaN, the texel is not certain.
    is_certain = hn::And(is_certain, hn::Lt(margin, quarter));
    if (!hn::AllTrue(d, is_certain)) open[i / 64] |= BitsOf(d, hn::Not(is_certain)) << i % 64;
  }
  return open;
}

LaneMask FindTexels(const TextureAxis& axis, double error, std::size_t lanes, std::int32_t* at) {
  switch (axis.wrap) {
    case Wrap::repeat:
      return FindTexelsAlong<Wrap::repeat>(axis, error, lanes, at);
    case Wrap::clamp:
      return FindTexelsAlong<Wrap::clamp>(axis, error, lanes, at);
    case Wrap::mirror:
      break;
  }
  return FindTexelsAlong<Wrap::mirror>(axis, error, lanes, at);
}

/// Sizes of levels: the same for all lanes (SameSize), or one per lane (OwnSizes).
class SameSize {
 public:
  HWY_INLINE explicit SameSize(double size) : size_(size) {}
  HWY_INLINE Vector At(std::size_t /*lane*/) const { return hn::Set(Doubles(), size_); }

 private:
  const double size_;
};
class OwnSizes {
 public:
  HWY_INLINE OwnSizes(double size, const double* shrink) : size_(size), shrink_(shrink) {}
  HWY_INLINE Vector At(std::size_t lane) const {
    const Doubles d;
    const auto size = hn::Mul(hn::Set(d, size_), hn::Load(d, shrink_ + lane));
    return hn::Max(hn::Floor(size), hn::Set(d, 1.0));
  }

 private:
  const double size_;
  const double* const shrink_;
};

template <Wrap kWrap, class Sizes>
HWY_INLINE void FindNeighborsAlong(const double* values, std::size_t lanes, const Sizes& sizes,
                                   Neighbors& out) {
  const Doubles d;
  const Halves floats;
  const Ints integers;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    const auto p = hn::Mul(Wrapped<kWrap>(hn::Load(d, values + i)), sizes.At(i));
    const auto x = hn::Sub(p, hn::Set(d, 0.5));
    const auto low = hn::Floor(x);
    hn::Store(hn::DemoteTo(integers, low), integers, out.low.data() + i);
    hn::Store(hn::DemoteTo(floats, hn::Sub(x, low)), floats, out.fraction.data() + i);
  }
}

template <class Sizes>
HWY_INLINE void FindNeighborsIn(const TextureAxis& axis, std::size_t lanes, const Sizes& sizes,
                                Neighbors& out) {
  switch (axis.wrap) {
    case Wrap::repeat:
      return FindNeighborsAlong<Wrap::repeat>(axis.values, lanes, sizes, out);
    case Wrap::clamp:
      return FindNeighborsAlong<Wrap::clamp>(axis.values, lanes, sizes, out);
    case Wrap::mirror:
      return FindNeighborsAlong<Wrap::mirror>(axis.values, lanes, sizes, out);
  }
}

void FindNeighbors(const TextureAxis& axis, std::size_t lanes, Neighbors& out) {
  FindNeighborsIn(axis, lanes, SameSize(axis.size), out);
}

void FindNeighborsOfLevels(const TextureAxis& axis, std::size_t lanes, double factor,
                           const double* shrink, Neighbors& out) {
  FindNeighborsIn(axis, lanes, OwnSizes(axis.size * factor, shrink), out);
}

/// log2 of a finite x >= 1 (find_levels).
HWY_INLINE Vector Log2(Vector x) {
  const Doubles d;
  const Words bits;
  const auto one = hn::Set(d, 1.0);
  const auto pattern = hn::BitCast(bits, x);
  // The exponent plus 1023 becomes the last bits of a double that is at least 2^52.
  const auto shift = hn::BitCast(bits, hn::Set(d, 0x1p52));
  const auto exponent = hn::BitCast(d, hn::Or(hn::ShiftRight<52>(pattern), shift));
  const auto fraction = hn::And(pattern, hn::Set(bits, (std::uint64_t{1} << 52) - 1));
  auto m = hn::BitCast(d, hn::Or(fraction, hn::BitCast(bits, one)));
  auto e = hn::Sub(exponent, hn::Set(d, 0x1p52 + 1023));
  const auto is_high = hn::Gt(m, hn::Set(d, 0x1.6a09e667f3bcdp0));
  m = hn::IfThenElse(is_high, hn::Mul(m, hn::Set(d, 0.5)), m);
  e = hn::IfThenElse(is_high, hn::Add(e, one), e);
  const auto z = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  const auto square = hn::Mul(z, z);
  // The coefficients are 2 / ln 2 divided by 11, 9, … 1.
  const double factor = 0x1.71547652b82fep1;
  auto sum = hn::Set(d, factor / 11);
  for (int n = 9; n > 0; n -= 2) {
    sum = hn::Add(hn::Mul(sum, square), hn::Set(d, factor / n));
  }
  return hn::Add(e, hn::Mul(sum, z));
}

/// s² + t²; 1 if that is less than 1 or NaN.
HWY_INLINE Vector SquareFromOne(Vector s, Vector t) {
  const auto one = hn::Set(Doubles(), 1.0);
  const auto square = hn::Add(hn::Mul(s, s), hn::Mul(t, t));
  return hn::IfThenElse(hn::Gt(square, one), square, one);
}

bool FindLevels(const CoordinateSlopes& slopes, double width, double height, int last,
                std::size_t lanes, LevelsOfDetail& levels) {
  const Doubles d;
  const Words bits;
  const Halves floats;
  const Ints integers;
  const auto one = hn::Set(d, 1.0);
  const auto w = hn::Set(d, width);
  const auto h = hn::Set(d, height);
  const auto greatest = hn::Set(d, static_cast<double>(std::uint64_t{1} << (2 * last)));
  auto is_above = hn::Gt(one, one);
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    const auto along_u = SquareFromOne(hn::Mul(hn::Load(d, slopes.s_u + i), w),
                                       hn::Mul(hn::Load(d, slopes.t_u + i), h));
    const auto along_v = SquareFromOne(hn::Mul(hn::Load(d, slopes.s_v + i), w),
                                       hn::Mul(hn::Load(d, slopes.t_v + i), h));
    const auto square = hn::Min(hn::Max(along_u, along_v), greatest);
    const auto has_lambda = hn::Gt(square, one);
    is_above = hn::Or(is_above, has_lambda);
    auto lambda = hn::Zero(d);
    if (!hn::AllFalse(d, has_lambda)) lambda = hn::Mul(Log2(square), hn::Set(d, 0.5));
    const auto level = hn::Floor(lambda);
    // The last bits of the difference, 1023 − level, are the exponent of 2^-level.
    const auto exponent = hn::Sub(hn::Set(d, 0x1p52 + 1023), level);
    const auto shrink = hn::BitCast(d, hn::ShiftLeft<52>(hn::BitCast(bits, exponent)));
    hn::Store(shrink, d, levels.shrink.data() + i);
    hn::Store(hn::DemoteTo(integers, level), integers, levels.level.data() + i);
    hn::Store(hn::DemoteTo(floats, hn::Sub(lambda, level)), floats, levels.fraction.data() + i);
  }
  return !hn::AllFalse(d, is_above);
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(FindTexels);
HWY_EXPORT(FindNeighbors);
HWY_EXPORT(FindNeighborsOfLevels);
HWY_EXPORT(FindLevels);

LaneMask find_texels(const TextureAxis& axis, double error, std::size_t lanes, std::int32_t* at) {
  return HWY_DYNAMIC_DISPATCH(FindTexels)(axis, error, lanes, at);
}

void find_neighbors(const TextureAxis& axis, std::size_t lanes, Neighbors& neighbors) {
  HWY_DYNAMIC_DISPATCH(FindNeighbors)(axis, lanes, neighbors);
}

void find_neighbors(const TextureAxis& axis, std::size_t lanes, double factor, const double* shrink,
                    Neighbors& neighbors) {
  HWY_DYNAMIC_DISPATCH(FindNeighborsOfLevels)(axis, lanes, factor, shrink, neighbors);
}

bool find_levels(const CoordinateSlopes& slopes, double width, double height, int last,
                 std::size_t lanes, LevelsOfDetail& levels) {
  return HWY_DYNAMIC_DISPATCH(FindLevels)(slopes, width, height, last, lanes, levels);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
