#pragma once

#include <string>

#include "cases/mesh.h"

namespace rastercheck::cli {

/// The case of a mesh file that a user names, "-" for standard input of the format: assimp reads it
/// in a process of its own, `rastercheck mesh`.
Result<cases::Case> case_from_mesh_file(const std::string& file, const std::string& format,
                                        const cases::MeshOptions& options);

}  // namespace rastercheck::cli
