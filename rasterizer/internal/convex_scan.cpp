#include "rasterizer/internal/convex_scan.h"

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

/// The value at x of the line through (x_a, a) and (x_b, b). The weights are differences from the
/// nearer end as well as from the farther one, so between the ends each has a small relative error
/// and a value of one sign loses no digits, however different the ends.
double linear(double a, double b, double x, double x_a, double x_b) {
  if (a == b || x_a == x_b) return a;
  return ((x_b - x) * a + (x - x_a) * b) / (x_b - x_a);
}

void parameters_at(const ScanSpan::Edge& edge, double v, std::size_t count, ScanParameters& s) {
  const WindowVertex& a = *edge.low;
  const WindowVertex& b = *edge.high;
  for (std::size_t i = 0; i < count; ++i) s[i] = linear(a.s[i], b.s[i], v, a.v, b.v);
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
    // Inward normals are (from.v − to.v, to.u − from.u) where the polygon is positive, so the row
    // is the least iff its edge runs along u.
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
  // A row meets one edge of either side. Where rounding has left the sides not quite monotone it
  // may meet more: then what is inside of all of them.
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

void ConvexScan::set_ends(const ScanSpan& span, SpanEnds& ends) const {
  ends.left_u = span.left_u;
  ends.right_u = span.right_u;
  parameters_at(*span.left, span.v, polygon_.parameter_count, ends.left);
  parameters_at(*span.right, span.v, polygon_.parameter_count, ends.right);
}

void ConvexScan::interpolate(const SpanEnds& ends, double u, ScanParameters& s) const {
  for (std::size_t i = 0; i < polygon_.parameter_count; ++i) {
    s[i] = linear(ends.left[i], ends.right[i], u, ends.left_u, ends.right_u);
  }
}

}  // namespace rastercheck::rasterizer
