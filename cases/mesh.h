#pragma once

#include <array>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::cases {

struct MeshOptions {
  int width = 512;   ///< framebuffer and viewport, in pixels, 1…kMaxSize
  int height = 512;  ///< the same
  Rules rules = Rules::vulkan;
};

/// A mesh as it stands in its file: polygons cut into triangles, node transforms applied, triangles
/// in order, vertices joined where all their bits agree. All numbers are finite.
struct Mesh {
  /// Whether every vertex has texture coordinates.
  bool is_textured = false;
  std::vector<std::array<float, 3>> positions;  ///< x, y, z in object space
  std::vector<std::array<float, 2>> texture;    ///< u, v of each vertex; empty where not textured
  std::vector<Triangle> triangles;              ///< indices below the number of vertices
  bool operator==(const Mesh&) const = default;
};

/// A case that draws a mesh, with a camera that frames it. Two smooth attributes: texture
/// coordinates "u" and "v" where there are any, else object-space "x" and "y". `file` is the name
/// for errors and for the case. Fails where there is no triangle, or no camera in float32.
Result<Case> case_of_mesh(const Mesh& mesh, const std::string& file, const MeshOptions& options);

}  // namespace rastercheck::cases
