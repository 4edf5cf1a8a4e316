// `rastercheck picture`: the process that reads a picture file for the other commands
// (cli/picture_option.h). Not for users.

#include <memory>

#include "cases/picture_process.h"
#include "cli/command.h"

namespace rastercheck::cli::picture_command {
namespace {

struct Options {
  std::string file;
  bool is_chw = false;
  cases::ProcessLimits limits = cases::default_reader_limits();
};

ExitCode run(const Options& options) {
  const auto order = options.is_chw ? cases::ArrayOrder::chw : cases::ArrayOrder::hwc;
  const Result<void> served = cases::serve_picture(options.file, order, options.limits);
  if (!served) return fail_internally(served.error());
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.group("");  // not in --help
  app.add_option("PICTURE", options->file)->required();
  app.add_flag("--chw", options->is_chw);
  app.add_option("--memory", options->limits.memory, "Bytes");
  app.add_option("--seconds", options->limits.seconds, "Limit of processor time, in seconds");
  return [options] { return run(*options); };
}

const Registration kRegistration("picture", "Read a picture for another process", &set_up);

}  // namespace
}  // namespace rastercheck::cli::picture_command
