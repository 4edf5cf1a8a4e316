#include "cli/known_option.h"

#include "cli/corpus_folder.h"

namespace rastercheck::cli {

std::string KnownOption::folder() const {
  if (is_none) return "";
  return directory.empty() ? known_folder() : directory;
}

namespace {

void add_known(CLI::App& app, std::string& directory, bool& is_none) {
  CLI::Option* known =
      app.add_option("--known", directory,
                     "Folder of lists of known defects of drivers, DRIVER/known.json; without it "
                     "those that come with the program")
          ->check(CLI::ExistingDirectory)
          ->type_name(kFolder);
  app.add_flag("--no-known", is_none, "Defects that are known of a driver count as any other")
      ->excludes(known);
}

}  // namespace

void add_known(CLI::App& app, KnownOption& option) {
  add_known(app, option.directory, option.is_none);
}

void add_known(CLI::App& app, records::Plan& plan) {
  add_known(app, plan.known, plan.ignores_known);
}

}  // namespace rastercheck::cli
