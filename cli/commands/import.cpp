// `rastercheck import FILE`: turns a mesh, or a file of another program, into a case file.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/import_process.h"
#include "cases/json.h"
#include "cases/mesh_reader.h"
#include "cases/names.h"
#include "cli/command.h"
#include "cli/mesh_file.h"
#include "cli/number_list.h"
#include "cli/output.h"
#include "cli/own_program.h"

namespace rastercheck::cli::import_command {
namespace {

struct Options {
  std::string file;
  cases::ImportOptions known;
  cases::View view;                   ///< of a mesh
  std::optional<std::string> camera;  ///< likewise
  std::string format;
  std::string output = "-";
  bool quiet = false;
};

/// Returns a case with a camera that looks at a mesh.
Result<cases::Imported> import_mesh(const Options& options) {
  const cases::ImportOptions& known = options.known;
  if (known.viewport || known.topology || known.cull || known.front_face || !known.flat.empty() ||
      !known.noperspective.empty() || known.round) {
    return tl::unexpected(Error{options.file, "",
                                "is a mesh, whose case takes no options but --width, --height, "
                                "--samples, --rules, --format, --eye, --target, --up, --fov and "
                                "--camera"});
  }
  cases::MeshOptions mesh;
  mesh.width = known.width.value_or(mesh.width);
  mesh.height = known.height.value_or(mesh.height);
  mesh.samples = known.samples.value_or(mesh.samples);
  mesh.rules = known.rules.value_or(mesh.rules);
  mesh.view = options.view;
  mesh.camera = options.camera;
  return case_from_mesh_file(options.file, options.format, mesh);
}

Result<cases::Imported> import_other(const Options& options) {
  if (options.camera || !(options.view == cases::View())) {
    return tl::unexpected(Error{options.file, "",
                                "is no mesh, so it takes no --eye, --target, --up, --fov and "
                                "--camera"});
  }
  const cases::ProcessLimits limits = cases::default_reader_limits();
  std::vector<std::string> command{kOwnProgram, "import-reader",
                                   "--options=" + cases::to_json(options.known)};
  if (!options.format.empty()) command.push_back("--format=" + options.format);
  // After "--" a file name may begin with any character, even with "-".
  command.insert(command.end(), {"--", options.file});
  return cases::import_of_process(command, options.file, limits);
}

/// True if an importer reads the file, else assimp. Standard input can be read once only, so its
/// format must be named.
Result<bool> is_for_importer(const Options& options) {
  if (cases::find_importer(options.format) != nullptr) return true;
  if (options.file == "-" || !options.format.empty() || cases::is_mesh_file(options.file)) {
    return false;
  }
  return cases::read_text(options.file).map([](const std::string& text) {
    return cases::importer_of(text) != nullptr;
  });
}

ExitCode run(const Options& options) {
  const auto is_other = is_for_importer(options);
  if (!is_other) return fail(is_other.error());
  const auto imported = *is_other ? import_other(options) : import_mesh(options);
  if (!imported) return fail(imported.error());
  if (options.output == "-") {
    fmt::print("{}", cases::to_json(imported->drawn));
  } else {
    const Result<void> written = check_output_file(options.output, options.file).and_then([&] {
      return cases::write_file(options.output, cases::to_json(imported->drawn));
    });
    if (!written) return fail(written.error());
  }
  if (options.quiet) return ExitCode::ok;
  print_notes(options.file, imported->notes);
  return ExitCode::ok;
}

template <typename Enum>
void add_choice(CLI::App& app, const std::string& name, std::optional<Enum>& value,
                const std::string& help, const std::string& type) {
  constexpr auto kNames = names_of(Enum{});
  app.add_option_function<std::string>(
         name, [&value](const std::string& word) { value = cases::from_name<Enum>(word); }, help)
      ->type_name(type)
      ->check(CLI::IsMember(std::vector<std::string>(kNames.begin(), kNames.end())));
}

/// Requires numbers that a case's viewport may have.
std::string fault_of_viewport(const std::string& text) {
  for (const double number : numbers_in(text).value_or(std::vector<double>())) {
    if (std::abs(number) > cases::kMaxSize) {
      return fmt::format("{} is not within ±{}", number, cases::kMaxSize);
    }
  }
  return "";
}

std::string fault_of_angle(const std::string& text) {
  const auto numbers = numbers_in(text);
  const bool is_angle = numbers && numbers->size() == 1 && (*numbers)[0] > 0 && (*numbers)[0] < 180;
  return is_angle ? "" : fmt::format("'{}' is not between 0 and 180", cases::printable(text));
}

/// The options on how a mesh is looked at.
void add_view(CLI::App& app, Options& options) {
  cases::View& view = options.view;
  const auto own = {
      add_number_list(app, "--eye", view.eye,
                      "Where a mesh is looked at from; default: above its side, as close as all of "
                      "it can be seen",
                      "X,Y,Z"),
      add_number_list(app, "--target", view.target,
                      "What is in the middle of the picture; default: what fits the mesh best, and "
                      "its middle with --eye",
                      "X,Y,Z"),
      add_number_list(app, "--up", view.up, "Direction that points up; default: 0,1,0", "X,Y,Z"),
      app.add_option_function<std::string>(
             "--fov", [&view](const std::string& text) { view.fov = numbers_in(text)->front(); },
             "Vertical field of view; default: 30, along the picture's shorter side")
          ->check(CLI::Validator([](std::string& text) { return fault_of_angle(text); }, ""))
          ->type_name("DEGREES")};
  CLI::Option* camera =
      app.add_option("--camera", options.camera,
                     "Camera of a glTF file, by name or number from 0; none: the view above; "
                     "default: the file's first, if it has any")
          ->type_name("NAME");
  for (CLI::Option* option : own) camera->excludes(option);
}

std::string format_names() {
  std::string names;
  for (const cases::Importer& importer : cases::importers()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", importer.name);
  }
  return names;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  cases::ImportOptions& known = options->known;
  app.add_option("FILE", options->file,
                 "Mesh (OBJ, PLY, OFF, glTF, 3DS or another format that assimp reads) or one of "
                 "the formats below; - reads standard input")
      ->type_name(kFile)
      ->required();
  for (auto* size : {&known.width, &known.height}) {
    const bool is_width = size == &known.width;
    app.add_option(
           is_width ? "--width" : "--height", *size,
           fmt::format("{} of the picture, in pixels; default: 512", is_width ? "Width" : "Height"))
        ->check(CLI::Range(1, cases::kMaxSize))
        ->type_name("N");
  }
  app.add_option("--samples", known.samples, "Samples per pixel; default: 1")
      ->check(CLI::IsMember(std::vector<int>{1, 2, 4, 8, 16}))
      ->type_name("N");
  add_number_list(app, "--viewport", known.viewport,
                  "Viewport, in pixels; default: the whole picture", "X,Y,W,H")
      ->check(CLI::Validator([](std::string& text) { return fault_of_viewport(text); }, ""));
  add_view(app, *options);
  add_choice(app, "--rules", known.rules,
             "API whose rules the case follows; default: vulkan, or what the file shows", "API");
  add_choice(app, "--topology", known.topology,
             "How vertices form triangles; default: what the file shows", "NAME");
  add_choice(app, "--cull", known.cull, "Faces that are not drawn; default: none", "NAME");
  add_choice(app, "--front-face", known.front_face,
             "Orientation of front faces, as displayed; default: ccw", "NAME");
  app.add_option("--flat", known.flat, "Attribute that does not vary over a triangle; repeatable")
      ->allow_extra_args(false)
      ->type_name("NAME");
  app.add_option("--noperspective", known.noperspective,
                 "Attribute that varies linearly in the window; repeatable")
      ->allow_extra_args(false)
      ->type_name("NAME");
  app.add_flag("--round", known.round,
               "Take the nearest float32 of a case's decimals, and say how many there were");
  app.add_option("--format", options->format,
                 fmt::format("Format of the file: {}, or a mesh file's ending, such as obj; "
                             "default: what its name or content shows",
                             format_names()))
      ->type_name("NAME");
  app.add_option("--output", options->output, "Case file to write; - prints it")
      ->type_name(kFile)
      ->capture_default_str();
  app.add_flag("-q,--quiet", options->quiet, "Do not say what was guessed or left out");
  std::string formats = "Formats:\n";
  for (const cases::Importer& importer : cases::importers()) {
    formats += fmt::format("  {:14} {}\n", importer.name, importer.summary);
  }
  app.footer(
      "Prints a case. A mesh gets a camera that frames it, or one of its file; a file of another "
      "program is drawn as it says, and what it does not say is guessed. Each guess is told, with "
      "the option that sets it otherwise.\n\n" +
      formats +
      "\nExamples:\n"
      "  rastercheck import bunny.obj --width 256 --height 256 --output bunny.json\n"
      "  rastercheck import hall.gltf --eye 0,1.7,4 --target 0,1.5,0 --fov 60\n"
      "  rastercheck import draw.csv --width 1920 --height 1080 --output draw.json");
  return [options] { return run(*options); };
}

const Registration kRegistration("import", "Convert a mesh, or a captured draw, to a case file",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::import_command
