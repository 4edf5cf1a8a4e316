#pragma once

// Reads mesh files with assimp. On a broken file assimp may crash, hang or use up memory, so
// programs should read untrusted files in a separate process (mesh_process.h).

#include <string>

#include "cases/error.h"
#include "cases/mesh.h"

namespace rastercheck::cases {

/// Reads a mesh file (OBJ, PLY, OFF, glTF, 3DS and whatever else assimp reads), or standard input
/// for "-". For standard input, `format` is the file name ending without the dot ("obj"), or empty
/// to detect it by content; external references (a material, a separate buffer) are not found.
/// The mesh has the cameras of a glTF 2.0 file; those of other formats are left out.
/// Fails if the file cannot be read, if a coordinate is not finite, if an index is beyond the
/// vertices, or if the mesh has more than 2^32 - 1 vertices. Faults that assimp's readers repair
/// silently go unnoticed: OFF and 3DS indices beyond the vertices are clamped, and an OBJ object
/// with texture coordinates only at some corners has zeros at the others.
Result<Mesh> read_mesh(const std::string& file, const std::string& format = "");

/// True if a file's name has the ending of a readable mesh format.
bool is_mesh_file(const std::string& file);

}  // namespace rastercheck::cases
