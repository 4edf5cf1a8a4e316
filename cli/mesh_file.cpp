#include "cli/mesh_file.h"

#include <vector>

#include "cases/mesh_process.h"
#include "cli/own_program.h"

namespace rastercheck::cli {

Result<cases::Case> case_from_mesh_file(const std::string& file, const std::string& format,
                                        const cases::MeshOptions& options) {
  const cases::ProcessLimits limits = cases::default_reader_limits();
  std::vector<std::string> command{kOwnProgram, "mesh"};
  if (!format.empty()) command.push_back("--format=" + format);
  // After "--" a file name may begin with any character, even with "-".
  command.insert(command.end(), {"--", file});
  return cases::mesh_of_process(command, file, limits).and_then([&](const cases::Mesh& mesh) {
    return cases::case_of_mesh(mesh, file, options);
  });
}

}  // namespace rastercheck::cli
