#include "backends/cpu/stage_trace.h"

#include <cstddef>
#include <string_view>

#include "backends/cpu/case_state.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

std::string_view decision_word(ras::Decision decision) {
  switch (decision) {
    case ras::Decision::outside:
      return "outside";
    case ras::Decision::in_double:
      return "in_double";
    case ras::Decision::exactly:
      return "exactly";
    case ras::Decision::in_whole_numbers:
      return "in_whole_numbers";
    case ras::Decision::clipped:
      return "clipped";
    case ras::Decision::by_span:
      break;
  }
  return "by_span";
}

using Corners = std::array<records::TracedCorner, 3>;

std::optional<Corners> corners_of(const std::optional<std::array<ras::TracedCorner, 3>>& traced) {
  if (!traced) return std::nullopt;
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const ras::TracedCorner& corner = (*traced)[i];
    corners[i] = {corner.x, corner.y, corner.z, corner.w, corner.is_homogeneous, corner.share};
  }
  return corners;
}

std::optional<records::TracedPlane> plane_of(const std::optional<ras::TracedPlane>& plane) {
  if (!plane) return std::nullopt;
  return records::TracedPlane{plane->a, plane->b, plane->c};
}

records::TracedValue value_of(const ras::TracedValue& traced) {
  records::TracedValue value;
  value.u = traced.u;
  value.v = traced.v;
  value.is_from_vertices = traced.is_from_vertices;
  value.corners = corners_of(traced.corners);
  value.snapped = corners_of(traced.snapped);
  value.numerator = plane_of(traced.numerator);
  value.denominator = plane_of(traced.denominator);
  value.is_from_lines = traced.is_from_lines;
  value.numerator_at = traced.numerator_at;
  value.denominator_at = traced.denominator_at;
  value.weights = traced.weights;
  value.shares = traced.shares;
  value.is_exact = traced.is_exact;
  value.evaluated = traced.evaluated;
  value.value = traced.value;
  return value;
}

records::SampleTrace sample_trace(const ras::Trace& trace) {
  records::SampleTrace result;
  result.is_drawn = trace.is_drawn;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& p = trace.positions[i];
    result.positions[i] = {p.x, p.y, p.z, p.w};
  }
  result.corners = corners_of(trace.corners);
  result.snapped = corners_of(trace.snapped);
  if (trace.frame) {
    const auto& [along_u, along_v, t] = *trace.frame;
    result.frame = {{along_u.scale, along_u.shift}, {along_v.scale, along_v.shift}, t};
  }
  if (trace.lines) {
    auto& lines = result.lines.emplace();
    for (std::size_t i = 0; i < 3; ++i) {
      const ras::TracedPlane& line = (*trace.lines)[i];
      lines[i] = {line.a, line.b, line.c};
    }
  }
  result.u = trace.u;
  result.v = trace.v;
  result.edges = trace.edges;
  result.decision = decision_word(trace.decision);
  result.depth = value_of(trace.depth);
  for (const ras::TracedValue& value : trace.attributes) {
    result.attributes.push_back(value_of(value));
  }
  return result;
}

}  // namespace

ras::SamplePlace sample_place(const cases::SamplePlace& at) {
  return {at.triangle, static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.sample)};
}

Result<std::optional<records::SampleTrace>> traced_sample(const ras::TraceResult& traced) {
  if (traced.error) return tl::unexpected(refused(*traced.error));
  if (!traced.trace) return std::nullopt;
  return sample_trace(*traced.trace);
}

}  // namespace rastercheck::backends
