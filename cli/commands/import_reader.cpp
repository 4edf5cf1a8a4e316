// `rastercheck import-reader`: the process that reads files of other programs for `rastercheck
// import`. Not for users.

#include <memory>

#include "cases/import_process.h"
#include "cli/command.h"

namespace rastercheck::cli::import_reader_command {
namespace {

struct Options {
  std::string file;
  std::string format;
  std::string options = "{}";
  cases::ProcessLimits limits = cases::default_reader_limits();
};

ExitCode run(const Options& options) {
  const auto read = cases::import_options_from_json(options.options);
  if (!read) return fail_internally(read.error());
  const Result<void> served =
      cases::serve_import(options.file, options.format, *read, options.limits);
  return served ? ExitCode::ok : fail_internally(served.error());
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.group("");  // not in --help
  app.add_option("FILE", options->file)->required();
  app.add_option("--format", options->format, "Name of an importer");
  app.add_option("--options", options->options, "Options of the importer, as JSON");
  app.add_option("--memory", options->limits.memory, "Bytes");
  app.add_option("--seconds", options->limits.seconds, "Limit of processor time, in seconds");
  return [options] { return run(*options); };
}

const Registration kRegistration("import-reader", "Read a file for another process", &set_up);

}  // namespace
}  // namespace rastercheck::cli::import_reader_command
