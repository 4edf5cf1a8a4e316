#pragma once

// Mesh files, read by assimp. On a broken file its readers may crash, hang or take all memory, so
// that programs that are given files read them in a process of their own (mesh_process.h).

#include <string>

#include "cases/error.h"
#include "cases/mesh.h"

namespace rastercheck::cases {

/// Reads a mesh file (OBJ, PLY, OFF, glTF, 3DS and whatever else assimp reads), or standard input
/// for "-". Of that, `format` is the ending that a file would have, without the dot ("obj"), empty
/// to tell by the content; nothing it refers to (a material, a buffer in a file of its own) is
/// found then. Fails where the file cannot be read, a coordinate is not finite, an index beyond the
/// vertices, or where there are more than 2^32 - 1 vertices. What assimp's readers mend silently
/// stays mended: OFF and 3DS indices beyond the vertices are clamped, and an OBJ object with
/// texture coordinates at some corners only has zeros at the others.
Result<Mesh> read_mesh(const std::string& file, const std::string& format = "");

/// Whether a file's name ends like a mesh that can be read.
bool is_mesh_file(const std::string& file);

}  // namespace rastercheck::cases
