#include "rasterizer/internal/discard.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {

bool is_finite(const State& state, const Mesh& mesh, std::uint32_t vertex) {
  const glm::vec4& p = mesh.positions[vertex];
  const auto distances =
      mesh.clip_distances.subspan(vertex * state.clip_distance_count, state.clip_distance_count);
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w) &&
         std::all_of(distances.begin(), distances.end(), [](float d) { return std::isfinite(d); });
}

bool is_culled(const State& state, int orientation) {
  if (state.cull == Cull::none) return false;
  // Turning from u to v is counter-clockwise where v points up.
  const bool is_ccw = (orientation > 0) == (state.convention == Convention::opengl);
  const bool is_front = is_ccw == (state.front_face == FrontFace::ccw);
  return is_front == (state.cull == Cull::front);
}

}  // namespace rastercheck::rasterizer
