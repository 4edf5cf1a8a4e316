#pragma once

#include <string>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::cases {

struct MeshOptions {
  int width = 512;   ///< framebuffer and viewport, in pixels, 1…kMaxSize
  int height = 512;  ///< the same
  Rules rules = Rules::vulkan;
};

/// A case that draws a mesh file (OBJ, PLY, OFF, glTF, 3DS and whatever else assimp reads) as it
/// stands in its file: polygons cut into triangles, node transforms applied, triangles in order,
/// vertices joined where all their bits agree, a camera that frames it. Two smooth attributes:
/// texture coordinates "u" and "v" where every vertex has them, else object-space "x" and "y".
/// Fails where the file cannot be read, holds no triangle, a coordinate that is not finite, or more
/// than 2^32 − 1 vertices.
Result<Case> case_from_mesh(const std::string& file, const MeshOptions& options);

/// Whether a file's name ends like a mesh that can be read.
bool is_mesh_file(const std::string& file);

}  // namespace rastercheck::cases
