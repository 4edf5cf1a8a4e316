#include "cli/gate.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "cli/command.h"
#include "cli/corpus_folder.h"
#include "cli/github.h"
#include "cli/output.h"
#include "gate/hold.h"
#include "reports/compare_format.h"
#include "reports/compare_text.h"

namespace rastercheck::cli {

Result<gate::Policy> read_policy(const std::string& file) {
  if (file.empty()) return gate::Policy();
  return gate::read_policy(file);
}

Result<void> check_comparison_files(const std::string& folder,
                                    std::span<const std::string> inputs) {
  if (folder.empty()) return {};
  for (const reports::CompareFormat& format : reports::compare_formats()) {
    const std::string file = (std::filesystem::path(folder) / format.file_name).string();
    for (const std::string& input : inputs) {
      if (Result<void> checked = check_output_file(file, input); !checked) return checked;
    }
  }
  return {};
}

ExitCode hold_against(const gate::Side& baseline, const gate::Side& current,
                      const GateOptions& options) {
  const Result<reports::Gate> gate = gate::hold(
      baseline, current,
      {options.policy, options.output, corpus_folder(), worker_program(), options.timeout});
  if (!gate) return fail(gate.error());
  if (options.prints && options.json) {
    const Result<reports::CompareFormat> format = reports::find_compare_format("json");
    if (!format) return fail_internally(format.error());
    fmt::print("{}", format->write(*gate));
  } else if (options.prints) {
    fmt::print("{}", reports::comparison_text(*gate, options.quiet));
  }
  if (!options.output.empty()) {
    const Result<void> written = gate::write_files(*gate, corpus_folder());
    if (!written) return fail(written.error());
    if (options.prints && !options.json && !options.quiet) {
      fmt::print("Comparison: {}\n", options.output);
    }
  }
  if (const auto told = tell_github(*gate, options.prints && !options.json); !told) {
    fail(told.error());
  }
  return records::refused(gate->comparisons) > 0 ? ExitCode::regression : ExitCode::ok;
}

ExitCode first_of(ExitCode a, ExitCode b) {
  constexpr auto kOrder = std::to_array<ExitCode>(
      {ExitCode::internal, ExitCode::usage, ExitCode::backend_unavailable, ExitCode::violated,
       ExitCode::regression, ExitCode::interrupted, ExitCode::nothing_checked});
  for (const ExitCode code : kOrder) {
    if (a == code || b == code) return code;
  }
  return ExitCode::ok;
}

}  // namespace rastercheck::cli
