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
                     "Folder of lists of known defects, DRIVER/known.json, that takes the place of "
                     "the project's own")
          ->check(CLI::ExistingDirectory);
  app.add_flag("--no-known", option.is_none, "Known defects count as any other")->excludes(known);
}

}  // namespace rastercheck::cli
