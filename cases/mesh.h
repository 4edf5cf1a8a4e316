#pragma once

#include <array>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::cases {

struct MeshOptions {
  int width = 512;   ///< framebuffer and viewport, in pixels, 1…kMaxSize
  int height = 512;  ///< likewise
  Rules rules = Rules::vulkan;
};

/// A mesh as read from its file: polygons cut into triangles, node transforms applied, triangles in
/// order, vertices with identical bits joined. All numbers are finite.
struct Mesh {
  /// True if every vertex has texture coordinates.
  bool is_textured = false;
  std::vector<std::array<float, 3>> positions;  ///< x, y, z in object space
  std::vector<std::array<float, 2>> texture;    ///< u, v of each vertex; empty if not textured
  std::vector<Triangle> triangles;              ///< indices below the number of vertices
  bool operator==(const Mesh&) const = default;
};

/// Makes a case that draws a mesh, with a camera that frames it and two smooth attributes: the
/// texture coordinates "u" and "v" if the mesh has any, else object-space "x" and "y". `file` names
/// the case, and the source in errors. Fails if the mesh has no triangle, or no camera fits
/// float32.
Result<Case> case_of_mesh(const Mesh& mesh, const std::string& file, const MeshOptions& options);

}  // namespace rastercheck::cases
