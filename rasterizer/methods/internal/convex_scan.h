#pragma once

// Scan conversion of a convex polygon in window space with linear interpolation: along the edges to
// a row, then along the row's span.
//
// Conventions. u to the right and v along window y, in pixels; which way v is displayed is not
// known here. An edge is left where the inside is to its right (its inward normal has a positive
// u). A row v meets an edge iff low v <= v < high v, or low v < v <= high v where the fill rule
// gives the row to the edges of greatest v. A span includes its left end and excludes its right
// end, unless the edge there is closed. So of two polygons on either side of an edge exactly one
// owns a sample on it.
//
// Crossings are computed from the ends in order of v, so both polygons of an edge get the same
// bits:
//
//   u_c = u_low + (v − v_low) (u_high − u_low) / (v_high − v_low), in this order of operations:
//
// where the coordinates lie on a grid so coarse that the product is exact (ends within 2^14 pixels
// on a grid of 2^-10 are), a crossing that lies on the grid comes out exactly, and ties are true
// ties. Error, u = 2^-53: each difference and the product, quotient and sum round once, so that,
// first order,
//
//   |δu_c| <= u (5 |u_high − u_low| + |u_c|)  <=  11 u max(|u_low|, |u_high|),
//
// as u_c and the difference are within the ends' size and twice that.
//
// A rejected alternative: edges stepped by additions, the fashion of the time. Its error grows with
// the number of rows.

#include <array>
#include <cstddef>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// What is interpolated, of doubles or of numbers that count (counted.h).
template <class T>
using Parameters = std::array<T, kMaxAttributes + 1>;

/// A place x between two others.
template <class T>
struct Place {
  T x{};
  T x_a{};
  T x_b{};
};

/// The line through (x_a, a) and (x_b, b), at x. The weights are differences from the nearer end as
/// well as from the farther one, so between the ends each has a small relative error and a value of
/// one sign loses no digits, however different the ends.
template <class T>
class Weights {
 public:
  explicit Weights(const Place<T>& place)
      : of_a_(place.x_b - place.x), of_b_(place.x - place.x_a), sum_(place.x_b - place.x_a) {}

  /// Equal ends give exactly their value.
  T mean(T a, T b) const {
    if (a == b || sum_ == T(0)) return a;
    return (of_a_ * a + of_b_ * b) / sum_;
  }

 private:
  T of_a_;
  T of_b_;
  T sum_;
};

struct WindowVertex {
  double u = 0;
  double v = 0;
  Parameters<double> s{};       ///< what is linear in window space
  Parameters<double> smooth{};  ///< what a method makes of smooth attributes (polygon_drawing.h)
  bool closed = false;  ///< of the edge to the next vertex: samples exactly on it are inside
};

struct WindowPolygon {
  static constexpr std::size_t kCapacity = 32;
  std::array<WindowVertex, kCapacity> vertices;
  std::size_t size = 0;
  std::size_t parameter_count = 0;
  /// Whether the vertices turn from the u axis to the v axis.
  bool positive = true;
};

/// Where a row is inside: left_u <= u < right_u, or u <= right_u where closed. `left` and `right`
/// are the edges met; null where none is.
struct ScanSpan {
  struct Edge;
  const Edge* left = nullptr;
  const Edge* right = nullptr;
  double v = 0;
  double left_u = 0;
  double right_u = 0;
};

/// An edge that is not horizontal, its ends in order of v.
struct ScanSpan::Edge {
  const WindowVertex* low = nullptr;
  const WindowVertex* high = nullptr;
  bool closed = false;
};

/// The parameters at both ends of a span.
template <class T>
struct SpanEnds {
  T left_u{};
  T right_u{};
  Parameters<T> left{};
  Parameters<T> right{};
  std::array<Parameters<T>, 2> more{};  ///< for what a method makes of a span (polygon_drawing.h)
};

class ConvexScan {
 public:
  /// The polygon must outlive the scan.
  ConvexScan(const WindowPolygon& polygon, bool least_v_included);

  double least_v() const { return least_v_; }
  double greatest_v() const { return greatest_v_; }

  ScanSpan span(double v) const;

  /// `span` met two edges.
  void set_ends(const ScanSpan& span, SpanEnds<double>& ends) const;

  /// Linear between the ends of a span.
  void interpolate(const SpanEnds<double>& ends, double u, Parameters<double>& s) const;

 private:
  void add_edge(const WindowVertex& from, const WindowVertex& to);
  bool meets(const ScanSpan::Edge& edge, double v) const;

  using Edges = std::array<ScanSpan::Edge, WindowPolygon::kCapacity>;

  const WindowPolygon& polygon_;
  bool least_v_included_;
  double least_v_;
  double greatest_v_;
  /// The row of a closed horizontal edge that the fill rule alone would leave out.
  double closed_row_;
  Edges left_;
  Edges right_;
  std::size_t left_count_ = 0;
  std::size_t right_count_ = 0;
};

}  // namespace rastercheck::rasterizer
