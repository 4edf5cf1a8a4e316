// `rastercheck compare BASELINE CURRENT`: the regression gate.

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "backends/factory.h"
#include "cli/command.h"
#include "cli/commit.h"
#include "cli/gate.h"
#include "reports/commands.h"

namespace rastercheck::cli::compare_command {
namespace {

struct Options {
  std::string baseline;
  std::string current;
  std::string as;
  std::string commit;
  std::string policy;
  GateOptions gate;
};

/// Reads the current side, renames its backend and sets its commit.
Result<gate::Side> read_current(const Options& options) {
  Result<gate::Side> current = gate::read_side(options.current);
  if (!current) return current;
  if (const auto renamed = gate::rename_backend(*current, options.as); !renamed) {
    return tl::unexpected(renamed.error());
  }
  if (current->run || !options.commit.empty())
    gate::set_commit(*current, commit_of(options.commit));
  return current;
}

/// True if there is no such file, and the text reads like a backend: "gl:llvmpipe".
bool is_backend(const std::string& text) {
  std::error_code ignored;
  return text != "-" && !std::filesystem::exists(text, ignored) && backends::names_a_kind(text);
}

/// Fails if an argument names a backend instead of a file. The error says how to compare backends
/// or, if only one argument is a backend, how to make a run of it.
Result<void> check_no_backend(const Options& options) {
  const bool is_first = is_backend(options.baseline);
  const bool is_second = is_backend(options.current);
  if (!is_first && !is_second) return {};
  const std::string& one = is_first ? options.baseline : options.current;
  if (is_first && is_second) {
    return tl::unexpected(
        Error{one, "",
              fmt::format(
                  "is a backend, and compare takes runs or baselines; to compare two backends: {}",
                  reports::command_line({"rastercheck", "run", "--backend", options.baseline,
                                         "--backend", options.current}))});
  }
  return tl::unexpected(
      Error{one, "",
            fmt::format(
                "is a backend, and compare takes runs or baselines; to make a run of it: {}",
                reports::command_line({"rastercheck", "run", "--backend", one, "--keep-cases"}))});
}

ExitCode run(Options options) {
  if (options.baseline == "-" && options.current == "-") {
    return fail({"-", "", "only one of BASELINE and CURRENT can be standard input"});
  }
  if (const auto checked = check_no_backend(options); !checked) return fail(checked.error());
  Result<gate::Policy> policy = read_policy(options.policy);
  if (!policy) return fail(policy.error());
  options.gate.policy = *std::move(policy);
  const Result<gate::Side> baseline = gate::read_side(options.baseline);
  if (!baseline) return fail(baseline.error());
  const Result<gate::Side> current = read_current(options);
  if (!current) return fail(current.error());
  const auto inputs = std::to_array<std::string>({baseline->file, current->file, options.policy});
  if (const auto checked = check_comparison_files(options.gate.output, inputs); !checked) {
    return fail(checked.error());
  }
  return hold_against(*baseline, *current, options.gate);
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("BASELINE", options->baseline,
                 "Baseline file, or the run.json or folder of a run with --keep-cases; - reads "
                 "standard input")
      ->type_name(kFile)
      ->required();
  app.add_option("CURRENT", options->current, "What to compare with BASELINE, in the same forms")
      ->type_name(kFile)
      ->required();
  app.add_option("--policy", options->policy,
                 "File that says what may be worse, why and until when")
      ->type_name(kFile);
  app.add_option("--as", options->as, "Name of the backend in the baseline, if it differs")
      ->type_name("NAME");
  app.add_option("--commit", options->commit,
                 "Commit that CURRENT belongs to; default: as CI or git reports")
      ->type_name("COMMIT");
  app.add_option("--output", options->gate.output,
                 "Folder for the comparison as HTML, Markdown and JSON, and for the cases whose "
                 "errors grew")
      ->type_name(kFolder);
  app.add_flag("--json", options->gate.json, "Print the comparison as JSON");
  app.add_flag("-q,--quiet", options->gate.quiet, "Print only the verdict and what is worse");
  app.footer(
      "Exit code 0 if nothing is worse or everything worse is allowed, 3 otherwise, 2 if the two "
      "cannot be compared because their cases or their versions of rules or records differ.\n\n"
      "To compare two backends with each other: rastercheck run --backend A --backend B\n\n"
      "Example:\n"
      "  rastercheck run --seed 1 --keep-cases\n"
      "  rastercheck compare rastercheck-baseline.json rastercheck-out");
  return [options] { return run(*options); };
}

const Registration kRegistration("compare",
                                 "Compare a run with a baseline and report what is worse", &set_up);

}  // namespace
}  // namespace rastercheck::cli::compare_command
