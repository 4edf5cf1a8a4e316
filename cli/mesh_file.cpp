#include "cli/mesh_file.h"

#include "cases/mesh_process.h"
#include "cli/own_program.h"

namespace rastercheck::cli {

Result<cases::Case> case_from_mesh_file(const std::string& file, const std::string& format,
                                        const cases::MeshOptions& options) {
  const cases::ProcessLimits limits = cases::default_mesh_limits();
  // Behind "--" a name is a name, whatever it begins with.
  return cases::mesh_of_process({kOwnProgram, "mesh", "--format=" + format, "--", file}, file,
                                limits)
      .and_then([&](const cases::Mesh& mesh) { return cases::case_of_mesh(mesh, file, options); });
}

}  // namespace rastercheck::cli
