#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Data shared by the stages of a draw: the draw's setting, and one triangle.

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/sample_frame.h"
#include "rasterizer/internal/standard_pattern.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

struct DrawSetting {
  DrawSetting(const State& draw_state, const TargetSize& size)
      : state(draw_state),
        pattern(standard_pattern(size.samples)),
        bounds(draw_bounds(draw_state, size)),
        window(draw_bounds_of_window(draw_state, size)),
        frame(sample_frame(draw_state, window, size.samples)) {
    const bool v_points_down = state.convention != Convention::opengl;
    tie_sign = (state.fill_rule == FillRule::top_left) == v_points_down ? 1 : -1;
  }

  /// True if the viewport has no area; the frame is then meaningless.
  bool is_empty() const { return state.viewport.size.x == 0 || state.viewport.size.y == 0; }

  const State& state;
  std::span<const SampleOffset> pattern;
  DrawBounds bounds;
  /// Bounds without the scissor. Error bounds are computed over this window, so that no value
  /// depends on the scissor.
  DrawBounds window;
  SampleFrame frame;
  /// For an edge whose normal has no u component: a sample on the edge is inside iff
  /// tie_sign · (the normal's v component) > 0 (RULES §2).
  int tie_sign = 1;
};

/// A triangle whose positions and clip distances are finite.
struct InputTriangle {
  std::uint32_t index = 0;  ///< in the mesh
  std::array<glm::vec4, 3> positions;
  std::array<std::span<const float>, 3> distances;
  std::array<std::span<const float>, 3> attributes;
};

/// A triangle's fate before its samples are examined.
enum class Fate { drawn, hidden, degenerate, not_finite };

}  // namespace rastercheck::rasterizer
