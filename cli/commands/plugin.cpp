// `rastercheck plugin new DIR`: makes a starter project for a plugin or for a program that draws,
// which builds and keeps its promises without changes.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "cases/files.h"
#include "cli/command.h"
#include "cli/plugin_starter.h"

namespace rastercheck::cli::plugin_command {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string folder;
  std::string language = "c";
  std::string gives = "fragments";
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

/// The languages of the starters for rasterizers that give fragments: those of all starters.
std::vector<std::string> languages() {
  std::vector<std::string> languages;
  for (const Starter& starter : starters()) {
    if (starter.gives == "fragments") languages.emplace_back(starter.language);
  }
  return languages;
}

Result<const Starter*> find_starter(const Options& options) {
  std::string others;
  for (const Starter& starter : starters()) {
    if (starter.gives != options.gives) continue;
    if (starter.language == options.language) return &starter;
    others += fmt::format("{}{}", others.empty() ? "" : ", ", starter.language);
  }
  return tl::unexpected(
      Error{"--from " + options.gives, "",
            fmt::format("has no project in {}, but in: {}", options.language, others)});
}

ExitCode make_new(const Options& options) {
  const Result<const Starter*> starter = find_starter(options);
  if (!starter) return fail(starter.error());
  if (const Result<void> made = make_empty(options.folder); !made) return fail(made.error());
  for (const StarterFile& file : (*starter)->files) {
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
      app.add_subcommand("new", "Write a project for your rasterizer: a small one that works");
  new_command
      ->add_option("DIR", options->folder,
                   "Folder for the project; must be new or empty, apart from a git repository")
      ->type_name(kFolder)
      ->required();
  new_command
      ->add_option("--language", options->language,
                   "Language of the project: a plugin in C or C++, else a program")
      ->check(CLI::IsMember(languages()))
      ->type_name("LANGUAGE")
      ->capture_default_str();
  new_command
      ->add_option("--from", options->gives,
                   "What your rasterizer gives: fragments with values, or only an 8-bit image")
      ->check(CLI::IsMember({"fragments", "image"}))
      ->type_name("OUTPUT")
      ->capture_default_str();
  new_command->add_flag("-q,--quiet", options->quiet, "Print nothing");
  constexpr const char* kFooter =
      "Prints the names of the files. Their README.md describes the next steps.\n\n"
      "Examples:\n"
      "  rastercheck plugin new mine\n"
      "  rastercheck plugin new mine --language python\n"
      "  rastercheck plugin new mine --from image --language c++";
  app.footer(kFooter);
  new_command->footer(kFooter);
  return [options] { return make_new(*options); };
}

const Registration kRegistration("plugin",
                                 "Create a plugin or program that connects your rasterizer",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::plugin_command
