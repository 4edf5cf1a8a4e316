// `rastercheck report DIR`: makes a run's reports again from its run.json.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/command.h"
#include "cli/format_option.h"
#include "cli/output.h"
#include "reports/format.h"
#include "reports/run_reader.h"
#include "reports/write.h"

namespace rastercheck::cli::report_command {
namespace {

struct Options {
  std::string directory;
  std::vector<std::string> formats = reports::default_format_names();
  bool quiet = false;
};

ExitCode run(const Options& options) {
  std::error_code unknown;  // reading run.json reports the cause
  if (std::filesystem::is_regular_file(options.directory, unknown)) {
    return fail({options.directory, "", "is a file; expected the output folder of a run"});
  }
  const Result<records::Run> read = reports::read_run(options.directory + "/run.json");
  if (!read) return fail(read.error());
  const Result<void> written = reports::write_reports(*read, options.directory, options.formats);
  if (!written) return fail(written.error());
  if (!options.quiet) fmt::print("{}", where_reports_are(options.directory, options.formats));
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("DIR", options->directory, "Output folder of a run, with its run.json")
      ->type_name(kFolder)
      ->required();
  add_formats(app, options->formats);
  app.add_flag("-q,--quiet", options->quiet, "Print nothing");
  app.footer(
      "Does not check anything again.\n\n"
      "Example:\n"
      "  rastercheck report rastercheck-out --format html,sarif");
  return [options] { return run(*options); };
}

const Registration kRegistration("report", "Write the reports of a run again, from its run.json",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::report_command
