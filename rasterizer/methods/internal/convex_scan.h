#pragma once

// Scan conversion of a convex polygon in window space with linear interpolation: along the edges to
// a row, then along the row's span.
//
// Conventions. u points right and v along window y, in pixels; whether v is displayed upwards or
// downwards does not matter here. An edge is a left edge if the inside is to its right (its inward
// normal has a positive u). Row v meets an edge if v_low <= v < v_high. A fill rule may include
// horizontal edges of greatest v instead of least v; then row v meets an edge if v_low < v <=
// v_high. A span includes its left end and excludes its right end, unless the edge there is closed.
// So a sample on an edge between two polygons belongs to exactly one of them.
//
// Crossings are computed from the ends in order of v, so two polygons that share an edge get
// identical bits:
//
//   u_c = u_low + (v − v_low) (u_high − u_low) / (v_high − v_low), in this order of operations.
//
// If the coordinates lie on a grid so coarse that the product is exact (as with ends within 2^14
// pixels on a grid of 2^-10), a crossing that lies on the grid is computed exactly, and ties are
// true ties. Error, u = 2^-53: each difference and the product, quotient and sum round once, so to
// first order
//
//   |δu_c| <= u (5 |u_high − u_low| + |u_c|)  <=  11 u max(|u_low|, |u_high|),
//
// because |u_c| is at most max(|u_low|, |u_high|), and |u_high − u_low| is at most twice that.
//
// Rejected: stepping along edges by additions, as was usual around 1991, because the error grows
// with the number of rows.

#include <array>
#include <cstddef>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// The interpolated parameters, as doubles or as counting numbers (counted.h).
template <class T>
using Parameters = std::array<T, kMaxAttributes + 1>;

/// A place x between the places x_a and x_b.
template <class T>
struct Place {
  T x{};
  T x_a{};
  T x_b{};
};

/// Evaluates the line through (x_a, a) and (x_b, b) at x. Each weight is the distance of x from one
/// of the ends. So between the ends both weights have small relative errors, and if a and b have
/// one sign the mean loses no digits, however much a and b differ.
template <class T>
class Weights {
 public:
  explicit Weights(const Place<T>& place)
      : of_a_(place.x_b - place.x), of_b_(place.x - place.x_a), sum_(place.x_b - place.x_a) {}

  /// Returns the value at x. If a and b are equal, returns exactly that value.
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
  Parameters<double> s{};       ///< parameters that are linear in window space
  Parameters<double> smooth{};  ///< a method's parameters for smooth attributes (polygon_drawing.h)
  bool closed = false;  ///< true if samples exactly on the edge to the next vertex are inside
};

struct WindowPolygon {
  static constexpr std::size_t kCapacity = 32;
  std::array<WindowVertex, kCapacity> vertices;
  std::size_t size = 0;
  std::size_t parameter_count = 0;
  /// True if the vertices turn in the direction from the u axis to the v axis.
  bool positive = true;
};

/// The part of a row inside the polygon: left_u <= u < right_u, or u <= right_u if closed. `left`
/// and `right` are the edges that the row meets, or nullptr.
struct ScanSpan {
  struct Edge;
  const Edge* left = nullptr;
  const Edge* right = nullptr;
  double v = 0;
  double left_u = 0;
  double right_u = 0;
};

/// An edge that is not horizontal, with its ends in order of v.
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
  std::array<Parameters<T>, 2> more{};  ///< a method's own data for a span (polygon_drawing.h)
};

class ConvexScan {
 public:
  /// The polygon must outlive the scan.
  ConvexScan(const WindowPolygon& polygon, bool least_v_included);

  double least_v() const { return least_v_; }
  double greatest_v() const { return greatest_v_; }

  ScanSpan span(double v) const;

  /// Computes the parameters at the ends of `span`, which must have met two edges.
  void set_ends(const ScanSpan& span, SpanEnds<double>& ends) const;

  /// Interpolates linearly between the ends of a span.
  void interpolate(const SpanEnds<double>& ends, double u, Parameters<double>& s) const;

 private:
  void add_edge(const WindowVertex& from, const WindowVertex& to);
  bool meets(const ScanSpan::Edge& edge, double v) const;

  using Edges = std::array<ScanSpan::Edge, WindowPolygon::kCapacity>;

  const WindowPolygon& polygon_;
  bool least_v_included_;
  double least_v_;
  double greatest_v_;
  /// The v of a closed horizontal edge that the fill rule alone would exclude; NaN if none.
  double closed_row_;
  Edges left_;
  Edges right_;
  std::size_t left_count_ = 0;
  std::size_t right_count_ = 0;
};

}  // namespace rastercheck::rasterizer
