#include "rasterizer/internal/fragment_drawing.h"

#include <algorithm>
#include <memory>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/block_output.h"
#include "rasterizer/internal/conservative_coverage.h"
#include "rasterizer/internal/depth_store.h"
#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/exact_coverage.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/float_kernels.h"
#include "rasterizer/internal/grid_coverage.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/part_set_up.h"
#include "rasterizer/internal/primitive_drawing.h"
#include "rasterizer/internal/tap.h"

namespace rastercheck::rasterizer {
namespace {

/// Masks of a block's samples.
struct PartMasks {
  Mask drawn = 0;      ///< samples drawn with this part
  Mask inside = 0;     ///< samples where no weight is surely negative
  Mask at_vertex = 0;  ///< CoveredBlock::at_vertex
  Mask certain = 0;    ///< double suffices for these samples' smooth values
  /// Samples of `certain` whose weights also suit float32.
  Mask float_certain = 0;
};

template <typename Coverage, typename Tap>
class Drawing {
 public:
  Drawing(const DrawSetting& setting, const Mesh& mesh, FragmentOutput& output, Tap& tap)
      : setting_(setting),
        state_(setting.state),
        mesh_(mesh),
        output_(output),
        tap_(tap),
        coverage_(setting),
        blocks_(setting.pattern.size()) {
    if (!state_.derivatives) return;
    derivatives_.resize(blocks_.size() * kBlockSize * state_.attributes.size());
  }

  /// Draws every triangle of the mesh.
  DrawCounts draw() {
    DrawCounts counts;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const Fate fate = set_up(i);
      count(fate, counts);
      if (fate == Fate::drawn) draw_rows();
    }
    return counts;
  }

 private:
  /// Makes a triangle the current one; returns its fate.
  Fate set_up(std::size_t index);
  /// Draws the current triangle.
  void draw_rows();
  void draw_row(int y);
  /// Draws up to kBlockSize pixels of a row.
  void draw_block(int y, int first, int count);
  void evaluate(const BlockPlace& place, SampleBlock& block);
  void evaluate_part(const BlockPlace& place, const DrawnPart& part, PartMasks masks,
                     SampleBlock& out);
  void weigh(const BlockPlace& place, const DrawnPart& part, PartMasks& masks);
  void evaluate_attribute(const BlockPlace& place, const DrawnPart& part, std::size_t attribute,
                          const PartMasks& masks, SampleBlock& out);
  PlaneRow row_of(const Plane& plane, const BlockPlace& place, const DrawnPart& part) const {
    return plane_row(plane, *part.weights.frame, place.y + setting_.pattern[place.sample].y);
  }
  /// The data that a Tap receives.
  WeighedBlock shown(const BlockPlace& place, const DrawnPart& part, Mask drawn) const {
    return {place, setting_.pattern[place.sample], part, drawn, weights_};
  }
  void evaluate_pixels(int y, int first, Mask touched);
  void derive(const BlockPlace& place, const DrawnPart& part, Mask mask);
  Slopes* derivatives_of(std::size_t sample, int column) {
    return derivatives_.data() +
           (sample * kBlockSize + static_cast<std::size_t>(column)) * state_.attributes.size();
  }

  // State of the current block. Declared first, because it is aligned to cache lines.
  BlockWeights weights_;
  FloatWeights float_smooth_;
  FloatWeights float_affine_;
  const DrawSetting& setting_;
  const State& state_;
  const Mesh& mesh_;
  FragmentOutput& output_;
  Tap& tap_;
  Coverage coverage_;
  std::vector<SampleBlock> blocks_;       ///< [sample], of the current block
  std::unique_ptr<SampleBlock> of_part_;  ///< for triangles drawn in several parts
  /// [sample][column][attribute], of the current block; empty without State::derivatives.
  std::vector<Slopes> derivatives_;

  // The current triangle.
  std::uint32_t triangle_ = 0;
  std::vector<DrawnPart> parts_;
};

template <typename Coverage, typename Tap>
Fate Drawing<Coverage, Tap>::set_up(std::size_t index) {
  const Fate fate = set_up_parts(state_, mesh_, index, state_.derivatives, coverage_, parts_);
  if (fate != Fate::drawn) return fate;
  triangle_ = static_cast<std::uint32_t>(index);
  tap_.set_up(setting_, triangle_, coverage_, std::span<const DrawnPart>(parts_));
  if (parts_.size() > 1 && !of_part_) of_part_ = std::make_unique<SampleBlock>();
  return fate;
}

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::draw_rows() {
  const PixelRange& rows = coverage_.box().rows;
  for (int y = rows.begin; y < rows.end; ++y) draw_row(y);
}

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::draw_row(int y) {
  PixelRange span{coverage_.box().columns.end, coverage_.box().columns.begin};
  for (std::size_t s = 0; s < blocks_.size(); ++s) {
    if (!setting_.bounds.sample_rows[s].contains(y)) continue;
    const PixelRange of_sample = coverage_.span(s, y);
    if (of_sample.empty()) continue;
    span.begin = std::min(span.begin, of_sample.begin);
    span.end = std::max(span.end, of_sample.end);
  }
  for (int first = span.begin; first < span.end; first += kBlockSize) {
    draw_block(y, first, std::min(kBlockSize, span.end - first));
  }
}

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::draw_block(int y, int first, int count) {
  Mask touched = 0;
  for (std::size_t s = 0; s < blocks_.size(); ++s) {
    SampleBlock& block = blocks_[s];
    block.coverage = {};
    if (!setting_.bounds.sample_rows[s].contains(y)) continue;
    block.coverage = coverage_.cover(s, y, first, count, weights_);
    touched |= block.coverage.covered;
    const BlockPlace place{triangle_, s, y, first, count};
    tap_.covered(place, block.coverage, weights_);
    evaluate(place, block);
  }
  if (touched == 0) return;
  if (blocks_.size() > 1) evaluate_pixels(y, first, touched);
  output_.take({triangle_, y, first, touched, blocks_, derivatives_});
}

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::evaluate(const BlockPlace& place, SampleBlock& block) {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const DrawnPart& part = parts_[k];
    const Mask mask = coverage_.part_mask(block.coverage, k) & block.coverage.covered;
    if (mask == 0) continue;
    PartMasks masks{mask, mask, block.coverage.at_vertex};
    const SampleOffset& offset = setting_.pattern[place.sample];
    if constexpr (!Coverage::kLeavesWeights) {
      const EdgeRow row =
          edge_row(part.weights.edges, *part.weights.frame, place.y + offset.y, offset.x);
      masks.inside = evaluate_edges(row, place.first, place.count, weights_).possible;
    }
    tap_.weighed(shown(place, part, mask));
    SampleBlock& out = parts_.size() == 1 ? block : *of_part_;
    evaluate_part(place, part, masks, out);
    if (parts_.size() > 1) block.take(mask, out, state_.attributes.size());
    if (state_.derivatives) derive(place, part, mask);
  }
}

/// Computes the sums, masks and shares of the weights. All attributes of a part use them.
template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::weigh(const BlockPlace& place, const DrawnPart& part,
                                   PartMasks& masks) {
  const TriangleValues& values = part.values;
  const double least_sum = values.certificates.least_sum;
  const PlaneRow sum = row_of(values.sum, place, part);
  tap_.summed(shown(place, part, masks.drawn), sum);
  if (values.has_smooth) masks.certain = sum_weights(sum, least_sum, place.count, weights_);
  if (values.has_smooth_float) {
    // Usually least_sum is the greater: it is 2^32 times the sum of the bands, and a band is 0 or
    // about 2^-50 of an edge's largest terms.
    const double least = std::max(least_sum, 0x1p-20 / values.float_scale);
    masks.float_certain = masks.inside & sum_weights(sum, least, place.count, weights_);
    float_smooth_weights(weights_, values.float_scale, place.count, float_smooth_);
  }
  if (values.has_affine_float) {
    std::array<double, 3> factors{};
    for (std::size_t i = 0; i < 3; ++i) factors[i] = values.w[i] / part.weights.det_t;
    float_affine_weights(weights_, factors, place.count, float_affine_);
  }
}

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::evaluate_part(const BlockPlace& place, const DrawnPart& part,
                                           PartMasks masks, SampleBlock& out) {
  const TriangleValues& values = part.values;
  const SampleOffset& offset = setting_.pattern[place.sample];
  weigh(place, part, masks);
  const bool is_depth_exact = !values.has_constant_depth && !values.certificates.depth_is_certain;
  if (!is_depth_exact) {
    const DepthLine& depth = values.depth;
    const PlaneRow row = row_of(depth.plane, place, part);
    evaluate_depth(row, depth.least, depth.greatest, depth.steps, place.count, weights_,
                   out.depth.data());
    tap_.depth(shown(place, part, masks.drawn), row, out.depth.data());
  } else {
    for_each_bit(masks.drawn, [&](int j) {
      const PartPoint at{part, place.first + j + offset.x, place.y + offset.y};
      const double exact = exact_depth_at(values, part.weights, at.u, at.v);
      float& depth = out.depth[static_cast<std::size_t>(j)];
      depth = stored(exact, values.depth.steps);
      tap_.exact(place, j, std::nullopt, at, exact, depth);
    });
  }
  for (std::size_t a = 0; a < values.attributes.size(); ++a) {
    if (blocks_.size() > 1 && state_.attributes[a].location != Location::sample) continue;
    evaluate_attribute(place, part, a, masks, out);
  }
}

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::evaluate_attribute(const BlockPlace& place, const DrawnPart& part,
                                                std::size_t attribute, const PartMasks& masks,
                                                SampleBlock& out) {
  const ValueLine& line = part.values.attributes[attribute];
  std::array<float, kBlockSize>& values = out.attributes[attribute];
  const auto show = [&] {
    tap_.attribute(shown(place, part, masks.drawn), attribute, row_of(line.plane, place, part),
                   line.kind == ValueLine::Kind::smooth ? float_smooth_ : float_affine_,
                   values.data());
  };
  Mask certain = 0;
  switch (line.kind) {
    case ValueLine::Kind::copied:
      values.fill(line.copy);
      return show();
    case ValueLine::Kind::smooth:
      if (line.is_float) {
        evaluate_float(line.r, place.count, float_smooth_, values.data());
        certain = masks.float_certain;
      } else {
        evaluate_smooth(row_of(line.plane, place, part), place.count, weights_, values.data());
        certain = masks.certain;
      }
      break;
    case ValueLine::Kind::affine:
      certain = part.values.certificates.affine_is_certain ? ~Mask{0} : 0;
      if (line.is_float) {
        evaluate_float(line.r, place.count, float_affine_, values.data());
        certain &= masks.inside;
      } else {
        evaluate_affine(row_of(line.plane, place, part), place.count, weights_, values.data());
      }
      break;
  }
  show();
  const Mask exact = masks.drawn & (~certain | masks.at_vertex);
  const SampleOffset& offset = setting_.pattern[place.sample];
  for_each_bit(exact, [&](int j) {
    const PartPoint at{part, place.first + j + offset.x, place.y + offset.y};
    const double value = exact_value_at(line, part.weights, at.u, at.v);
    float& rounded = values[static_cast<std::size_t>(j)];
    rounded = static_cast<float>(value);
    tap_.exact(place, j, attribute, at, value, rounded);
  });
}

/// Evaluates the attributes that have one value per pixel: at the pixel's centre or, for centroid,
/// at the first covered sample unless all samples are covered.
template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::evaluate_pixels(int y, int first, Mask touched) {
  for (std::size_t a = 0; a < state_.attributes.size(); ++a) {
    const Location location = state_.attributes[a].location;
    if (location == Location::sample) continue;
    for_each_bit(touched, [&](int j) {
      const auto is_covered = [j](const SampleBlock& block) {
        return (block.coverage.covered >> j & 1) != 0;
      };
      SampleOffset at = kPixelCenter;
      if (location == Location::centroid &&
          !std::all_of(blocks_.begin(), blocks_.end(), is_covered)) {
        const auto covered = std::find_if(blocks_.begin(), blocks_.end(), is_covered);
        at = setting_.pattern[static_cast<std::size_t>(covered - blocks_.begin())];
      }
      const double u = first + j + at.x;
      const double v = y + at.y;
      const DrawnPart& part = parts_[coverage_.part_at(u, v)];
      const double value = value_at(part.values.attributes[a], part.values, part.weights, u, v);
      const auto rounded_value = static_cast<float>(value);
      for (std::size_t s = 0; s < blocks_.size(); ++s) {
        blocks_[s].attributes[a][static_cast<std::size_t>(j)] = rounded_value;
        if (is_covered(blocks_[s])) {
          tap_.located(BlockPlace{triangle_, s, y, first, kBlockSize}, j, a, PartPoint{part, u, v},
                       value, rounded_value);
        }
      }
      if (!state_.derivatives) return;
      const DerivativeSite site = derivative_site(part.values, part.weights, u, v);
      const Slopes slopes = rounded(derivatives_at(part.derivatives, part.weights, a, site));
      for (std::size_t s = 0; s < blocks_.size(); ++s) derivatives_of(s, j)[a] = slopes;
    });
  }
}

/// Computes the screen derivatives of the attributes that belong to a sample.
template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::derive(const BlockPlace& place, const DrawnPart& part, Mask mask) {
  const SampleOffset& offset = setting_.pattern[place.sample];
  for_each_bit(mask, [&](int j) {
    const DerivativeSite site =
        derivative_site(part.values, part.weights, place.first + j + offset.x, place.y + offset.y);
    for (std::size_t a = 0; a < state_.attributes.size(); ++a) {
      if (blocks_.size() > 1 && state_.attributes[a].location != Location::sample) continue;
      derivatives_of(place.sample, j)[a] =
          rounded(derivatives_at(part.derivatives, part.weights, a, site));
    }
  });
}

template <typename Tap>
DrawCounts draw_with(const State& state, const Mesh& mesh, const TargetSize& size,
                     Fragments& fragments, Tap& tap) {
  const DrawSetting setting(state, size);
  FragmentOutput output(fragments, state.attributes.size());
  if (state.snapping) {
    return Drawing<GridCoverage, Tap>(setting, mesh, output, tap).draw();
  }
  if (state.conservative != Conservative::off) {
    return Drawing<ConservativeCoverage, Tap>(setting, mesh, output, tap).draw();
  }
  return Drawing<ExactCoverage, Tap>(setting, mesh, output, tap).draw();
}

}  // namespace

DrawCounts draw_mesh(const State& state, const Mesh& mesh, const TargetSize& size,
                     Fragments& fragments) {
  if (state.primitive != Primitive::triangles) {
    return draw_primitives(state, mesh, size, fragments);
  }
  NoTap tap;
  return draw_with(state, mesh, size, fragments, tap);
}

std::optional<Trace> trace_mesh(const State& state, const Mesh& mesh, const TargetSize& size,
                                const SamplePlace& address) {
  if (state.primitive != Primitive::triangles) return std::nullopt;
  Mesh alone = mesh;
  alone.triangles = mesh.triangles.subspan(address.triangle, 1);
  RecordingTap tap({0, address.x, address.y, address.sample});
  Fragments fragments;
  draw_with(state, alone, size, fragments, tap);
  return tap.trace();
}

}  // namespace rastercheck::rasterizer
