#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "cases/error.h"

namespace rastercheck::bench {

/// The visible surfaces of a level, in the game's units, z up.
struct QuakeLevel {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> texture_coordinates;  ///< [vertex]
  std::vector<glm::uvec3> triangles;
};

/// Reads the polygons and meshes of a level in Quake III's format (IBSP, version 46), in the file's
/// order. Leaves out curved patches. Fails if the file cannot be read, is of another kind, or
/// points beyond its own parts.
Result<QuakeLevel> read_quake_level(const std::string& file);

}  // namespace rastercheck::bench
