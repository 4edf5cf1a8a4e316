#pragma once

#include <string>
#include <string_view>

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
/// What assimp's readers mend silently stays mended: OFF and 3DS indices beyond the vertices are
/// clamped, and an OBJ object with texture coordinates at some corners only has zeros at the
/// others.
Result<Case> case_from_mesh(const std::string& file, const MeshOptions& options);

/// The same of a mesh's text; `format` is its file name's ending without the dot ("obj"), empty to
/// tell by the content. `file` is the name for errors and for the case. Nothing it refers to (a
/// material, a buffer in a file of its own) is found.
Result<Case> case_from_mesh_text(std::string_view text, const std::string& format,
                                 const std::string& file, const MeshOptions& options);

/// Whether a file's name ends like a mesh that can be read.
bool is_mesh_file(const std::string& file);

}  // namespace rastercheck::cases
