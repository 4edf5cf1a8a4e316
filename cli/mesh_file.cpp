#include "cli/mesh_file.h"

#include <fmt/format.h>

#include "cases/mesh_process.h"
#include "cli/output.h"
#include "cli/own_program.h"

namespace rastercheck::cli {

Result<cases::Imported> case_from_mesh_file(const std::string& file, const std::string& format,
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

void print_notes(const std::string& file, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    print_problem(fmt::format("rastercheck: {}: {}\n", file, note));
  }
}

}  // namespace rastercheck::cli
