#pragma once

// What the stages of a draw share: its state, and one triangle of it.

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

  /// Whether the viewport has no area; then the frame means nothing.
  bool is_empty() const { return state.viewport.size.x == 0 || state.viewport.size.y == 0; }

  const State& state;
  std::span<const SampleOffset> pattern;
  DrawBounds bounds;
  /// Bounds without the scissor: what errors are bounded over, so that no value depends on it.
  DrawBounds window;
  SampleFrame frame;
  /// Where the normal of an edge has no part along u, a sample on the edge is inside iff
  /// tie_sign · (its part along v) > 0 (RULES §2).
  int tie_sign = 1;
};

/// A triangle whose positions and clip distances are finite.
struct InputTriangle {
  std::uint32_t index = 0;  ///< in the mesh
  std::array<glm::vec4, 3> positions;
  std::array<std::span<const float>, 3> distances;
  std::array<std::span<const float>, 3> attributes;
};

/// What became of a triangle before its samples were looked at.
enum class Fate { drawn, hidden, degenerate, not_finite };

}  // namespace rastercheck::rasterizer
