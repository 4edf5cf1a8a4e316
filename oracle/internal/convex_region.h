#pragma once

// A convex polygon in window space, for values that the rules leave open within a region: centroid
// sampling (any point of pixel ∩ triangle) and vertices moved by snapping after clipping.

#include <optional>
#include <vector>

#include "oracle/internal/number.h"
#include "oracle/internal/projective_map.h"

namespace rastercheck::oracle {

/// A closed convex polygon, perhaps flat or a single point, perhaps empty.
class ConvexRegion {
 public:
  /// The closed rectangle [lo.u, hi.u] × [lo.v, hi.v].
  ConvexRegion(const FieldPoint& lo, const FieldPoint& hi);

  /// Keeps what lies in the closed half-plane line >= 0 (Sutherland & Hodgman 1974; exact here, so
  /// that shared vertices need no care).
  void clip(const Line& line) { clip_above(line, Field(0)); }
  /// Keeps what lies in the closed half-plane line >= least.
  void clip_above(const Line& line, const Field& least);

  bool is_empty() const { return vertices_.empty(); }
  const std::vector<FieldPoint>& vertices() const { return vertices_; }

 private:
  std::vector<FieldPoint> vertices_;
};

}  // namespace rastercheck::oracle
