// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/group_kernels.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "rasterizer/internal/certificates.h"
#include "rasterizer/internal/masks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/group_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

#include "rasterizer/internal/group_bias-inl.h"
#include "rasterizer/internal/group_fragments-inl.h"
#include "rasterizer/internal/group_lanes-inl.h"
#include "rasterizer/internal/group_outline-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// Loads an attribute's values for all lanes. Attributes alternate in memory; if there are two
/// attributes, both are separated at once.
HWY_INLINE Three Values(const KernelSetting& setting, const GroupInput& input,
                        std::size_t attribute, std::size_t from) {
  const Doubles d;
  const Halves floats;
  Three r;
  for (std::size_t i = 0; i < 3; ++i) {
    const float* const all = input.attributes[i].data() + from * setting.attributes;
    if (setting.attributes == 2) {
      hn::Vec<Halves> first;
      hn::Vec<Halves> second;
      hn::LoadInterleaved2(floats, all, first, second);
      r[i] = hn::PromoteTo(d, attribute == 0 ? first : second);
      continue;
    }
    alignas(64) std::array<float, kGroup> of_lanes;
    for (std::size_t lane = 0; lane < hn::Lanes(floats); ++lane) {
      of_lanes[lane] = all[lane * setting.attributes + attribute];
    }
    r[i] = hn::PromoteTo(d, hn::Load(floats, of_lanes.data()));
  }
  return r;
}

/// Lanes where a value is not finite, or all values are −0: sums cannot reproduce such values.
HWY_INLINE Lanes AreCopied(const Three& r) {
  const Doubles d;
  const Words words;
  const auto zero = hn::Zero(d);
  const auto sum = hn::Add(hn::Add(r[0], r[1]), r[2]);
  const auto not_finite = hn::Not(hn::Eq(hn::Mul(sum, zero), zero));
  const auto all = hn::And(hn::And(r[0], r[1]), r[2]);  // −0 and −0 is −0
  const auto any = hn::Or(hn::Or(r[0], r[1]), r[2]);
  const auto minus_zero = hn::Set(words, std::uint64_t{1} << 63);
  const auto is = [&](Vector v) HWY_ATTR {
    return hn::RebindMask(d, hn::Eq(hn::BitCast(words, v), minus_zero));
  };
  return hn::Or(not_finite, hn::And(is(all), is(any)));
}

/// Stores the half-planes of triangles. If a depth plane cuts no triangle, its half-plane is
/// stored only if `may_be_numbered`.
HWY_INLINE void PutHalfPlanes(const KernelSetting& setting, const Part& part,
                              const Outline& outline, bool may_be_numbered) {
  const Doubles d;
  const Edges& lines = outline.lines;
  for (std::size_t i = 0; i < 3; ++i) {
    PutHalfPlane(part, i, {lines.a[i], lines.b[i], lines.c[i]}, outline.sure[i],
                 outline.possible[i]);
  }
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const auto t = hn::Set(d, setting.t);
  if (BitsOf(d, hn::Not(outline.is_whole)) != 0) {
    PutClip(part, Numbers::kNear, outline.near, outline.edges, outline.band, t);
    PutClip(part, Numbers::kFar, outline.far, outline.edges, outline.band, t);
  } else if (may_be_numbered) {
    PutHalfPlane(part, Numbers::kNear, {zero, zero, one}, zero, zero);
    PutHalfPlane(part, Numbers::kFar, {zero, zero, one}, zero, zero);
  }
}

/// The depth of a plane of constant depth, computed at the vertex with the greatest |w|.
HWY_INLINE Vector LevelDepth(const KernelSetting& setting, const Corners& p) {
  const Doubles d;
  auto z = p.z[0];
  auto w = p.w[0];
  for (std::size_t i = 1; i < 3; ++i) {
    const Lanes is_greater = hn::Gt(hn::Abs(p.w[i]), hn::Abs(w));
    z = hn::IfThenElse(is_greater, p.z[i], z);
    w = hn::IfThenElse(is_greater, p.w[i], w);
  }
  return hn::Add(hn::Set(d, setting.depth_low),
                 hn::Mul(hn::Set(d, setting.depth_span), hn::Div(z, w)));
}

/// Stores the planes of depths; `scale` is 1 / (|det| T). Returns the triangles for whose depths
/// double suffices (certificates.h).
HWY_INLINE Lanes PutDepth(const KernelSetting& setting, const Part& part, const Corners& p,
                          const Outline& outline, Vector scale) {
  const Doubles d;
  const Three& z = p.z;
  const Three& w = p.w;
  const auto error = SumOfSizes(z, outline.band);
  Lanes certain = hn::Le(hn::Mul(error, hn::Set(d, kDepthCertainty)), outline.det_t);
  const auto depth_scale = hn::Mul(hn::Set(d, setting.depth_span), scale);
  PlaneLanes depth =
      Collect(outline.edges, z, hn::Set(d, setting.t), depth_scale, hn::Set(d, setting.depth_low));
  const Lanes is_level = All(hn::Eq(hn::Mul(z[0], w[1]), hn::Mul(z[1], w[0])),
                             hn::Eq(hn::Mul(z[1], w[2]), hn::Mul(z[2], w[1])),
                             hn::Eq(hn::Mul(z[2], w[0]), hn::Mul(z[0], w[2])));
  if (BitsOf(d, is_level) != 0) {
    depth = Constant(is_level, LevelDepth(setting, p), depth);
    certain = hn::Or(certain, is_level);
  }
  if (setting.bias.is_any) {
    const OffsetLanes offset = OffsetsOf(setting, p, outline.edges, depth, depth_scale, is_level);
    certain = hn::And(certain, offset.certain);
    depth.c = hn::Add(depth.c, offset.value);
  }
  PutPlane(part, Numbers::kDepth, depth);
  return certain;
}

/// Stores the denominators: Σ E_i, or 1 if no smooth value is divided.
HWY_INLINE void PutDenominator(const KernelSetting& setting, const Part& part,
                               const Outline& outline, Lanes has_one_w) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const Three& band = outline.band;
  PlaneLanes denominator{zero, zero, one};
  auto least = zero;
  if (setting.has_smooth) {
    const auto t = hn::Set(d, setting.t);
    denominator = Constant(has_one_w, one, Collect(outline.edges, {one, one, one}, t, one, zero));
    least = hn::Mul(hn::Set(d, kSmoothCertainty), hn::Add(hn::Add(band[0], band[1]), band[2]));
    least = hn::IfThenZeroElse(has_one_w, least);
  }
  if (setting.makes_cells) PutPlane(part, Numbers::kPlanes + TrianglePlanes::kSum, denominator);
  PutHalfPlane(part, Numbers::kDenominator, denominator, least,
               hn::Set(d, -std::numeric_limits<double>::infinity()));
}

/// Stores the planes of attributes, with `scale` as in PutDepth(). Returns the triangles with an
/// attribute that must be copied unchanged.
HWY_INLINE Lanes PutAttributes(const KernelSetting& setting, const GroupInput& input,
                               const Part& part, const Three& w, const Edges& edges, Vector scale,
                               Lanes has_one_w) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const auto t = hn::Set(d, setting.t);
  const Lanes all = hn::FirstN(d, hn::Lanes(d));
  Lanes copied = Never();
  for (std::size_t a = 0; a < setting.attributes; ++a) {
    const std::size_t number = Numbers::kValues + 3 * a;
    const Three r = Values(setting, input, a, part.from);
    if (setting.interpolation[a] == Interpolation::flat) {
      // Conversion to another format would not copy infinities and NaNs bit for bit.
      const auto flat = r[setting.provoking];
      copied = hn::Or(copied, hn::Not(hn::Eq(hn::Mul(flat, zero), zero)));
      PutPlane(part, number, {zero, zero, flat});
      continue;
    }
    copied = hn::Or(copied, AreCopied(r));
    const bool is_affine = setting.interpolation[a] == Interpolation::noperspective;
    const Lanes weighed = is_affine ? all : has_one_w;
    Three k;
    for (std::size_t i = 0; i < 3; ++i) k[i] = hn::IfThenElse(weighed, hn::Mul(r[i], w[i]), r[i]);
    PutPlane(part, number, Collect(edges, k, t, hn::IfThenElse(weighed, scale, one), zero));
  }
  return copied;
}

/// Stores the half-planes (as PutHalfPlanes() does) and planes of triangles. Returns the triangles
/// for whose values double suffices.
HWY_INLINE Lanes PutNumbers(const KernelSetting& setting, const GroupInput& input, const Part& part,
                            const Corners& p, const Outline& outline, bool may_be_numbered) {
  const Doubles d;
  const Three& w = p.w;
  PutHalfPlanes(setting, part, outline, may_be_numbered);
  const auto scale = hn::Div(hn::Set(d, 1.0), outline.det_t);
  Lanes certain = PutDepth(setting, part, p, outline, scale);
  const Lanes has_one_w = All(hn::Eq(w[0], w[1]), hn::Eq(w[1], w[2]), outline.in_front);
  const auto affine_error = SumOfSizes(w, outline.band);
  const Lanes is_affine_certain = hn::And(
      outline.in_front, hn::Le(hn::Mul(affine_error, hn::Set(d, kAffineCertainty)), outline.det_t));
  if (setting.has_affine) certain = hn::And(certain, is_affine_certain);
  if (setting.has_smooth) {
    certain = hn::And(certain, hn::Or(hn::Not(has_one_w), is_affine_certain));
  }
  PutDenominator(setting, part, outline, has_one_w);
  const Lanes copied = PutAttributes(setting, input, part, w, outline.edges, scale, has_one_w);
  return hn::AndNot(copied, certain);
}

HWY_INLINE void PutBoxes(const Part& part, const Extent& columns, const Extent& rows) {
  const Doubles d;
  const Ints ints;
  using Numbers32 = std::array<std::int32_t, kGroup>;
  alignas(64) Numbers32 left;
  alignas(64) Numbers32 right;
  alignas(64) Numbers32 top;
  alignas(64) Numbers32 bottom;
  hn::Store(hn::DemoteTo(ints, columns.begin), ints, left.data());
  hn::Store(hn::DemoteTo(ints, columns.end), ints, right.data());
  hn::Store(hn::DemoteTo(ints, rows.begin), ints, top.data());
  hn::Store(hn::DemoteTo(ints, rows.end), ints, bottom.data());
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    part.output->box[part.from + lane] = {{left[lane], right[lane]}, {top[lane], bottom[lane]}};
  }
}

/// Splits `lanes` into runs at the lanes in `borders`, and calls `visit` with each run, in
/// ascending order. Fragments are appended sample by sample. If a triangle is drawn tile by tile,
/// the triangles before it and those after it must therefore be appended separately.
template <typename Visit>
void for_each_run(Mask lanes, Mask borders, const Visit& visit) {
  while (lanes != 0) {
    const Mask beyond = borders & ~Mask{0} << std::countr_zero(lanes);
    const Mask run = lanes & ~beyond & (beyond - 1);  // before the first border
    visit(run);
    lanes &= ~run;
  }
}

HWY_INLINE void PutFate(const Part& part, Mask lanes, LaneFate fate) {
  for_each_bit(lanes, [&](int lane) {
    part.output->fate[part.from + static_cast<std::size_t>(lane)] = fate;
  });
}

/// Stores the coverage of `small` triangles that become cells. A triangle that covers nothing is
/// hidden. A triangle that covers a sample at a vertex is drawn from its numbers, because that
/// sample takes the vertex's values.
HWY_INLINE void PutCovers(const KernelSetting& setting, const Part& part, const SmallCover& cover,
                          Mask small) {
  GroupOutput& output = *part.output;
  for_each_bit(small, [&](int bit) {
    const auto lane = static_cast<std::size_t>(bit);
    std::uint64_t any = 0;
    std::uint64_t at_vertex = 0;
    for (std::size_t s = 0; s < setting.samples; ++s) {
      output.covered[s][part.from + lane] = cover.covered[s][lane];
      any |= cover.covered[s][lane];
      at_vertex |= cover.at_vertex[s][lane];
    }
    if (any == 0) return;
    output.fate[part.from + lane] = at_vertex != 0 ? LaneFate::numbered : LaneFate::covered;
  });
}

/// Computes the numbers and fates of a part's triangles, which are in the lanes `live`, and the
/// fragments of the small triangles.
void SetUpPart(const KernelSetting& setting, const GroupInput& input, const Part& part, Mask live,
               std::uint32_t first, FragmentList& fragments) {
  const Doubles d;
  GroupOutput& output = *part.output;
  const Corners p = LoadCorners(input, part.from);
  const Outline outline = setting.snaps ? SnappedOutline(setting, p) : ExactOutline(setting, p);
  const Mask finite = BitsOf(d, AreFinite(p)) & live;
  const Lanes settled = hn::Or(outline.drawable, outline.hidden);
  Mask left = finite & BitsOf(d, hn::Or(outline.left, hn::Not(settled)));
  Mask kept = finite & ~left & ~BitsOf(d, outline.hidden);
  // Checked only if `left` has lanes, because in many meshes it has none. If vertices are snapped,
  // or pixels covered, the fallback decides which triangles are degenerate.
  const bool decides_degenerates = setting.snaps || setting.corner_sign != 0;
  const Mask degenerate = left == 0 || decides_degenerates ? 0 : left & BitsOf(d, HaveTwins(p));
  left &= ~degenerate;
  std::fill_n(output.fate.data() + part.from, hn::Lanes(d), LaneFate::hidden);
  PutFate(part, live & ~finite, LaneFate::not_finite);
  PutFate(part, degenerate, LaneFate::degenerate);
  PutFate(part, left, LaneFate::left);
  if (kept == 0) return;

  // Finds the small triangles, and the size of the largest of them.
  const Extent& columns = outline.columns;
  const Extent& rows = outline.rows;
  const auto widths = hn::Sub(columns.end, columns.begin);
  const auto heights = hn::Sub(rows.end, rows.begin);
  const auto most = hn::Set(d, kSmallBox);
  const Lanes is_small =
      All(hn::Le(widths, most), hn::Le(heights, most), hn::And(outline.in_front, outline.is_whole));
  const Mask small_of_all = BitsOf(d, is_small);
  // Small triangles that become cells may still have to be drawn from their numbers.
  const bool may_be_numbered = (kept & ~small_of_all) != 0 || setting.makes_cells;
  const Mask trusted = BitsOf(d, PutNumbers(setting, input, part, p, outline, may_be_numbered));
  left |= kept & ~trusted;
  kept &= trusted;
  Mask small = kept & small_of_all;
  const auto greatest_of = [&](Vector v) HWY_ATTR {
    return static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(is_small, v))));
  };
  const SmallBoxes boxes{columns, rows, greatest_of(widths), greatest_of(heights)};
  PutBoxes(part, columns, rows);
  Mask large = kept & ~small;
  // If the last group had ties, this group probably has ties, too.
  const bool needs_limits = !setting.snaps && (large != 0 || output.had_ties);
  bool is_exact = needs_limits ? SetExactLimits(setting, part, p) : setting.snaps;

  SmallCover cover;
  if (small != 0) {
    const Mask uncovered = CoverSmall(setting, p, part, boxes, small, is_exact, cover);
    output.had_ties = cover.ties != 0;
    (setting.makes_cells ? large : left) |= uncovered;
    small &= ~uncovered;
  }
  PutFate(part, left, LaneFate::left);
  PutFate(part, large, LaneFate::numbered);
  if (setting.makes_cells) return PutCovers(setting, part, cover, small);
  for_each_run(small, left | large, [&](Mask run) {
    AppendFragments(setting, input, part, cover, run, first, fragments);
  });
}

void SetUpGroup(const KernelSetting& setting, const GroupInput& input, std::size_t count,
                std::uint32_t first, GroupOutput& output, FragmentList& fragments) {
  const Doubles d;
  for (std::size_t from = 0; from < count; from += hn::Lanes(d)) {
    const Mask live = BitsOf(d, hn::FirstN(d, count - from));
    SetUpPart(setting, input, {from, &output}, live, first, fragments);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(SetUpGroup);

void FragmentList::reserve_group(std::size_t samples, std::size_t attribute_count) {
  const std::size_t of_group = samples * kGroup * kSmallBox * kSmallBox + kGroup;
  if (size + of_group <= tile.size()) return;
  const std::size_t room = 2 * (size + of_group);
  tile.resize(room);
  key.resize(room);
  depth.resize(room);
  attributes.resize(attribute_count);
  for (std::vector<float>& values : attributes) values.resize(room);
}

void set_up_group(const KernelSetting& setting, const GroupInput& input, std::size_t count,
                  std::uint32_t first, GroupOutput& output, FragmentList& fragments) {
  fragments.reserve_group(setting.samples, setting.attributes);
  HWY_DYNAMIC_DISPATCH(SetUpGroup)(setting, input, count, first, output, fragments);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
