#pragma once

// Clips a triangle to the view volume and by clip distances, in double.

#include <array>
#include <vector>

#include "cases/case.h"

namespace rastercheck::backends {

/// A vertex in clip space with its clip distances.
struct Vertex {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
  std::array<double, cases::kMaxClipDistances> distances{};
};

/// The part of a triangle in the view volume, and how many planes have a vertex on their outer
/// side: each of them cuts the triangle, whatever the order. If a second or later plane leaves no
/// part, the polygon is the part before that plane.
struct Clipped {
  std::vector<Vertex> polygon;
  int planes = 0;
  bool is_cut_at_the_sides = false;
  bool is_empty = false;
};

Clipped clipped_to_view(const cases::Case& c, const std::array<Vertex, 3>& triangle);

}  // namespace rastercheck::backends
