#include "rasterizer/internal/exact_coverage.h"

#include <algorithm>
#include <cmath>

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

/// True if all corners are beyond one side of the viewport, or all are behind the eye. No point
/// with weights E_i >= 0 is then in sight. Sums of two floats have the right sign in double.
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

/// Finds the pixels with samples in the triangle's bounding box, and at most one more on each side.
/// Takes all pixels if some w <= 0, because the triangle may then reach anywhere.
void ExactCoverage::find_box(const InputTriangle& triangle) {
  const auto& p = triangle.positions;
  const SampleFrame& frame = setting_.frame;
  box_ = {setting_.bounds.columns, setting_.bounds.rows};
  if (p[0].w <= 0 || p[1].w <= 0 || p[2].w <= 0) return;
  const auto range = [](const AxisFrame& axis, double turn, double a, double b, double c,
                        const PixelRange& within) {
    const double half = turn * axis.size / 2;
    const double middle = axis.shift / 2;
    const auto [low, high] = std::minmax({a * half, b * half, c * half});
    // Relative errors: 2^-52 of an end for the quotient and the product together, 2^-53 for the
    // shift and for each of the two sums. In total this is less than `error`. The extra pixel is
    // cheap.
    const double error = 0x1p-50 * (std::max(std::abs(low), std::abs(high)) + std::abs(middle));
    return pixels_from_through(within, 0, middle + low - (1 + error), middle + high + (1 + error));
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

/// Returns the pixels of a row whose samples may lie inside all edges, and at most one more pixel
/// on each side. In real numbers a U + row < −2 band implies that the evaluated edge is below
/// −band, because an evaluation's error is less than a band. Near the target the crossing itself is
/// off by a few 2^-53 times numbers below 2^20.
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

/// Decides exactly whether a sample is inside. Requires that no edge function at the sample is
/// below −band.
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
