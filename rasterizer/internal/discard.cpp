#include "rasterizer/internal/discard.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

/// True if a vertex's position and clip distances are finite.
bool is_finite(const State& state, const Mesh& mesh, std::uint32_t vertex) {
  const glm::vec4& p = mesh.positions[vertex];
  const auto distances =
      mesh.clip_distances.subspan(vertex * state.clip_distance_count, state.clip_distance_count);
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w) &&
         std::all_of(distances.begin(), distances.end(), [](float d) { return std::isfinite(d); });
}

}  // namespace

std::optional<InputTriangle> input_triangle(const State& state, const Mesh& mesh,
                                            std::size_t index) {
  const glm::uvec3& corners = mesh.triangles[index];
  if (!is_finite(state, mesh, corners.x) || !is_finite(state, mesh, corners.y) ||
      !is_finite(state, mesh, corners.z)) {
    return std::nullopt;
  }
  const auto parts_of = [&corners](std::span<const float> all, std::size_t count) {
    return std::array{all.subspan(corners.x * count, count), all.subspan(corners.y * count, count),
                      all.subspan(corners.z * count, count)};
  };
  InputTriangle triangle;
  triangle.index = static_cast<std::uint32_t>(index);
  triangle.positions = {mesh.positions[corners.x], mesh.positions[corners.y],
                        mesh.positions[corners.z]};
  triangle.distances = parts_of(mesh.clip_distances, state.clip_distance_count);
  triangle.attributes = parts_of(mesh.attributes, state.attributes.size());
  return triangle;
}

void count(Fate fate, DrawCounts& counts) {
  counts.discarded_not_finite += fate == Fate::not_finite ? 1U : 0U;
  counts.discarded_degenerate += fate == Fate::degenerate ? 1U : 0U;
}

bool is_front_face(const State& state, int orientation) {
  // Turning from u to v is counter-clockwise where v points up.
  const bool is_ccw = (orientation > 0) == (state.convention == Convention::opengl);
  return is_ccw == (state.front_face == FrontFace::ccw);
}

bool is_culled(const State& state, int orientation) {
  if (state.cull == Cull::none) return false;
  return is_front_face(state, orientation) == (state.cull == Cull::front);
}

}  // namespace rastercheck::rasterizer
