#include "rasterizer/internal/exact_coverage.h"

#include <algorithm>

#include "rasterizer/internal/determinant.h"
#include "rasterizer/internal/discard.h"

namespace rastercheck::rasterizer {

EdgeRow edge_row(const EdgeFunctions& edges, const SampleFrame& frame, double v, double offset) {
  EdgeRow row;
  for (std::size_t i = 0; i < 3; ++i) {
    row.a[i] = edges[i].a.value;
    row.row[i] = edges[i].row(frame, v);
    row.band[i] = edges[i].band;
  }
  row.scale = frame.u.scale;
  row.shift = frame.u.shift;
  row.offset = offset;
  return row;
}

namespace {

/// Whether all corners are beyond one side of the viewport, or behind the eye: then so is whatever
/// weights E_i >= 0 make of them. Sums of floats have the right sign in double.
bool is_out_of_sight(const std::array<glm::vec4, 3>& p) {
  const auto all = [&p](auto holds) { return std::all_of(p.begin(), p.end(), holds); };
  return all([](const glm::vec4& q) { return q.w <= 0; }) ||
         all([](const glm::vec4& q) { return double{q.w} + double{q.x} < 0; }) ||
         all([](const glm::vec4& q) { return double{q.w} - double{q.x} < 0; }) ||
         all([](const glm::vec4& q) { return double{q.w} + double{q.y} < 0; }) ||
         all([](const glm::vec4& q) { return double{q.w} - double{q.y} < 0; });
}

}  // namespace

Fate ExactCoverage::locate(const InputTriangle& triangle) {
  if (setting_.is_empty()) return Fate::degenerate;
  const auto& p = triangle.positions;
  turn_ = determinant_sign(p[0], p[1], p[2]);
  if (turn_ == 0) return Fate::degenerate;
  if (is_culled(setting_.state, setting_.frame.displayed(turn_))) return Fate::hidden;
  if (is_out_of_sight(p)) return Fate::hidden;
  clip_functionals(setting_.state, p, triangle.distances, clips_);
  if (clips_.hides_all) return Fate::hidden;
  find_box(triangle);
  return box_.columns.empty() || box_.rows.empty() ? Fate::hidden : Fate::drawn;
}

Fate ExactCoverage::set_up(const InputTriangle& triangle, std::vector<DrawnPart>& parts) {
  const Fate fate = locate(triangle);
  if (fate != Fate::drawn) return fate;
  const auto& p = triangle.positions;
  const SampleFrame& frame = setting_.frame;
  edges_ = edge_functions(p, turn_, frame, setting_.tie_sign);
  parts.resize(1);
  parts[0].weights.set_ideal(p, edges_, frame);
  parts[0].source = {p, triangle.attributes, {}};
  return Fate::drawn;
}

/// The pixels that the triangle's bounding box touches, and one more on each side: far more than
/// what its rounding is off by. With some w <= 0 it may reach anywhere, and where the viewport's
/// own numbers are rounded all pixels are looked at.
void ExactCoverage::find_box(const InputTriangle& triangle) {
  const auto& p = triangle.positions;
  const SampleFrame& frame = setting_.frame;
  box_ = {setting_.bounds.columns, setting_.bounds.rows};
  const bool all_in_front = p[0].w > 0 && p[1].w > 0 && p[2].w > 0;
  if (!all_in_front || !frame.u.is_exact || !frame.v.is_exact) return;
  const auto range = [](const AxisFrame& axis, double turn, double a, double b, double c,
                        const PixelRange& within) {
    const double half = turn * axis.size / 2;
    const double middle = axis.shift / 2;
    const auto [low, high] = std::minmax({a * half, b * half, c * half});
    return pixels_from_through(within, 0, middle + low - 1, middle + high + 1);
  };
  const auto ndc = [&p](std::size_t i, auto member) {
    return double{p[i].*member} / double{p[i].w};
  };
  const double turn_v = setting_.state.convention == Convention::d3d ? -1 : 1;
  box_.columns = range(frame.u, 1, ndc(0, &glm::vec4::x), ndc(1, &glm::vec4::x),
                       ndc(2, &glm::vec4::x), box_.columns);
  box_.rows = range(frame.v, turn_v, ndc(0, &glm::vec4::y), ndc(1, &glm::vec4::y),
                    ndc(2, &glm::vec4::y), box_.rows);
}

/// The pixels of a row of samples that no edge surely excludes, and at most a pixel more on each
/// side. In real numbers a U + row < −2 band implies that the evaluated edge is below −band, as
/// evaluating is off by less than a band; the crossing itself is off by a few 2^-53 of numbers
/// below 2^20 wherever it lies near the target.
PixelRange ExactCoverage::span(std::size_t sample, int y) const {
  const SampleFrame& frame = setting_.frame;
  const SampleOffset& offset = setting_.pattern[sample];
  PixelRange span = box_.columns;
  if (!frame.u.is_exact) return span;
  for (const EdgeFunction& edge : edges_) {
    const double slope = edge.a.value * frame.u.scale;
    if (slope == 0) continue;
    const double crossing =
        ((-edge.row(frame, y + offset.y) - 2 * edge.band) / slope + frame.u.shift) / 2 - offset.x;
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

CoveredBlock ExactCoverage::cover(std::size_t sample, int y, int first, int count,
                                  BlockWeights& weights) const {
  const SampleOffset& offset = setting_.pattern[sample];
  const double v = y + offset.y;
  const BlockCoverage coverage =
      evaluate_edges(edge_row(edges_, setting_.frame, v, offset.x), first, count, weights);

  const Mask wanted = columns_mask(setting_.bounds.sample_columns[sample], first);
  CoveredBlock block;
  block.covered = coverage.sure & wanted;
  for_each_bit(coverage.possible & ~coverage.sure & wanted, [&](int j) {
    if (!is_inside(weights, j, first + j + offset.x, v)) return;
    block.covered |= Mask{1} << j;
    block.in_doubt |= Mask{1} << j;
    if (is_at_vertex(weights, j)) block.at_vertex |= Mask{1} << j;
  });
  if (clips_.all.empty()) return block;
  for_each_bit(block.covered, [&](int j) {
    if (!is_visible(weights, j, first + j + offset.x, v)) block.covered &= ~(Mask{1} << j);
  });
  return block;
}

/// A sample that is within the band of some edge and beyond that of none.
bool ExactCoverage::is_inside(const BlockWeights& weights, int column, double u, double v) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeFunction& edge = edges_[i];
    const double e = weights.e[i][static_cast<std::size_t>(column)];
    if (e > edge.band) continue;
    const int side = edge.band == 0 ? 0 : exact_edge(edge, setting_.frame, u, v).sign();
    if (side < 0 || (side == 0 && !edge.owns_zero)) return false;
  }
  return true;
}

bool ExactCoverage::is_visible(const BlockWeights& weights, int column, double u, double v) const {
  const auto j = static_cast<std::size_t>(column);
  const std::array<double, 3> e{weights.e[0][j], weights.e[1][j], weights.e[2][j]};
  return std::all_of(clips_.all.begin(), clips_.all.end(), [&](const ClipFunctional& functional) {
    return is_kept(functional, edges_, e, setting_.frame, u, v, setting_.tie_sign);
  });
}

bool ExactCoverage::is_at_vertex(const BlockWeights& weights, int column) const {
  int near = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    near += weights.e[i][static_cast<std::size_t>(column)] > edges_[i].band ? 0 : 1;
  }
  return near >= 2;
}

}  // namespace rastercheck::rasterizer
