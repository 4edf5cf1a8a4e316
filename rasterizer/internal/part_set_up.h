#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Sets up a triangle: its lines and coverage, then the values of the parts that it is drawn in.

#include <cstddef>
#include <optional>
#include <vector>

#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Sets up the triangle and its parts and, with `has_derivatives`, the parts' derivatives as well.
template <typename Coverage>
Fate set_up_parts(const State& state, const Mesh& mesh, std::size_t index, bool has_derivatives,
                  Coverage& coverage, std::vector<DrawnPart>& parts) {
  const std::optional<InputTriangle> triangle = input_triangle(state, mesh, index);
  if (!triangle) return Fate::not_finite;
  const Fate fate = coverage.set_up(*triangle, parts);
  if (fate != Fate::drawn) return fate;
  for (DrawnPart& part : parts) {
    if (part.is_flat) {
      set_up_flat_values(state, part.source, part.values);
      part.derivatives = {};
      part.derivatives.attributes.resize(state.attributes.size());
      continue;
    }
    set_up_values(state, part.source, part.weights, part.values);
    if (!has_derivatives) continue;
    set_up_derivatives(state, part.source, part.weights, part.values, part.derivatives);
  }
  return fate;
}

}  // namespace rastercheck::rasterizer
