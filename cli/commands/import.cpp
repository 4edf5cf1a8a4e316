// `rastercheck import MESH`: turns a mesh into a case file.

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/names.h"
#include "cli/command.h"
#include "cli/mesh_file.h"
#include "cli/output.h"

namespace rastercheck::cli::import_command {
namespace {

struct Options {
  std::string file;
  cases::MeshOptions mesh;
  std::string rules = "vulkan";
  std::string format;
  std::string output = "-";
  bool quiet = false;
};

ExitCode run(Options options) {
  options.mesh.rules = cases::from_name<cases::Rules>(options.rules).value_or(cases::Rules::vulkan);
  const Result<cases::Case> c = case_from_mesh_file(options.file, options.format, options.mesh);
  if (!c) return fail(c.error());
  if (options.output == "-") {
    fmt::print("{}", cases::to_json(*c));
    return ExitCode::ok;
  }
  const Result<void> written = check_output_file(options.output, options.file).and_then([&] {
    return cases::write_file(options.output, cases::to_json(*c));
  });
  return written ? ExitCode::ok : fail(written.error());
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("MESH", options->file,
                 "Mesh file: OBJ, PLY, OFF, glTF, 3DS or another format that assimp reads; - reads "
                 "standard input")
      ->type_name(kFile)
      ->required();
  app.add_option("--width", options->mesh.width, "Width of the picture, in pixels")
      ->check(CLI::Range(1, cases::kMaxSize))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--height", options->mesh.height, "Height of the picture, in pixels")
      ->check(CLI::Range(1, cases::kMaxSize))
      ->type_name("N")
      ->capture_default_str();
  const auto names = names_of(cases::Rules{});
  app.add_option("--rules", options->rules, "API whose rules the case follows")
      ->type_name("API")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->capture_default_str();
  app.add_option("--format", options->format,
                 "Format of standard input, as a file's ending, such as obj")
      ->type_name("ENDING");
  app.add_option("--output", options->output, "Case file to write; - prints it")
      ->type_name(kFile)
      ->capture_default_str();
  app.add_flag("-q,--quiet", options->quiet, "Accepted for consistency; has no effect");
  app.footer(
      "Prints a case that draws the mesh with a camera that frames it.\n\n"
      "Example:\n"
      "  rastercheck import bunny.obj --width 256 --height 256 --output bunny.json");
  return [options] { return run(*options); };
}

const Registration kRegistration("import", "Convert a mesh to a case file", &set_up);

}  // namespace
}  // namespace rastercheck::cli::import_command
