// `rastercheck report DIR`: the reports of a run, made again from its run.json.

#include <fmt/format.h>

#include <memory>

#include "cli/command.h"
#include "cli/output.h"
#include "reports/format.h"
#include "reports/run_reader.h"
#include "reports/write.h"

namespace rastercheck::cli {
namespace {

struct Options {
  std::string directory;
  std::vector<std::string> formats = reports::default_format_names();
  bool quiet = false;
};

ExitCode run(const Options& options) {
  const Result<records::Run> read = reports::read_run(options.directory + "/run.json");
  if (!read) return fail(read.error());
  const Result<void> written = reports::write_reports(*read, options.directory, options.formats);
  if (!written) return fail(written.error());
  if (!options.quiet) fmt::print("{}", where_reports_are(options.directory, options.formats));
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("DIR", options->directory, "Output folder of a run")->required();
  app.add_option("--format", options->formats, "Reports to write, with commas between them")
      ->delimiter(',')
      ->capture_default_str();
  app.add_flag("-q,--quiet", options->quiet, "Prints nothing");
  return [options] { return run(*options); };
}

const Registration kRegistration("report", "Makes the reports of a run again", &set_up);

}  // namespace
}  // namespace rastercheck::cli
