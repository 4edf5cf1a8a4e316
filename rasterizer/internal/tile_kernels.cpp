// Compiled once for each SIMD target; the best that the processor has is chosen at run time.

#include "rasterizer/internal/tile_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/tile_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;

void Interleave(std::span<const float* const> rows, std::size_t width, float* out) {
  const Floats d;
  const std::size_t count = rows.size();
  std::size_t i = 0;
  const std::size_t whole = width - width % hn::Lanes(d);
  if (count == 1) {
    for (; i < whole; i += hn::Lanes(d)) hn::StoreU(hn::LoadU(d, rows[0] + i), d, out + i);
  } else if (count == 2) {
    for (; i < whole; i += hn::Lanes(d)) {
      hn::StoreInterleaved2(hn::LoadU(d, rows[0] + i), hn::LoadU(d, rows[1] + i), d, out + 2 * i);
    }
  } else if (count == 4) {
    for (; i < whole; i += hn::Lanes(d)) {
      hn::StoreInterleaved4(hn::LoadU(d, rows[0] + i), hn::LoadU(d, rows[1] + i),
                            hn::LoadU(d, rows[2] + i), hn::LoadU(d, rows[3] + i), d, out + 4 * i);
    }
  }
  for (; i < width; ++i) {
    for (std::size_t k = 0; k < count; ++k) out[count * i + k] = rows[k][i];
  }
}

void Separate(const float* in, std::span<float* const> rows, std::size_t width) {
  const Floats d;
  const std::size_t count = rows.size();
  std::size_t i = 0;
  const std::size_t whole = width - width % hn::Lanes(d);
  if (count == 1) {
    for (; i < whole; i += hn::Lanes(d)) hn::StoreU(hn::LoadU(d, in + i), d, rows[0] + i);
  } else if (count == 2) {
    for (; i < whole; i += hn::Lanes(d)) {
      hn::Vec<Floats> first;
      hn::Vec<Floats> second;
      hn::LoadInterleaved2(d, in + 2 * i, first, second);
      hn::StoreU(first, d, rows[0] + i);
      hn::StoreU(second, d, rows[1] + i);
    }
  } else if (count == 4) {
    for (; i < whole; i += hn::Lanes(d)) {
      std::array<hn::Vec<Floats>, 4> v;
      hn::LoadInterleaved4(d, in + 4 * i, v[0], v[1], v[2], v[3]);
      for (std::size_t k = 0; k < 4; ++k) hn::StoreU(v[k], d, rows[k] + i);
    }
  }
  for (; i < width; ++i) {
    for (std::size_t k = 0; k < count; ++k) rows[k][i] = in[count * i + k];
  }
}

// At most eight lanes: masks are bytes.
using Doubles = hn::CappedTag<double, 8>;
using Halves = hn::Rebind<float, Doubles>;

template <class D, class M>
std::uint64_t bits_of([[maybe_unused]] D d, M mask) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  return bytes[0];
}

struct Weights {
  hn::Vec<Doubles> e0;
  hn::Vec<Doubles> e1;
  hn::Vec<Doubles> e2;
};

/// Σ k_i E_i.
HWY_INLINE hn::Vec<Doubles> Combine(const std::array<double, 3>& k, const Weights& e) {
  const Doubles d;
  const auto first = hn::Mul(hn::Set(d, k[0]), e.e0);
  const auto second = hn::Mul(hn::Set(d, k[1]), e.e1);
  const auto third = hn::Mul(hn::Set(d, k[2]), e.e2);
  return hn::Add(hn::Add(first, second), third);
}

HWY_INLINE hn::Vec<Halves> Depth(const ShadedTriangle& triangle, const Weights& e) {
  const Doubles d;
  const Halves floats;
  if (triangle.has_constant_depth) return hn::Set(floats, triangle.constant_depth);
  const DepthLine& line = triangle.depth;
  const auto z = hn::Mul(Combine(line.k, e), hn::Set(d, line.scale));
  const auto depth = hn::Add(hn::Set(d, line.low), hn::Mul(hn::Set(d, line.span), z));
  return hn::DemoteTo(floats,
                      hn::Min(hn::Max(depth, hn::Set(d, line.least)), hn::Set(d, line.greatest)));
}

std::uint64_t ShadeRow(const ShadedTriangle& triangle, const TileRow& row) {
  const Doubles d;
  const Halves floats;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto zero = hn::Zero(d);
  std::uint64_t left_out = 0;
  for (int j = row.begin - row.begin % lanes; j < row.end; j += lanes) {
    const auto u = hn::LoadU(d, row.u + j);
    auto possible = hn::FirstN(d, static_cast<std::size_t>(row.end - j));
    auto sure = possible;
    const auto edge = [&](std::size_t i) HWY_ATTR {
      const auto e = hn::Add(hn::Mul(hn::Set(d, triangle.a[i]), u), hn::Set(d, row.edge[i]));
      switch (triangle.edges[i]) {
        case ShadedTriangle::Edge::banded: {
          const auto band = hn::Set(d, triangle.band[i]);
          possible = hn::And(possible, hn::Ge(e, hn::Neg(band)));
          sure = hn::And(sure, hn::Gt(e, band));
          break;
        }
        case ShadedTriangle::Edge::open:
          possible = hn::And(possible, hn::Gt(e, zero));
          break;
        case ShadedTriangle::Edge::closed:
          possible = hn::And(possible, hn::Ge(e, zero));
          break;
      }
      return e;
    };
    const Weights e{edge(0), edge(1), edge(2)};
    sure = hn::And(sure, possible);
    std::uint64_t possible_bits = bits_of(d, possible);
    if (j < row.begin) possible_bits &= ~std::uint64_t{0} << (row.begin - j);
    if (possible_bits == 0) continue;
    const auto sum = hn::Add(hn::Add(e.e0, e.e1), e.e2);
    auto drawn = sure;
    if (triangle.has_smooth) drawn = hn::And(drawn, hn::Gt(sum, hn::Set(d, triangle.least_sum)));
    std::uint64_t drawn_bits = bits_of(d, drawn) & possible_bits;
    left_out |= (possible_bits & ~drawn_bits) << j;
    if (drawn_bits == 0) continue;

    const auto depth = Depth(triangle, e);
    const auto old_depth = hn::LoadU(floats, row.depth + j);
    if (triangle.tests_depth) drawn_bits &= bits_of(floats, hn::Lt(depth, old_depth));
    if (drawn_bits == 0) continue;
    alignas(8) std::array<std::uint8_t, 8> bytes{static_cast<std::uint8_t>(drawn_bits)};
    const auto mask = hn::LoadMaskBits(floats, bytes.data());
    const auto put = [&](hn::Vec<Halves> value, float* out) HWY_ATTR {
      hn::StoreU(hn::IfThenElse(mask, value, hn::LoadU(floats, out)), floats, out);
    };
    put(depth, row.depth + j);
    auto reciprocal = zero;
    if (triangle.has_smooth) reciprocal = hn::Div(hn::Set(d, 1.0), sum);
    for (std::size_t a = 0; a < triangle.attributes.size(); ++a) {
      const ShadedValue& value = triangle.attributes[a];
      float* const out = row.attributes[a] + j;
      if (value.kind == ValueKind::copied) {
        put(hn::Set(floats, value.copy), out);
        continue;
      }
      const auto factor =
          value.kind == ValueKind::smooth ? reciprocal : hn::Set(d, triangle.affine_scale);
      put(hn::DemoteTo(floats, hn::Mul(Combine(value.numerators, e), factor)), out);
    }
  }
  return left_out;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(Interleave);
HWY_EXPORT(Separate);
HWY_EXPORT(ShadeRow);

void interleave(std::span<const float* const> rows, std::size_t width, float* out) {
  HWY_DYNAMIC_DISPATCH(Interleave)(rows, width, out);
}

void separate(const float* in, std::span<float* const> rows, std::size_t width) {
  HWY_DYNAMIC_DISPATCH(Separate)(in, rows, width);
}

std::uint64_t shade_row(const ShadedTriangle& triangle, const TileRow& row) {
  return HWY_DYNAMIC_DISPATCH(ShadeRow)(triangle, row);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
