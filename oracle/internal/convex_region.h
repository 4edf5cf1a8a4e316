#pragma once

// A convex polygon in window space, for values that the rules leave open within a region: centroid
// sampling (any point of pixel ∩ triangle) and vertices moved by snapping after clipping.
//
// Sides are lines, and corners are the meeting points of two lines, in homogeneous coordinates. So
// nothing is divided, and a corner has degree two in the lines' coefficients however many cuts led
// to it. Most questions ask on which side of a line a corner lies; doubles answer nearly all of
// them.

#include <cstddef>
#include <vector>

#include "oracle/internal/line.h"
#include "oracle/internal/number.h"

namespace rastercheck::oracle {

/// A closed convex polygon; may be flat, a single point, or empty.
class ConvexRegion {
 public:
  /// The closed rectangle [lo.u, hi.u] × [lo.v, hi.v].
  ConvexRegion(const Point& lo, const Point& hi);

  /// Keeps the part in the closed half-plane line >= 0 (Sutherland & Hodgman 1974; exact here, so
  /// shared vertices need no special care).
  void clip(const Line& line);
  /// Keeps the part in the closed half-plane line >= least.
  void clip_above(const Line& line, const Ring& least) { clip({line.a, line.b, line.c - least}); }

  /// True if the line is positive somewhere in the region.
  bool rises_above(const Line& line) const;
  /// True if the line is zero somewhere in the region.
  bool meets(const Line& line) const;

  bool is_empty() const { return corners_.empty(); }
  std::size_t size() const { return corners_.size(); }
  const HomogeneousPoint& vertex(std::size_t i) const { return corners_[i].point; }

 private:
  struct Corner {
    HomogeneousPoint point;
    std::size_t side = 0;  ///< index into `sides_`: the side from here to the next corner
    NearPoint near;
  };

  static Corner make_corner(HomogeneousPoint point, std::size_t side);
  /// The sign of the line at the corner.
  static int side_of(const Line& line, const Corner& corner);

  std::vector<Line> sides_;
  std::vector<Corner> corners_;
};

}  // namespace rastercheck::oracle
