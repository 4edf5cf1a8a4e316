#include "cli/format_option.h"

#include "reports/format.h"

namespace rastercheck::cli {

void add_formats(CLI::App& app, std::vector<std::string>& formats) {
  app.add_option("--format", formats, "Reports to write, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows are files
      ->check(CLI::IsMember(reports::format_names()))
      ->type_name("LIST")
      ->capture_default_str();
}

}  // namespace rastercheck::cli
