#include "rasterizer/internal/drawing.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/exact_coverage.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/float_kernels.h"
#include "rasterizer/internal/grid_coverage.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/tap.h"

namespace rastercheck::rasterizer {
namespace {

/// What a block holds of one sample of its pixels.
struct SampleBlock {
  CoveredBlock coverage;
  std::array<float, kBlockSize> depth;
  std::array<std::array<float, kBlockSize>, kMaxAttributes> attributes;

  void take(Mask mask, const SampleBlock& other, std::size_t attribute_count) {
    for_each_bit(mask, [&](int j) {
      const auto column = static_cast<std::size_t>(j);
      depth[column] = other.depth[column];
      for (std::size_t a = 0; a < attribute_count; ++a) {
        attributes[a][column] = other.attributes[a][column];
      }
    });
  }
};

/// Samples of a block.
struct PartMasks {
  Mask drawn = 0;      ///< of the part
  Mask inside = 0;     ///< no weight is surely negative
  Mask at_vertex = 0;  ///< CoveredBlock::at_vertex
  Mask certain = 0;    ///< whose smooth values double holds
  /// Of these, whose weights float32 holds as well.
  Mask float_certain = 0;
};

template <typename Coverage, typename Tap>
class Drawing {
 public:
  Drawing(const DrawSetting& setting, const Mesh& mesh, Fragments& fragments, Tap& tap)
      : setting_(setting),
        state_(setting.state),
        mesh_(mesh),
        fragments_(fragments),
        tap_(tap),
        coverage_(setting),
        blocks_(setting.pattern.size()) {
    if (!state_.derivatives) return;
    derivatives_.resize(blocks_.size() * kBlockSize * state_.attributes.size());
  }

  DrawCounts draw() {
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) draw_triangle(i);
    return counts_;
  }

 private:
  void draw_triangle(std::size_t index);
  void draw_row(int y);
  void evaluate(const BlockPlace& place, SampleBlock& block);
  void evaluate_part(const BlockPlace& place, const DrawnPart& part, PartMasks masks,
                     SampleBlock& out);
  void weigh(const BlockPlace& place, const DrawnPart& part, PartMasks& masks);
  Mask evaluate_attribute(const BlockPlace& place, const DrawnPart& part, std::size_t attribute,
                          const PartMasks& masks, SampleBlock& out);
  void locate(int y, int first, Mask touched);
  void derive(const BlockPlace& place, const DrawnPart& part, Mask mask);
  Slopes* derivatives_of(std::size_t sample, int column) {
    return derivatives_.data() +
           (sample * kBlockSize + static_cast<std::size_t>(column)) * state_.attributes.size();
  }
  void emit(int y, int first, Mask touched);
  void emit_derivatives(std::size_t at, std::size_t end, Mask touched);

  // Of the block at hand; first, as they are aligned to cache lines.
  BlockWeights weights_;
  FloatWeights float_smooth_;
  FloatWeights float_affine_;
  const DrawSetting& setting_;
  const State& state_;
  const Mesh& mesh_;
  Fragments& fragments_;
  Tap& tap_;
  Coverage coverage_;
  std::vector<SampleBlock> blocks_;       ///< [sample], of the block at hand
  std::unique_ptr<SampleBlock> of_part_;  ///< where a triangle is drawn in several parts
  /// [sample][column][attribute], of the block at hand; none without State::derivatives.
  std::vector<Slopes> derivatives_;
  DrawCounts counts_;

  // Of the triangle at hand.
  std::uint32_t triangle_ = 0;
  std::vector<DrawnPart> parts_;
};

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::draw_triangle(std::size_t index) {
  const glm::uvec3& corners = mesh_.triangles[index];
  if (!is_finite(state_, mesh_, corners.x) || !is_finite(state_, mesh_, corners.y) ||
      !is_finite(state_, mesh_, corners.z)) {
    ++counts_.discarded_not_finite;
    return;
  }
  const auto parts_of = [&corners](std::span<const float> all, std::size_t count) {
    return std::array{all.subspan(corners.x * count, count), all.subspan(corners.y * count, count),
                      all.subspan(corners.z * count, count)};
  };
  InputTriangle triangle;
  triangle.index = static_cast<std::uint32_t>(index);
  triangle.positions = {mesh_.positions[corners.x], mesh_.positions[corners.y],
                        mesh_.positions[corners.z]};
  triangle.distances = parts_of(mesh_.clip_distances, state_.clip_distance_count);
  triangle.attributes = parts_of(mesh_.attributes, state_.attributes.size());

  const bool is_empty = state_.viewport.size.x == 0 || state_.viewport.size.y == 0;
  const Fate fate = is_empty ? Fate::degenerate : coverage_.set_up(triangle, parts_);
  if (fate == Fate::degenerate) ++counts_.discarded_degenerate;
  if (fate != Fate::drawn) return;

  triangle_ = triangle.index;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    set_up_values(state_, parts_[k].source, parts_[k].weights, parts_[k].values);
    if (state_.derivatives) {
      set_up_derivatives(state_, parts_[k].source, parts_[k].weights, parts_[k].values,
                         parts_[k].derivatives);
    }
    tap_.set_up(triangle_, parts_[k], k);
  }
  if (parts_.size() > 1 && !of_part_) of_part_ = std::make_unique<SampleBlock>();
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
    const int count = std::min(kBlockSize, span.end - first);
    Mask touched = 0;
    for (std::size_t s = 0; s < blocks_.size(); ++s) {
      SampleBlock& block = blocks_[s];
      block.coverage = {};
      if (!setting_.bounds.sample_rows[s].contains(y)) continue;
      block.coverage = coverage_.cover(s, y, first, count, weights_);
      if (block.coverage.covered == 0) continue;
      touched |= block.coverage.covered;
      const BlockPlace place{triangle_, s, y, first, count};
      tap_.covered(place, block.coverage);
      evaluate(place, block);
    }
    if (touched == 0) continue;
    if (blocks_.size() > 1) locate(y, first, touched);
    emit(y, first, touched);
  }
}

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::evaluate(const BlockPlace& place, SampleBlock& block) {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const DrawnPart& part = parts_[k];
    const Mask mask = coverage_.part_mask(block.coverage, k);
    if (mask == 0) continue;
    PartMasks masks{mask, mask, block.coverage.at_vertex};
    const SampleOffset& offset = setting_.pattern[place.sample];
    if constexpr (!Coverage::kLeavesWeights) {
      const EdgeRow row =
          edge_row(part.weights.edges, *part.weights.frame, place.y + offset.y, offset.x);
      masks.inside = evaluate_edges(row, place.first, place.count, weights_).possible;
    }
    tap_.weighed(place, offset, k, mask, weights_);
    SampleBlock& out = parts_.size() == 1 ? block : *of_part_;
    evaluate_part(place, part, masks, out);
    if (parts_.size() > 1) block.take(mask, out, state_.attributes.size());
    if (state_.derivatives) derive(place, part, mask);
  }
}

/// What all attributes of a part need of the weights.
template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::weigh(const BlockPlace& place, const DrawnPart& part,
                                   PartMasks& masks) {
  const TriangleValues& values = part.values;
  const double least_sum = values.certificates.least_sum;
  if (values.has_smooth) masks.certain = sum_weights(least_sum, place.count, weights_);
  if (values.has_smooth_float) {
    // Mostly the same as `certain`: a band is 2^-50 of the largest terms, or 0.
    const double least = std::max(least_sum, 0x1p-20 / values.float_scale);
    masks.float_certain = masks.inside & sum_weights(least, place.count, weights_);
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
  if (values.has_constant_depth) {
    out.depth.fill(values.constant_depth);
  } else if (!is_depth_exact) {
    evaluate_depth(values.depth, place.count, weights_, out.depth.data());
  } else {
    for_each_bit(masks.drawn, [&](int j) {
      out.depth[static_cast<std::size_t>(j)] =
          exact_depth_at(values, part.weights, place.first + j + offset.x, place.y + offset.y);
    });
  }
  tap_.depth(place, masks.drawn, is_depth_exact, out.depth.data());
  for (std::size_t a = 0; a < values.attributes.size(); ++a) {
    if (blocks_.size() > 1 && state_.attributes[a].location != Location::sample) continue;
    const Mask exact = evaluate_attribute(place, part, a, masks, out);
    tap_.attribute(place, a, masks.drawn, exact, out.attributes[a].data());
  }
}

/// Returns the samples for which double was not enough.
template <typename Coverage, typename Tap>
Mask Drawing<Coverage, Tap>::evaluate_attribute(const BlockPlace& place, const DrawnPart& part,
                                                std::size_t attribute, const PartMasks& masks,
                                                SampleBlock& out) {
  const ValueLine& line = part.values.attributes[attribute];
  std::array<float, kBlockSize>& values = out.attributes[attribute];
  Mask certain = 0;
  switch (line.kind) {
    case ValueLine::Kind::copied:
      values.fill(line.copy);
      return 0;
    case ValueLine::Kind::smooth:
      if (line.is_float) {
        evaluate_float(line.r, place.count, float_smooth_, values.data());
        certain = masks.float_certain;
      } else {
        evaluate_smooth(line.numerators, place.count, weights_, values.data());
        certain = masks.certain;
      }
      break;
    case ValueLine::Kind::affine:
      certain = part.values.certificates.affine_is_certain ? ~Mask{0} : 0;
      if (line.is_float) {
        evaluate_float(line.r, place.count, float_affine_, values.data());
        certain &= masks.inside;
      } else {
        evaluate_affine(line.numerators, 1 / part.weights.det_t, place.count, weights_,
                        values.data());
      }
      break;
  }
  const Mask exact = masks.drawn & (~certain | masks.at_vertex);
  const SampleOffset& offset = setting_.pattern[place.sample];
  for_each_bit(exact, [&](int j) {
    values[static_cast<std::size_t>(j)] =
        exact_value_at(line, part.weights, place.first + j + offset.x, place.y + offset.y);
  });
  return exact;
}

/// Attributes that belong to the pixel and not to its samples: at the centre, or, centroid, at the
/// first covered sample where not all are.
template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::locate(int y, int first, Mask touched) {
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
      const float value = value_at(part.values.attributes[a], part.values, part.weights, u, v);
      for (std::size_t s = 0; s < blocks_.size(); ++s) {
        blocks_[s].attributes[a][static_cast<std::size_t>(j)] = value;
        if (is_covered(blocks_[s])) {
          tap_.located({triangle_, s, y, first, kBlockSize}, j, a, u, v, value);
        }
      }
      if (!state_.derivatives) return;
      const DerivativeSite site = derivative_site(part.values, part.weights, u, v);
      const auto slopes = derivatives_at(part.derivatives, part.weights, a, site);
      for (std::size_t s = 0; s < blocks_.size(); ++s) derivatives_of(s, j)[a] = slopes;
    });
  }
}

/// The screen derivatives of the attributes that belong to a sample.
template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::derive(const BlockPlace& place, const DrawnPart& part, Mask mask) {
  const SampleOffset& offset = setting_.pattern[place.sample];
  for_each_bit(mask, [&](int j) {
    const DerivativeSite site =
        derivative_site(part.values, part.weights, place.first + j + offset.x, place.y + offset.y);
    for (std::size_t a = 0; a < state_.attributes.size(); ++a) {
      if (blocks_.size() > 1 && state_.attributes[a].location != Location::sample) continue;
      derivatives_of(place.sample, j)[a] = derivatives_at(part.derivatives, part.weights, a, site);
    }
  });
}

template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::emit(int y, int first, Mask touched) {
  const std::size_t attributes = state_.attributes.size();
  std::size_t at = fragments_.size();
  std::size_t end = at;
  for (const SampleBlock& block : blocks_) {
    end += static_cast<std::size_t>(std::popcount(block.coverage.covered));
  }
  fragments_.triangle.resize(end, triangle_);
  fragments_.x.resize(end);
  fragments_.y.resize(end, static_cast<std::uint16_t>(y));
  fragments_.sample.resize(end);
  fragments_.depth.resize(end);
  fragments_.attributes.resize(end * attributes);
  if (state_.derivatives) emit_derivatives(at, end, touched);
  for_each_bit(touched, [&](int j) {
    const auto column = static_cast<std::size_t>(j);
    for (std::size_t s = 0; s < blocks_.size(); ++s) {
      const SampleBlock& block = blocks_[s];
      if ((block.coverage.covered >> j & 1) == 0) continue;
      fragments_.x[at] = static_cast<std::uint16_t>(first + j);
      fragments_.sample[at] = static_cast<std::uint8_t>(s);
      fragments_.depth[at] = block.depth[column];
      for (std::size_t a = 0; a < attributes; ++a) {
        fragments_.attributes[at * attributes + a] = block.attributes[a][column];
      }
      ++at;
    }
  });
}

/// Fragments `at` … `end` are those of the block.
template <typename Coverage, typename Tap>
void Drawing<Coverage, Tap>::emit_derivatives(std::size_t at, std::size_t end, Mask touched) {
  const std::size_t attributes = state_.attributes.size();
  fragments_.derivatives.resize(end * attributes * 2);
  for_each_bit(touched, [&](int j) {
    for (std::size_t s = 0; s < blocks_.size(); ++s) {
      if ((blocks_[s].coverage.covered >> j & 1) == 0) continue;
      for (std::size_t a = 0; a < attributes; ++a) {
        const Slopes& slopes = derivatives_of(s, j)[a];
        std::copy_n(slopes.data(), 2, fragments_.derivatives.data() + (at * attributes + a) * 2);
      }
      ++at;
    }
  });
}

template <typename Tap>
DrawCounts draw_with(const State& state, const Mesh& mesh, const TargetSize& size,
                     Fragments& fragments, Tap& tap) {
  const DrawSetting setting(state, size);
  if (state.snapping) return Drawing<GridCoverage, Tap>(setting, mesh, fragments, tap).draw();
  return Drawing<ExactCoverage, Tap>(setting, mesh, fragments, tap).draw();
}

}  // namespace

DrawCounts draw_mesh(const State& state, const Mesh& mesh, const TargetSize& size,
                     Fragments& fragments) {
  NoTap tap;
  return draw_with(state, mesh, size, fragments, tap);
}

std::optional<Trace> trace_mesh(const State& state, const Mesh& mesh, const TargetSize& size,
                                const SampleAddress& address) {
  RecordingTap tap(address);
  Fragments fragments;
  draw_with(state, mesh, size, fragments, tap);
  return tap.trace();
}

}  // namespace rastercheck::rasterizer
