#include "rasterizer/internal/tap.h"

#include <array>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

using UnroundedValues = std::array<double, kBlockSize>;

TracedPlane plane_of(const Plane& plane) { return {plane.a, plane.b, plane.c}; }

TracedAxis axis_of(const AxisFrame& axis) { return {axis.scale, axis.shift}; }

TracedCorner traced(const GridCorner& corner, double units_of_a_pixel) {
  return {static_cast<double>(corner.at.x) / units_of_a_pixel,
          static_cast<double>(corner.at.y) / units_of_a_pixel,
          corner.z,
          corner.w,
          false,
          corner.share};
}

/// The shares of a sample, from the steps of float_kernels.h. They sum to 1 up to a rounding.
std::array<double, 3> shares_of(const FloatWeights& weights, std::size_t column) {
  const auto pivot = static_cast<std::size_t>(weights.pivot[column]);
  const double next = weights.steps[pivot][column];
  const double last = -weights.steps[(pivot + 2) % 3][column];
  std::array<double, 3> shares{};
  shares[pivot] = 1 - next - last;
  shares[(pivot + 1) % 3] = next;
  shares[(pivot + 2) % 3] = last;
  return shares;
}

std::array<double, 3> weights_at(const BlockWeights& weights, std::size_t column) {
  return {weights.e[0][column], weights.e[1][column], weights.e[2][column]};
}

}  // namespace

bool RecordingTap::is_at(const BlockPlace& place, Mask mask) const {
  const int column = address_.x - place.first;
  return trace_ && place.triangle == address_.triangle && place.y == address_.y &&
         place.sample == static_cast<std::size_t>(address_.sample) && column >= 0 &&
         column < kBlockSize && (mask >> column & 1) != 0;
}

bool RecordingTap::is_looked_at(const DrawBounds& bounds, const PixelBox& box) const {
  const auto sample = static_cast<std::size_t>(address_.sample);
  return box.columns.contains(address_.x) && box.rows.contains(address_.y) &&
         bounds.sample_columns[sample].contains(address_.x) &&
         bounds.sample_rows[sample].contains(address_.y);
}

void RecordingTap::set_corners(const PieceCorners& corners, Corners& window,
                               Corners& snapped) const {
  auto& on_grid = snapped.emplace();
  for (std::size_t i = 0; i < 3; ++i) on_grid[i] = traced(*corners[i], units_of_a_pixel_);
  if (!polygon_->is_cut) return;
  auto& in_window = window.emplace(on_grid);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto index = static_cast<std::size_t>(corners[i] - polygon_->corners.data());
    in_window[i].x = polygon_->window[index].x;
    in_window[i].y = polygon_->window[index].y;
  }
}

void RecordingTap::set_part(const DrawnPart& part) {
  part_ = &part;
  const SampleFrame& frame = *part.weights.frame;
  trace_->positions = part.source.positions;
  trace_->frame = {axis_of(frame.u), axis_of(frame.v), frame.t};
  auto& lines = trace_->lines.emplace();
  TracedCertificate& certificate = trace_->certificate.emplace();
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeFunction& edge = part.weights.edges[i];
    lines[i] = {edge.a.value, edge.b.value, edge.c.value};
    certificate.bands[i] = edge.band;
  }
  trace_->edges = part.weights.at(trace_->u, trace_->v);
  const Certificates& certificates = part.values.certificates;
  certificate.least_sum = certificates.least_sum;
  certificate.affine_is_certain = certificates.affine_is_certain;
  certificate.depth_is_certain = certificates.depth_is_certain;
}

/// Returns how the coverage of a sample within the viewport and the scissor was decided.
Decision RecordingTap::decision_of(const BlockPlace& place, const CoveredBlock& block) const {
  if (block.is_whole_numbers) return Decision::in_whole_numbers;
  if (is_at(place, block.covered)) {
    return is_at(place, block.in_doubt) ? Decision::exactly : Decision::in_double;
  }
  bool is_inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const double band = trace_->certificate->bands[i];
    const double edge = (*trace_->edges)[i];
    if (edge < -band) return Decision::in_double;
    is_inside = is_inside && edge > band;
  }
  return is_inside ? Decision::clipped : Decision::exactly;
}

void RecordingTap::covered(const BlockPlace& place, const CoveredBlock& block,
                           const BlockWeights& weights) {
  const Mask looked_at = columns_mask({place.first, place.first + place.count}, place.first);
  if (!is_at(place, looked_at)) return;
  if (trace_->decision == Decision::outside && !is_at(place, block.covered)) return;
  if (!block.is_whole_numbers) {
    trace_->edges = weights_at(weights, column(place));
  }
  trace_->decision = decision_of(place, block);
}

void RecordingTap::weighed(const WeighedBlock& block) {
  if (!is_at(block.place, block.drawn)) return;
  trace_->is_drawn = true;
  trace_->attributes.resize(block.part.values.attributes.size());
  set_part(block.part);
  const PieceCorners& corners = block.part.source.corners;
  if (corners[0] != nullptr) set_corners(corners);
  trace_->u = address_.x + block.offset.x;
  trace_->v = address_.y + block.offset.y;
  trace_->edges = weights_at(block.weights, column(block.place));
}

void RecordingTap::summed(const WeighedBlock& block, const PlaneRow& sum) {
  if (!is_at(block.place, block.drawn)) return;
  UnroundedValues sums;
  evaluate_affine(sum, block.place.count, block.weights, sums.data());
  sum_ = sums[column(block.place)];
}

TracedValue RecordingTap::value_of(const PartPoint& at) const {
  TracedValue value;
  value.u = at.u;
  value.v = at.v;
  value.is_from_vertices = at.part.source.corners[0] == nullptr;
  return value;
}

TracedValue RecordingTap::value_of(const WeighedBlock& block) const {
  return value_of({block.part, address_.x + block.offset.x, address_.y + block.offset.y});
}

void RecordingTap::depth(const WeighedBlock& block, const PlaneRow& row, const float* values) {
  if (!is_at(block.place, block.drawn)) return;
  const DepthLine& line = block.part.values.depth;
  TracedValue& traced = trace_->depth = value_of(block);
  traced.numerator = plane_of(line.plane);
  UnroundedValues unrounded;
  evaluate_affine(row, block.place.count, block.weights, unrounded.data());
  traced.numerator_at = unrounded[column(block.place)];
  evaluate_depth(row, line.least, line.greatest, block.place.count, block.weights,
                 unrounded.data());
  traced.evaluated = unrounded[column(block.place)];
  traced.value = values[column(block.place)];
}

void RecordingTap::attribute(const WeighedBlock& block, std::size_t attribute, const PlaneRow& row,
                             const FloatWeights& shares, const float* values) {
  if (!is_at(block.place, block.drawn)) return;
  const ValueLine& line = block.part.values.attributes[attribute];
  const std::size_t at = column(block.place);
  TracedValue& traced = trace_->attributes[attribute] = value_of(block);
  traced.value = values[at];
  if (line.kind == ValueLine::Kind::copied) {
    traced.evaluated = line.copy;
    return;
  }
  if (line.is_float) {
    traced.is_from_lines = true;
    traced.shares = shares_of(shares, at);
    return;
  }
  traced.numerator = plane_of(line.plane);
  UnroundedValues unrounded;
  evaluate_affine(row, block.place.count, block.weights, unrounded.data());
  traced.numerator_at = unrounded[at];
  if (line.kind == ValueLine::Kind::smooth) {
    traced.denominator = plane_of(block.part.values.sum);
    traced.denominator_at = sum_;
    evaluate_smooth(row, block.place.count, block.weights, unrounded.data());
  }
  traced.evaluated = unrounded[at];
}

void RecordingTap::exact(const BlockPlace& place, int column, std::optional<std::size_t> attribute,
                         const PartPoint& at, double evaluated, float value) {
  if (!is_at(place, Mask{1} << column)) return;
  TracedValue& traced = attribute ? trace_->attributes[*attribute] : trace_->depth;
  traced = value_of(at);
  traced.is_exact = true;
  traced.evaluated = evaluated;
  traced.value = value;
}

void RecordingTap::located(const BlockPlace& place, int column, std::size_t attribute,
                           const PartPoint& at, double evaluated, float value) {
  if (!is_at(place, Mask{1} << column)) return;
  TracedValue& traced = trace_->attributes[attribute] = value_of(at);
  traced.evaluated = evaluated;
  traced.value = value;
  const TriangleValues& values = at.part.values;
  const ValueLine& line = values.attributes[attribute];
  if (line.kind == ValueLine::Kind::copied) return;
  const std::array<double, 3> weights = at.part.weights.at(at.u, at.v);
  traced.is_exact = !is_certain(line, values, at.part.weights.det_t, weights);
  const PieceCorners& corners = at.part.source.corners;
  if (&at.part != part_ && corners[0] != nullptr) {
    set_corners(corners, traced.corners, traced.snapped);
  }
  // The trace shows the lines of its own part only.
  if (traced.is_exact || &at.part != part_) return;
  traced.is_from_lines = true;
  traced.weights = weights;
}

}  // namespace rastercheck::rasterizer
