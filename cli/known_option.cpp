#include "cli/known_option.h"

#include "cli/corpus_folder.h"

namespace rastercheck::cli {

properties::KnownSources KnownOption::sources() const {
  return is_none ? properties::KnownSources() : known_sources_of(given);
}

namespace {

void add_known(CLI::App& app, properties::KnownSources& given, bool& is_none) {
  CLI::Option* known =
      app.add_option("--known", given,
                     "List of known defects (rastercheck known add) or expectation list "
                     "(NAME-fails.txt, -flakes.txt, -skips.txt), or a folder of lists of drivers, "
                     "DRIVER/known.json, in place of those that come with the program; may be "
                     "given several times")
          ->check(CLI::ExistingPath)
          ->allow_extra_args(false)
          ->type_name(kFile);
  app.add_flag("--no-known", is_none, "Defects that are known of a backend count as any other")
      ->excludes(known);
}

}  // namespace

void add_known(CLI::App& app, KnownOption& option) { add_known(app, option.given, option.is_none); }

void add_known(CLI::App& app, records::Plan& plan) {
  add_known(app, plan.known, plan.ignores_known);
}

}  // namespace rastercheck::cli
