#include "rasterizer/internal/tap.h"

namespace rastercheck::rasterizer {

bool RecordingTap::is_at(const BlockPlace& place, Mask mask) const {
  const int column = address_.x - place.first;
  return place.triangle == address_.triangle && place.y == address_.y &&
         place.sample == static_cast<std::size_t>(address_.sample) && column >= 0 &&
         column < kBlockSize && (mask >> column & 1) != 0;
}

void RecordingTap::set_up(std::uint32_t triangle, const DrawnPart& part, std::size_t index) {
  if (triangle != address_.triangle) return;
  TracedEdges edges;
  edges.positions = part.source.positions;
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeFunction& edge = part.weights.edges[i];
    edges.coefficients[i] = {edge.a.value, edge.b.value, edge.c.value};
    edges.bands[i] = edge.band;
  }
  edges.is_snapped = part.source.corners[0] != nullptr;
  edges.least_sum = part.values.certificates.least_sum;
  edges.affine_is_certain = part.values.certificates.affine_is_certain;
  edges.depth_is_certain = part.values.certificates.depth_is_certain;
  parts_.resize(index + 1);
  parts_[index] = {edges, part.weights.frame};
  trace_.attributes.resize(part.values.attributes.size());
}

void RecordingTap::covered(const BlockPlace& place, const CoveredBlock& block) {
  if (!is_at(place, block.covered)) return;
  is_covered_ = true;
  trace_.decision = block.is_whole_numbers         ? Decision::in_whole_numbers
                    : is_at(place, block.in_doubt) ? Decision::exactly
                                                   : Decision::in_double;
}

void RecordingTap::weighed(const BlockPlace& place, const SampleOffset& offset, std::size_t part,
                           Mask mask, const BlockWeights& weights) {
  if (!is_at(place, mask)) return;
  const SampleFrame& frame = *parts_[part].frame;
  trace_.edges = parts_[part].edges;
  trace_.place = {frame.u.at(address_.x + offset.x), frame.v.at(address_.y + offset.y), frame.t};
  for (std::size_t i = 0; i < 3; ++i) trace_.weights[i] = weights.e[i][column(place)];
}

void RecordingTap::depth(const BlockPlace& place, Mask mask, bool is_exact, const float* values) {
  if (!is_at(place, mask)) return;
  trace_.depth.value = values[column(place)];
  trace_.depth.is_exact = is_exact;
}

void RecordingTap::attribute(const BlockPlace& place, std::size_t attribute, Mask mask, Mask exact,
                             const float* values) {
  if (!is_at(place, mask)) return;
  trace_.attributes[attribute].value = values[column(place)];
  trace_.attributes[attribute].is_exact = is_at(place, exact);
}

void RecordingTap::located(const BlockPlace& place, int column, std::size_t attribute, double u,
                           double v, float value) {
  if (!is_at(place, Mask{1} << column)) return;
  TracedValue& traced = trace_.attributes[attribute];
  traced.value = value;
  traced.is_at_sample = false;
  traced.u = u;
  traced.v = v;
}

std::optional<Trace> RecordingTap::trace() const {
  if (!is_covered_) return std::nullopt;
  return trace_;
}

}  // namespace rastercheck::rasterizer
