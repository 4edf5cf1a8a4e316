#include "cli/known_option.h"

#include "cli/corpus_folder.h"

namespace rastercheck::cli {

properties::KnownSources KnownOption::sources() const {
  return is_none ? properties::KnownSources() : known_sources_of(given);
}

namespace {

void add_known(CLI::App& app, properties::KnownSources& given, bool& is_none) {
  CLI::Option* known =
      app.add_option(
             "--known", given,
             "List of known defects (rastercheck known add), expectation list (NAME-fails.txt, "
             "-flakes.txt, -skips.txt), or folder of drivers' lists (DRIVER/known.json), instead "
             "of the lists that come with the program; may be repeated")
          ->check(CLI::ExistingPath)
          ->allow_extra_args(false)
          ->type_name(kFile);
  app.add_flag("--no-known", is_none, "Count known defects of a backend like any others")
      ->excludes(known);
}

}  // namespace

void add_known(CLI::App& app, KnownOption& option) { add_known(app, option.given, option.is_none); }

void add_known(CLI::App& app, records::Plan& plan) {
  add_known(app, plan.known, plan.ignores_known);
}

}  // namespace rastercheck::cli
