#pragma once

#include <string>

#include "cases/mesh.h"

namespace rastercheck::cli {

/// Returns the case of a mesh file named by the user; "-" is standard input in `format`. assimp
/// reads the file in a separate process, `rastercheck mesh`.
Result<cases::Case> case_from_mesh_file(const std::string& file, const std::string& format,
                                        const cases::MeshOptions& options);

}  // namespace rastercheck::cli
