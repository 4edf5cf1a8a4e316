#include "cli/known_option.h"

#include "cli/corpus_folder.h"

namespace rastercheck::cli {

std::string KnownOption::folder() const {
  if (is_none) return "";
  return directory.empty() ? known_folder() : directory;
}

void add_known(CLI::App& app, KnownOption& option) {
  CLI::Option* known =
      app.add_option("--known", option.directory,
                     "Folder of lists of known defects of drivers, DRIVER/known.json; without it "
                     "those that come with the program")
          ->check(CLI::ExistingDirectory)
          ->type_name(kFolder);
  app.add_flag("--no-known", option.is_none,
               "Defects that are known of a driver count as any other")
      ->excludes(known);
}

}  // namespace rastercheck::cli
