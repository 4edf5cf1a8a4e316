#include "rasterizer/internal/exact_draw.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/clip_functionals.h"
#include "rasterizer/internal/determinant.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/edge_functions.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/sample_frame.h"
#include "rasterizer/internal/standard_pattern.h"

namespace rastercheck::rasterizer {
namespace {

using Mask = std::uint64_t;

/// Calls `visit` with the number of every set bit, in ascending order.
template <typename Visit>
void for_each_bit(Mask mask, const Visit& visit) {
  for (; mask != 0; mask &= mask - 1) visit(std::countr_zero(mask));
}

/// Bits j with begin <= first + j < end.
Mask columns_mask(const PixelRange& columns, int first) {
  const int begin = std::clamp(columns.begin - first, 0, kBlockSize);
  const int end = std::clamp(columns.end - first, 0, kBlockSize);
  if (begin >= end) return 0;
  const Mask below_end = end == kBlockSize ? ~Mask{0} : (Mask{1} << end) - 1;
  return below_end & ~((Mask{1} << begin) - 1);
}

/// What a block holds of one sample of its pixels.
struct SampleBlock {
  Mask covered = 0;
  std::array<float, kBlockSize> depth;
  std::array<std::array<float, kBlockSize>, kMaxAttributes> attributes;
};

class ExactDrawing {
 public:
  ExactDrawing(const State& state, const Mesh& mesh, const TargetSize& size, Fragments& fragments)
      : blocks_(static_cast<std::size_t>(size.samples)),
        state_(state),
        mesh_(mesh),
        fragments_(fragments),
        pattern_(standard_pattern(size.samples)),
        bounds_(draw_bounds(state, size)),
        frame_(sample_frame(state, bounds_, size.samples)) {
    const bool v_points_down = state.convention != Convention::opengl;
    tie_sign_ = (state.fill_rule == FillRule::top_left) == v_points_down ? 1 : -1;
  }

  DrawCounts draw() {
    const bool is_empty = state_.viewport.size.x == 0 || state_.viewport.size.y == 0;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) draw_triangle(i, is_empty);
    return counts_;
  }

 private:
  void draw_triangle(std::size_t index, bool viewport_is_empty);
  void find_box();
  void draw_row(int y);
  PixelRange span_of_row(double v, double offset) const;
  Mask cover(std::size_t sample, int y, int first, int count);
  bool is_inside(int column, double u, double v) const;
  void evaluate(std::size_t sample, int y, int first, int count);
  void evaluate_attribute(std::size_t attribute, std::size_t sample, int y, int first, int count,
                          Mask certain);
  void locate(int y, int first, Mask touched);
  void emit(int y, int first, Mask touched);

  BlockWeights weights_;  ///< of the block at hand; first, as it is aligned to a cache line
  std::vector<SampleBlock> blocks_;  ///< [sample], of the block at hand
  const State& state_;
  const Mesh& mesh_;
  Fragments& fragments_;
  std::span<const SampleOffset> pattern_;
  DrawBounds bounds_;
  SampleFrame frame_;
  int tie_sign_ = 1;
  DrawCounts counts_;

  // Of the triangle at hand.
  std::uint32_t triangle_ = 0;
  std::array<glm::vec4, 3> corners_;
  EdgeFunctions edges_;
  ClipFunctionals clips_;
  TriangleValues values_;
  PixelRange columns_;
  PixelRange rows_;
};

void ExactDrawing::draw_triangle(std::size_t index, bool viewport_is_empty) {
  const glm::uvec3& corners = mesh_.triangles[index];
  if (!is_finite(state_, mesh_, corners.x) || !is_finite(state_, mesh_, corners.y) ||
      !is_finite(state_, mesh_, corners.z)) {
    ++counts_.discarded_not_finite;
    return;
  }
  corners_ = {mesh_.positions[corners.x], mesh_.positions[corners.y], mesh_.positions[corners.z]};
  const int turn = determinant_sign(corners_[0], corners_[1], corners_[2]);
  if (turn == 0 || viewport_is_empty) {
    ++counts_.discarded_degenerate;
    return;
  }
  if (is_culled(state_, turn * frame_.u.direction * frame_.v.direction)) return;

  const auto part = [](std::span<const float> all, std::uint32_t vertex, std::size_t count) {
    return all.subspan(vertex * count, count);
  };
  const std::size_t distances = state_.clip_distance_count;
  clip_functionals(state_, corners_,
                   {part(mesh_.clip_distances, corners.x, distances),
                    part(mesh_.clip_distances, corners.y, distances),
                    part(mesh_.clip_distances, corners.z, distances)},
                   clips_);
  if (clips_.hides_all) return;
  find_box();
  if (columns_.empty() || rows_.empty()) return;

  triangle_ = static_cast<std::uint32_t>(index);
  edges_ = edge_functions(corners_, turn, frame_, tie_sign_);
  const std::size_t attributes = state_.attributes.size();
  set_up_values(
      state_, corners_,
      {part(mesh_.attributes, corners.x, attributes), part(mesh_.attributes, corners.y, attributes),
       part(mesh_.attributes, corners.z, attributes)},
      edges_, frame_, values_);
  for (int y = rows_.begin; y < rows_.end; ++y) draw_row(y);
}

/// The pixels that the triangle's bounding box touches, and one more on each side: far more than
/// what its rounding is off by. With some w <= 0 it may reach anywhere, and where the viewport's
/// own numbers are rounded all pixels are looked at.
void ExactDrawing::find_box() {
  columns_ = bounds_.columns;
  rows_ = bounds_.rows;
  const bool all_in_front = corners_[0].w > 0 && corners_[1].w > 0 && corners_[2].w > 0;
  if (!all_in_front || !frame_.u.is_exact || !frame_.v.is_exact) return;
  const auto range = [](const AxisFrame& axis, double turn, double a, double b, double c,
                        const PixelRange& within) {
    const double half = turn * axis.size / 2;
    const double middle = axis.shift / 2;
    const auto [low, high] = std::minmax({a * half, b * half, c * half});
    return pixels_from_through(within, 0, middle + low - 1, middle + high + 1);
  };
  const auto ndc = [this](std::size_t i, auto member) {
    return double{corners_[i].*member} / double{corners_[i].w};
  };
  const double turn_v = state_.convention == Convention::d3d ? -1 : 1;
  columns_ = range(frame_.u, 1, ndc(0, &glm::vec4::x), ndc(1, &glm::vec4::x), ndc(2, &glm::vec4::x),
                   columns_);
  rows_ = range(frame_.v, turn_v, ndc(0, &glm::vec4::y), ndc(1, &glm::vec4::y),
                ndc(2, &glm::vec4::y), rows_);
}

/// The pixels of a row of samples that no edge surely excludes, and at most a pixel more on each
/// side. In real numbers a U + row < −2 band implies that the evaluated edge is below −band, as
/// evaluating is off by less than a band; the crossing itself is off by a few 2^-53 of numbers
/// below 2^20 wherever it lies near the target.
PixelRange ExactDrawing::span_of_row(double v, double offset) const {
  PixelRange span = columns_;
  if (!frame_.u.is_exact) return span;
  for (const EdgeFunction& edge : edges_) {
    const double slope = edge.a.value * frame_.u.scale;
    if (slope == 0) continue;
    const double crossing =
        ((-edge.row(frame_, v) - 2 * edge.band) / slope + frame_.u.shift) / 2 - offset;
    if (slope > 0) {
      if (crossing - 1 > span.begin) {
        span.begin = crossing - 1 >= span.end ? span.end : static_cast<int>(crossing - 1);
      }
    } else if (crossing + 2 < span.end) {
      span.end = crossing + 2 <= span.begin ? span.begin : static_cast<int>(crossing + 2);
    }
  }
  return span;
}

void ExactDrawing::draw_row(int y) {
  PixelRange span{columns_.end, columns_.begin};
  for (std::size_t s = 0; s < pattern_.size(); ++s) {
    if (!bounds_.sample_rows[s].contains(y)) continue;
    const PixelRange of_sample = span_of_row(y + pattern_[s].y, pattern_[s].x);
    if (of_sample.empty()) continue;
    span.begin = std::min(span.begin, of_sample.begin);
    span.end = std::max(span.end, of_sample.end);
  }
  for (int first = span.begin; first < span.end; first += kBlockSize) {
    const int count = std::min(kBlockSize, span.end - first);
    Mask touched = 0;
    for (std::size_t s = 0; s < pattern_.size(); ++s) {
      blocks_[s].covered = bounds_.sample_rows[s].contains(y) ? cover(s, y, first, count) : 0;
      if (blocks_[s].covered == 0) continue;
      touched |= blocks_[s].covered;
      evaluate(s, y, first, count);
    }
    if (touched == 0) continue;
    if (pattern_.size() > 1) locate(y, first, touched);
    emit(y, first, touched);
  }
}

/// The covered pixels of a block: in double where that is certain, else exactly.
Mask ExactDrawing::cover(std::size_t sample, int y, int first, int count) {
  const double v = y + pattern_[sample].y;
  EdgeRow row;
  for (std::size_t i = 0; i < 3; ++i) {
    row.a[i] = edges_[i].a.value;
    row.row[i] = edges_[i].row(frame_, v);
    row.band[i] = edges_[i].band;
  }
  row.scale = frame_.u.scale;
  row.shift = frame_.u.shift;
  row.offset = pattern_[sample].x;
  const BlockCoverage coverage = evaluate_edges(row, first, count, weights_);

  const Mask wanted = columns_mask(bounds_.sample_columns[sample], first);
  Mask covered = coverage.sure & wanted;
  for_each_bit(coverage.possible & ~coverage.sure & wanted, [&](int j) {
    if (is_inside(j, first + j + row.offset, v)) covered |= Mask{1} << j;
  });
  if (clips_.all.empty()) return covered;
  for_each_bit(covered, [&](int j) {
    const auto column = static_cast<std::size_t>(j);
    const std::array<double, 3> e{weights_.e[0][column], weights_.e[1][column],
                                  weights_.e[2][column]};
    const bool is_visible =
        std::all_of(clips_.all.begin(), clips_.all.end(), [&](const ClipFunctional& functional) {
          return is_kept(functional, edges_, e, frame_, first + j + row.offset, v, tie_sign_);
        });
    if (!is_visible) covered &= ~(Mask{1} << j);
  });
  return covered;
}

/// A sample that is within the band of some edge and beyond that of none.
bool ExactDrawing::is_inside(int column, double u, double v) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeFunction& edge = edges_[i];
    const double e = weights_.e[i][static_cast<std::size_t>(column)];
    if (e > edge.band) continue;
    const int side = edge.band == 0 ? 0 : exact_edge(edge, frame_, u, v).sign();
    if (side < 0 || (side == 0 && !edge.owns_zero)) return false;
  }
  return true;
}

void ExactDrawing::evaluate(std::size_t sample, int y, int first, int count) {
  SampleBlock& block = blocks_[sample];
  const double v = y + pattern_[sample].y;
  const Mask certain = sum_weights(values_.least_sum, count, weights_);
  if (values_.has_constant_depth) {
    block.depth.fill(values_.constant_depth);
  } else if (values_.depth_is_certain) {
    evaluate_depth(values_.depth, count, weights_, block.depth.data());
  } else {
    for_each_bit(block.covered, [&](int j) {
      block.depth[static_cast<std::size_t>(j)] =
          exact_depth_at(values_, edges_, frame_, first + j + pattern_[sample].x, v);
    });
  }
  for (std::size_t a = 0; a < values_.attributes.size(); ++a) {
    const bool at_sample =
        pattern_.size() == 1 || state_.attributes[a].location == Location::sample;
    if (at_sample) evaluate_attribute(a, sample, y, first, count, certain);
  }
}

void ExactDrawing::evaluate_attribute(std::size_t attribute, std::size_t sample, int y, int first,
                                      int count, Mask certain) {
  SampleBlock& block = blocks_[sample];
  const ValueLine& line = values_.attributes[attribute];
  std::array<float, kBlockSize>& out = block.attributes[attribute];
  Mask doubtful = 0;
  switch (line.kind) {
    case ValueLine::Kind::copied:
      out.fill(line.copy);
      return;
    case ValueLine::Kind::smooth:
      evaluate_smooth(line.numerators, count, weights_, out.data());
      doubtful = block.covered & ~certain;
      break;
    case ValueLine::Kind::affine:
      evaluate_affine(line.numerators, 1 / values_.det_t, count, weights_, out.data());
      doubtful = values_.affine_is_certain ? 0 : block.covered;
      break;
  }
  for_each_bit(doubtful, [&](int j) {
    out[static_cast<std::size_t>(j)] = exact_value_at(
        line, values_, edges_, frame_, first + j + pattern_[sample].x, y + pattern_[sample].y);
  });
}

/// Attributes that belong to the pixel and not to its samples: at the centre, or, centroid, at the
/// first covered sample where not all are.
void ExactDrawing::locate(int y, int first, Mask touched) {
  for (std::size_t a = 0; a < values_.attributes.size(); ++a) {
    const Location location = state_.attributes[a].location;
    if (location == Location::sample) continue;
    for_each_bit(touched, [&](int j) {
      const auto is_covered = [j](const SampleBlock& block) {
        return (block.covered >> j & 1) != 0;
      };
      SampleOffset at = kPixelCenter;
      if (location == Location::centroid &&
          !std::all_of(blocks_.begin(), blocks_.end(), is_covered)) {
        const auto covered = std::find_if(blocks_.begin(), blocks_.end(), is_covered);
        at = pattern_[static_cast<std::size_t>(covered - blocks_.begin())];
      }
      const float value =
          value_at(values_.attributes[a], values_, edges_, frame_, first + j + at.x, y + at.y);
      for (SampleBlock& block : blocks_) block.attributes[a][static_cast<std::size_t>(j)] = value;
    });
  }
}

void ExactDrawing::emit(int y, int first, Mask touched) {
  for_each_bit(touched, [&](int j) {
    for (std::size_t s = 0; s < blocks_.size(); ++s) {
      const SampleBlock& block = blocks_[s];
      if ((block.covered >> j & 1) == 0) continue;
      const auto column = static_cast<std::size_t>(j);
      fragments_.triangle.push_back(triangle_);
      fragments_.x.push_back(static_cast<std::uint16_t>(first + j));
      fragments_.y.push_back(static_cast<std::uint16_t>(y));
      fragments_.sample.push_back(static_cast<std::uint8_t>(s));
      fragments_.depth.push_back(block.depth[column]);
      for (std::size_t a = 0; a < values_.attributes.size(); ++a) {
        fragments_.attributes.push_back(block.attributes[a][column]);
      }
    }
  });
}

}  // namespace

DrawCounts draw_exact(const State& state, const Mesh& mesh, const TargetSize& size,
                      Fragments& fragments) {
  return ExactDrawing(state, mesh, size, fragments).draw();
}

}  // namespace rastercheck::rasterizer
