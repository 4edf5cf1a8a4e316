#include "rasterizer/methods/internal/convex_scan.h"

#include <algorithm>
#include <limits>

namespace rastercheck::rasterizer {
namespace {

/// u where the edge crosses the row v (convex_scan.h).
double crossing(const ScanSpan::Edge& edge, double v) {
  const WindowVertex& a = *edge.low;
  const WindowVertex& b = *edge.high;
  return a.u + (v - a.v) * (b.u - a.u) / (b.v - a.v);
}

void parameters_at(const ScanSpan::Edge& edge, double v, std::size_t count, Parameters<double>& s) {
  const WindowVertex& a = *edge.low;
  const WindowVertex& b = *edge.high;
  const Weights<double> weights({v, a.v, b.v});
  for (std::size_t i = 0; i < count; ++i) s[i] = weights.mean(a.s[i], b.s[i]);
}

}  // namespace

ConvexScan::ConvexScan(const WindowPolygon& polygon, bool least_v_included)
    : polygon_(polygon),
      least_v_included_(least_v_included),
      least_v_(polygon.vertices[0].v),
      greatest_v_(polygon.vertices[0].v),
      closed_row_(std::numeric_limits<double>::quiet_NaN()) {
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const std::size_t next = i + 1 == polygon.size ? 0 : i + 1;
    add_edge(polygon.vertices[i], polygon.vertices[next]);
  }
}

void ConvexScan::add_edge(const WindowVertex& from, const WindowVertex& to) {
  least_v_ = std::min(least_v_, from.v);
  greatest_v_ = std::max(greatest_v_, from.v);
  if (from.v == to.v) {
    // If the polygon is positive, inward normals are (from.v − to.v, to.u − from.u), so the edge of
    // least v is the one that runs towards greater u.
    const bool is_least = (to.u > from.u) == polygon_.positive;
    if (from.closed && is_least != least_v_included_) closed_row_ = from.v;
    return;
  }
  const bool falls = to.v < from.v;
  const ScanSpan::Edge edge{falls ? &to : &from, falls ? &from : &to, from.closed};
  if (falls == polygon_.positive) {
    left_[left_count_++] = edge;
  } else {
    right_[right_count_++] = edge;
  }
}

bool ConvexScan::meets(const ScanSpan::Edge& edge, double v) const {
  const bool low_included = least_v_included_ != (v == closed_row_);
  return low_included ? edge.low->v <= v && v < edge.high->v : edge.low->v < v && v <= edge.high->v;
}

ScanSpan ConvexScan::span(double v) const {
  ScanSpan span;
  span.v = v;
  // A row meets one left and one right edge. If rounding has left a side not quite monotone, the
  // row may meet more edges; the span is then inside all of them.
  for (std::size_t i = 0; i < left_count_; ++i) {
    if (!meets(left_[i], v)) continue;
    const double u = crossing(left_[i], v);
    if (span.left != nullptr && u <= span.left_u) continue;
    span.left = &left_[i];
    span.left_u = u;
  }
  for (std::size_t i = 0; i < right_count_; ++i) {
    if (!meets(right_[i], v)) continue;
    const double u = crossing(right_[i], v);
    if (span.right != nullptr && u >= span.right_u) continue;
    span.right = &right_[i];
    span.right_u = u;
  }
  return span;
}

void ConvexScan::set_ends(const ScanSpan& span, SpanEnds<double>& ends) const {
  ends.left_u = span.left_u;
  ends.right_u = span.right_u;
  parameters_at(*span.left, span.v, polygon_.parameter_count, ends.left);
  parameters_at(*span.right, span.v, polygon_.parameter_count, ends.right);
}

void ConvexScan::interpolate(const SpanEnds<double>& ends, double u, Parameters<double>& s) const {
  const Weights<double> weights({u, ends.left_u, ends.right_u});
  for (std::size_t i = 0; i < polygon_.parameter_count; ++i) {
    s[i] = weights.mean(ends.left[i], ends.right[i]);
  }
}

}  // namespace rastercheck::rasterizer
