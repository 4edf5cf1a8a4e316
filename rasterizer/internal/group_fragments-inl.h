// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Coverage and fragments of a group's small triangles. Included once for each SIMD target.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#if defined(RASTERCHECK_GROUP_FRAGMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_GROUP_FRAGMENTS_INL_H_
#undef RASTERCHECK_GROUP_FRAGMENTS_INL_H_
#else
#define RASTERCHECK_GROUP_FRAGMENTS_INL_H_
#endif

#include "rasterizer/internal/evaluation-inl.h"
#include "rasterizer/internal/group_lanes-inl.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/tile_kernels.h"
#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// The boxes of the small triangles, and the greatest width and height.
struct SmallBoxes {
  Extent columns;
  Extent rows;
  int width = 0;
  int height = 0;
};

/// Coverage of small triangles: bit 8 y + x of a lane's word is the sample of pixel (x, y) of the
/// triangle's box.
struct Cover {
  Bits covered;
  Bits doubtful;   ///< within an edge's band, and outside no other edge
  Bits at_vertex;  ///< covered samples on two edges
  Lanes has_ties;  ///< whether a sample is on an edge; set only if vertices are searched for
};

/// The bits of all samples in the boxes.
HWY_INLINE Bits SamplesOf(const SmallBoxes& boxes) {
  const Doubles d;
  const Words words;
  const auto bits_below = [&](Vector end, int most, std::uint64_t first, int step) HWY_ATTR {
    Bits bits = hn::Zero(words);
    for (int i = 0; i < most; ++i, first <<= step) {
      const Lanes is_below = hn::Lt(hn::Set(d, static_cast<double>(i)), end);
      bits = hn::Or(bits, hn::BitCast(words, hn::IfThenElseZero(
                                                 is_below, hn::BitCast(d, hn::Set(words, first)))));
    }
    return bits;
  };
  const auto widths = hn::Sub(boxes.columns.end, boxes.columns.begin);
  const auto heights = hn::Sub(boxes.rows.end, boxes.rows.begin);
  return hn::And(bits_below(widths, boxes.width, 0x0101010101010101U, 1),
                 bits_below(heights, boxes.height, 0xff, 8));
}

/// The coverage of the boxes, whose first samples are at `u_first`, `v_first`.
HWY_INLINE Cover CoverBoxes(const KernelSetting& setting, const Part& part, const SmallBoxes& boxes,
                            Vector u_first, Vector v_first, bool finds_vertices) {
  const Doubles d;
  const Words words;
  const auto zero = hn::Zero(d);
  Three a;
  Three b;
  Three c;
  Three sure_limit;
  Three possible_limit;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = part.Get(Numbers::kA + i);
    b[i] = part.Get(Numbers::kB + i);
    c[i] = part.Get(Numbers::kC + i);
    sure_limit[i] = part.Get(Numbers::kSure + i);
    possible_limit[i] = part.Get(Numbers::kPossible + i);
  }
  Cover cover{hn::Zero(words), hn::Zero(words), hn::Zero(words), Never()};
  auto v = v_first;
  for (int y = 0; y < boxes.height; ++y, v = hn::Add(v, hn::Set(d, setting.v_step))) {
    const Three row{hn::Add(hn::Mul(b[0], v), c[0]), hn::Add(hn::Mul(b[1], v), c[1]),
                    hn::Add(hn::Mul(b[2], v), c[2])};
    auto u = u_first;
    for (int x = 0; x < boxes.width; ++x, u = hn::Add(u, hn::Set(d, setting.u_step))) {
      const Three e{hn::Add(hn::Mul(a[0], u), row[0]), hn::Add(hn::Mul(a[1], u), row[1]),
                    hn::Add(hn::Mul(a[2], u), row[2])};
      const auto sure = All(hn::Gt(e[0], sure_limit[0]), hn::Gt(e[1], sure_limit[1]),
                            hn::Gt(e[2], sure_limit[2]));
      const auto possible = All(hn::Gt(e[0], possible_limit[0]), hn::Gt(e[1], possible_limit[1]),
                                hn::Gt(e[2], possible_limit[2]));
      const auto bit = hn::BitCast(d, hn::Set(words, std::uint64_t{1} << (8 * y + x)));
      const auto add = [&](Bits to, Lanes lanes) HWY_ATTR {
        return hn::Or(to, hn::BitCast(words, hn::IfThenElseZero(lanes, bit)));
      };
      cover.covered = add(cover.covered, sure);
      cover.doubtful = add(cover.doubtful, hn::AndNot(sure, possible));
      if (!finds_vertices) continue;
      const Lanes on0 = hn::Eq(e[0], zero);
      const Lanes on1 = hn::Eq(e[1], zero);
      const Lanes on2 = hn::Eq(e[2], zero);
      const Lanes on_two = hn::Or(hn::And(on0, hn::Or(on1, on2)), hn::And(on1, on2));
      cover.at_vertex = add(cover.at_vertex, hn::And(sure, on_two));
      cover.has_ties = hn::Or(cover.has_ties, hn::Or(on0, hn::Or(on1, on2)));
    }
  }
  const Bits samples = SamplesOf(boxes);
  cover.covered = hn::And(cover.covered, samples);
  cover.doubtful = hn::And(cover.doubtful, samples);
  cover.at_vertex = hn::And(cover.at_vertex, samples);
  return cover;
}

/// Encodes a fragment of the group: its lane, and its bit in the lane's coverage.
using Code = std::uint32_t;
constexpr int kCodeLane = 6;

/// Number of bits of a tile's column or row index.
constexpr int kTileBits = 6;
static_assert(1 << kTileBits == kTileSize);

/// Planes of a group's triangles at a vector of fragments. The fragments may belong to different
/// triangles.
struct PlanesOfLanes {
  const KernelSetting& setting;
  const Part& part;
  decltype(hn::IndicesFromVec(
      Doubles(), hn::Zero(Words()))) of_lane;  ///< the lane of each fragment's triangle
  Vector u;
  Vector v;

  HWY_INLINE std::size_t Count() const { return setting.attributes; }
  HWY_INLINE bool HasSmooth() const { return setting.has_smooth; }
  HWY_INLINE Interpolation InterpolationOf(std::size_t a) const { return setting.interpolation[a]; }
  HWY_INLINE Vector Depth() const { return At(Numbers::kDepth); }
  HWY_INLINE Vector Sum() const {
    constexpr std::size_t kAt = Numbers::kDenominator;
    return At(Numbers::kA + kAt, Numbers::kB + kAt, Numbers::kC + kAt);
  }
  HWY_INLINE Vector Value(std::size_t a) const { return At(Numbers::kValues + 3 * a); }
  HWY_INLINE Vector Flat(std::size_t a) const { return Get(Numbers::kValues + 3 * a + 2); }

 private:
  HWY_INLINE Vector Get(std::size_t number) const {
    return hn::TableLookupLanes(part.Get(number), of_lane);
  }
  HWY_INLINE Vector At(std::size_t number) const { return At(number, number + 1, number + 2); }
  HWY_INLINE Vector At(std::size_t a, std::size_t b, std::size_t c) const {
    return OnPlane(Get(a), u, hn::Add(hn::Mul(Get(b), v), Get(c)));
  }
};

/// Stores depth and attributes of a vector of fragments.
HWY_INLINE void PutValues(const KernelSetting& setting, const PlanesOfLanes& planes, std::size_t at,
                          FragmentList& out) {
  const Halves floats;
  const auto depth = Clamped(planes.Depth(), setting.depth_least, setting.depth_greatest);
  hn::StoreU(Stored(depth, setting.depth_steps), floats, out.depth.data() + at);
  EvaluateAttributes(planes, [&](std::size_t a, Vector value, Vector /*reciprocal*/) HWY_ATTR {
    hn::StoreU(RoundToFloats(value), floats, out.attributes[a].data() + at);
  });
}

/// Stores tiles and keys of a vector of fragments. `places` are pixels: the column in the low half,
/// the row in the high half. Both have at most 14 bits.
HWY_INLINE void PutKeys(const KernelSetting& setting, hn::Vec<HalfWords> triangle,
                        std::size_t sample, hn::Vec<Ints> places, std::size_t at,
                        FragmentList& out) {
  const Ints ints;
  const HalfWords words;
  const auto column = hn::And(places, hn::Set(ints, 0xffff));
  const auto row = hn::ShiftRight<16>(places);
  const auto tile_column = hn::ShiftRight<kTileBits>(column);
  const auto tile_row = hn::ShiftRight<kTileBits>(row);
  const auto tile = hn::Add(hn::Mul(tile_row, hn::Set(ints, setting.tile_columns)), tile_column);
  const auto last = hn::Set(ints, kTileSize - 1);
  const auto in_tile = hn::Or(hn::ShiftLeft<kTileBits>(hn::And(row, last)), hn::And(column, last));
  hn::StoreU(hn::BitCast(words, tile), words, out.tile.data() + at);
  const auto of_sample = hn::Set(words, fragment_key(0, static_cast<std::uint32_t>(sample), 0));
  const auto key =
      hn::Or(hn::ShiftLeft<kKeyTriangle>(triangle), hn::Or(of_sample, hn::BitCast(words, in_tile)));
  hn::StoreU(key, words, out.key.data() + at);
}

/// Stores the fragments in `codes`. `codes` and the arrays of `out` have room for whole vectors.
HWY_INLINE void PutFragments(const KernelSetting& setting, const Part& part, std::size_t sample,
                             const Code* codes, std::size_t count, std::uint32_t first,
                             FragmentList& out) {
  const Doubles d;
  const Ints ints;
  const HalfWords words;
  alignas(64) std::array<std::int32_t, kGroup> corner{};
  alignas(64) std::array<double, kGroup> u_corner{};
  alignas(64) std::array<double, kGroup> v_corner{};
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const PixelBox& box = part.output->box[part.from + lane];
    corner[lane] = box.columns.begin | box.rows.begin << 16;
    u_corner[lane] = setting.u_first[sample] + box.columns.begin * setting.u_step;
    v_corner[lane] = setting.v_first[sample] + box.rows.begin * setting.v_step;
  }
  const auto corners = hn::Load(ints, corner.data());
  const auto u_corners = hn::Load(d, u_corner.data());
  const auto v_corners = hn::Load(d, v_corner.data());
  for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
    const auto code = hn::LoadU(words, codes + k);
    const auto lane = hn::ShiftRight<kCodeLane>(code);
    const auto of_lane = hn::IndicesFromVec(d, hn::PromoteTo(Words(), lane));
    const auto of_half = hn::IndicesFromVec(ints, hn::BitCast(ints, lane));
    const auto x = hn::BitCast(ints, hn::And(code, hn::Set(words, 7)));
    const auto y = hn::BitCast(ints, hn::And(hn::ShiftRight<3>(code), hn::Set(words, 7)));
    const auto u = hn::Add(hn::TableLookupLanes(u_corners, of_lane),
                           hn::Mul(hn::PromoteTo(d, x), hn::Set(d, setting.u_step)));
    const auto v = hn::Add(hn::TableLookupLanes(v_corners, of_lane),
                           hn::Mul(hn::PromoteTo(d, y), hn::Set(d, setting.v_step)));
    PutValues(setting, {setting, part, of_lane, u, v}, out.size + k, out);
    const auto places =
        hn::Add(hn::TableLookupLanes(corners, of_half), hn::Or(x, hn::ShiftLeft<16>(y)));
    const auto triangle = hn::Add(hn::Set(words, first), lane);
    PutKeys(setting, triangle, sample, places, out.size + k, out);
  }
  out.size += count;
}

/// Gives a fragment at a vertex the values of that vertex. The vertex is opposite the only edge
/// that the fragment is not on.
inline void PutVertexValues(const KernelSetting& setting, const GroupInput& input,
                            const GroupOutput& output, std::size_t sample, std::size_t lane,
                            Code bit, std::size_t at, FragmentList& out) {
  const PixelBox& box = output.box[lane];
  const int x = box.columns.begin + static_cast<int>(bit & 7);
  const int y = box.rows.begin + static_cast<int>(bit >> 3);
  const double u = setting.u_first[sample] + x * setting.u_step;
  const double v = setting.v_first[sample] + y * setting.v_step;
  std::size_t vertex = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double row =
        output.numbers[Numbers::kB + i][lane] * v + output.numbers[Numbers::kC + i][lane];
    if (output.numbers[Numbers::kA + i][lane] * u + row != 0) vertex = i;
  }
  for (std::size_t a = 0; a < setting.attributes; ++a) {
    if (setting.interpolation[a] == Interpolation::flat) continue;
    // Adding 0 turns −0 into 0: an exact sum is never −0.
    out.attributes[a][at] = input.attributes[vertex][lane * setting.attributes + a] + 0.0F;
  }
}

/// Coverage of the small triangles by sample and lane, as in Cover.
struct SmallCover {
  template <typename T>
  using PerSample = std::array<T, DrawBounds::kMaxSamples>;
  alignas(64) PerSample<std::array<std::uint64_t, kGroup>> covered;
  alignas(64) PerSample<std::array<std::uint64_t, kGroup>> at_vertex;
  Mask ties;  ///< lanes with samples on edges, or next to them
};

/// Computes the coverage of the `small` triangles. Returns the triangles that it leaves out,
/// because their denominators need more than double or a sample lies within the band of an edge.
/// `is_exact` tells whether the limits of edges without a band are set already. If not, sets them
/// once they are needed, and updates `is_exact`.
HWY_INLINE Mask CoverSmall(const KernelSetting& setting, const Corners& p, const Part& part,
                           const SmallBoxes& boxes, Mask small, bool& is_exact, SmallCover& out) {
  const Doubles d;
  const auto one = hn::Set(d, 1.0);
  const Extent& columns = boxes.columns;
  const Extent& rows = boxes.rows;
  Mask left = 0;
  out.ties = 0;
  for (std::size_t s = 0; s < setting.samples && small != 0; ++s) {
    const auto u_step = hn::Set(d, setting.u_step);
    const auto v_step = hn::Set(d, setting.v_step);
    const auto u_first = hn::Set(d, setting.u_first[s]);
    const auto v_first = hn::Set(d, setting.v_first[s]);
    const auto u = hn::Add(u_first, hn::Mul(columns.begin, u_step));
    const auto v = hn::Add(v_first, hn::Mul(rows.begin, v_step));
    // The least denominator of the box is at a corner (plane.h).
    if (setting.has_smooth) {
      const auto u_last = hn::Add(u_first, hn::Mul(hn::Sub(columns.end, one), u_step));
      const auto v_last = hn::Add(v_first, hn::Mul(hn::Sub(rows.end, one), v_step));
      const auto a = part.Get(Numbers::kA + Numbers::kDenominator);
      const auto b = part.Get(Numbers::kB + Numbers::kDenominator);
      const auto c = part.Get(Numbers::kC + Numbers::kDenominator);
      const auto along_v = hn::Min(hn::Mul(b, v), hn::Mul(b, v_last));
      const auto least_sum =
          hn::Add(hn::Min(hn::Mul(a, u), hn::Mul(a, u_last)), hn::Add(along_v, c));
      const auto least = part.Get(Numbers::kSure + Numbers::kDenominator);
      const Mask is_above = BitsOf(d, hn::Gt(least_sum, least));
      left |= small & ~is_above;
      small &= is_above;
    }
    const Words words;
    const auto lane_bits = [&](Bits bits) HWY_ATTR {
      return BitsOf(d, hn::RebindMask(d, hn::Ne(bits, hn::Zero(words)))) & small;
    };
    // A pixel's corner on two lines is no sample at a vertex.
    const bool covers_samples = setting.corner_sign == 0;
    Cover cover = CoverBoxes(setting, part, boxes, u, v, is_exact && covers_samples);
    if (!is_exact && lane_bits(cover.doubtful) != 0) {
      out.ties |= lane_bits(cover.doubtful);
      is_exact = SetExactLimits(setting, part, p);
      if (is_exact) cover = CoverBoxes(setting, part, boxes, u, v, covers_samples);
    }
    const Mask doubtful = lane_bits(cover.doubtful);
    out.ties |= BitsOf(d, cover.has_ties) & small;
    left |= doubtful;
    small &= ~doubtful;
    hn::Store(cover.covered, words, out.covered[s].data());
    hn::Store(cover.at_vertex, words, out.at_vertex[s].data());
  }
  return left;
}

/// Appends the fragments of the `small` triangles.
inline void AppendFragments(const KernelSetting& setting, const GroupInput& input, const Part& part,
                            const SmallCover& cover, Mask small, std::uint32_t first,
                            FragmentList& fragments) {
  const Doubles d;
  const GroupOutput& output = *part.output;
  for (std::size_t s = 0; s < setting.samples; ++s) {
    struct AtVertex {
      std::size_t fragment;
      std::size_t lane;
      Code bit;
    };
    std::array<AtVertex, 3 * kGroup> vertices;
    std::size_t vertex_count = 0;
    std::array<Code, kGroup * 64 + kGroup> codes;
    std::size_t count = 0;
    for_each_bit(small, [&](int bit) {
      const auto lane = static_cast<std::size_t>(bit);
      const Code of_lane = static_cast<Code>(lane) << kCodeLane;
      const std::uint64_t bits = cover.covered[s][lane];
      for_each_bit(cover.at_vertex[s][lane], [&](int place) {
        const std::uint64_t before = bits & ((std::uint64_t{1} << place) - 1);
        vertices[vertex_count++] = {count + static_cast<std::size_t>(std::popcount(before)), lane,
                                    static_cast<Code>(place)};
      });
      // Writes four codes at a time, possibly beyond the last: the processor cannot predict the
      // count.
      const auto end = count + static_cast<std::size_t>(std::popcount(bits));
      std::uint64_t rest = bits;
      do {
        for (std::size_t k = 0; k < 4; ++k, rest &= rest - 1) {
          codes[count + k] = of_lane | static_cast<Code>(std::countr_zero(rest));
        }
        count += 4;
      } while (count < end);
      count = end;
    });
    if (count == 0) continue;
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) codes[count + i] = 0;
    const std::size_t at = fragments.size;
    PutFragments(setting, part, s, codes.data(), count,
                 first + static_cast<std::uint32_t>(part.from), fragments);
    for (std::size_t i = 0; i < vertex_count; ++i) {
      PutVertexValues(setting, input, output, s, part.from + vertices[i].lane, vertices[i].bit,
                      at + vertices[i].fragment, fragments);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#endif  // RASTERCHECK_GROUP_FRAGMENTS_INL_H_
