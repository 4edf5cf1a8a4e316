#pragma once

#include <string>
#include <vector>

#include "cases/importer.h"
#include "cases/mesh.h"

namespace rastercheck::cli {

/// Returns the case of a mesh file named by the user, and notes for the user; "-" is standard input
/// in `format`. assimp reads the file in a separate process, `rastercheck mesh`.
Result<cases::Imported> case_from_mesh_file(const std::string& file, const std::string& format,
                                            const cases::MeshOptions& options);

/// Prints notes on a file to standard error, one a line.
void print_notes(const std::string& file, const std::vector<std::string>& notes);

}  // namespace rastercheck::cli
