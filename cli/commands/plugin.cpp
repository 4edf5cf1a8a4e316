// `rastercheck plugin new DIR`: makes a starter project for a plugin, which builds and keeps its
// promises without changes.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <system_error>

#include "cases/files.h"
#include "cli/command.h"
#include "cli/plugin_starter.h"

namespace rastercheck::cli::plugin_command {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string folder;
  std::string language = "c";
  bool quiet = false;
};

/// Makes the folder, or checks that it is empty or holds only a git repository.
Result<void> make_empty(const std::string& folder) {
  std::error_code why;
  fs::create_directories(folder, why);
  if (why) return tl::unexpected(Error{folder, "", "cannot be created: " + why.message()});
  bool is_empty = true;
  for (auto entry = fs::directory_iterator(folder, why); !why && entry != fs::directory_iterator();
       entry.increment(why)) {
    is_empty = is_empty && entry->path().filename() == ".git";
  }
  if (why) return tl::unexpected(Error{folder, "", "cannot be read: " + why.message()});
  if (!is_empty) return tl::unexpected(Error{folder, "", "already exists and is not empty"});
  return {};
}

ExitCode make_new(const Options& options) {
  if (const Result<void> made = make_empty(options.folder); !made) return fail(made.error());
  const std::span<const StarterFile> files =
      options.language == "c" ? starter_in_c() : starter_in_cxx();
  for (const StarterFile& file : files) {
    const fs::path path = fs::path(options.folder) / file.path;
    std::error_code why;
    fs::create_directories(path.parent_path(), why);
    if (why) return fail({path.parent_path().string(), "", "cannot be created: " + why.message()});
    const Result<void> written = cases::write_file(path.string(), std::string(file.text));
    if (!written) return fail(written.error());
    if (!options.quiet) fmt::print("{}\n", path.string());
  }
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.require_subcommand(1);
  CLI::App* new_command =
      app.add_subcommand("new", "Write a project that builds a plugin: a small rasterizer");
  new_command
      ->add_option("DIR", options->folder,
                   "Folder for the project; must be new or empty, apart from a git repository")
      ->type_name(kFolder)
      ->required();
  new_command->add_option("--language", options->language, "Language of the project")
      ->check(CLI::IsMember({"c", "c++"}))
      ->type_name("LANGUAGE")
      ->capture_default_str();
  new_command->add_flag("-q,--quiet", options->quiet, "Print nothing");
  constexpr const char* kFooter =
      "Prints the names of the files. Their README.md describes the next steps.\n\n"
      "Example:\n"
      "  rastercheck plugin new mine";
  app.footer(kFooter);
  new_command->footer(kFooter);
  return [options] { return make_new(*options); };
}

const Registration kRegistration("plugin", "Create a plugin that connects your rasterizer",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::plugin_command
