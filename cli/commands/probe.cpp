// `rastercheck probe BACKEND`: measures what a backend does and compares it with what it declares.

#include "properties/probing/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cases/contract_json.h"
#include "cases/files.h"
#include "cases/json.h"
#include "cases/names.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/isolation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "cli/whole_number.h"
#include "reports/text_table.h"

namespace rastercheck::cli::probe_command {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string backend;
  std::string ask;
  std::string ask_basis;
  std::string ask_fill_rule;
  std::string contract_out;
  std::uint64_t seed = 1;
  int cases = properties::ProbeOptions().cases;
  double timeout = kDefaultTimeout;
  bool json = false;
  bool quiet = false;
};

Error refused(const std::string& option, const std::string& reason) { return {option, "", reason}; }

/// Reads "exact", "snapped:8" or "snapped:8:half_up".
Result<cases::Coverage> read_coverage(const std::string& text) {
  if (text == "exact") return cases::Coverage();
  constexpr std::string_view kSnapped = "snapped:";
  const auto refuse = [] {
    return tl::unexpected(refused(
        "--ask", "must be exact, snapped:BITS or snapped:BITS:ROUNDING, with BITS from 0 to 16"));
  };
  if (!text.starts_with(kSnapped)) return refuse();
  const std::string rest = text.substr(kSnapped.size());
  const std::size_t colon = rest.find(':');
  const std::string digits = rest.substr(0, colon);
  const bool are_digits = digits.find_first_not_of("0123456789") == std::string::npos;
  if (digits.empty() || digits.size() > 2 || !are_digits) return refuse();
  cases::Snapping snapping{std::stoi(digits)};
  if (snapping.subpixel_bits > cases::kMaxSubpixelBits) return refuse();
  if (colon != std::string::npos) {
    const auto rounding = cases::from_name<cases::Rounding>(rest.substr(colon + 1));
    if (!rounding) return refuse();
    snapping.rounding = *rounding;
  }
  return cases::Coverage(snapping);
}

Result<properties::ProbeOptions> read_options(const Options& options) {
  properties::ProbeOptions read;
  read.seed = options.seed;
  read.cases = options.cases;
  if (!options.ask.empty()) {
    const Result<cases::Coverage> coverage = read_coverage(options.ask);
    if (!coverage) return tl::unexpected(coverage.error());
    read.asked.coverage = *coverage;
  }
  if (!options.ask_basis.empty()) {
    read.asked.basis = cases::from_name<cases::Basis>(options.ask_basis);
  }
  if (!options.ask_fill_rule.empty()) {
    read.asked.fill_rule = cases::from_name<cases::TieRule>(options.ask_fill_rule);
  }
  return read;
}

void print_json(const records::Probe& probe) {
  ordered_json rows = ordered_json::array();
  for (const records::Measured& row : probe.rows) {
    rows.push_back({{"what", row.what},
                    {"declared", row.declared},
                    {"measured", row.measured},
                    {"detail", row.detail},
                    {"contradicts", row.contradicts}});
  }
  const auto contract = cases::parse_json(cases::to_json(probe.terms), "");
  const ordered_json document{{"format", "rastercheck-probe"},
                              {"version", 1},
                              {"backend", probe.backend},
                              {"description", probe.description},
                              {"seed", probe.seed},
                              {"measured", std::move(rows)},
                              {"drawings", probe.drawings},
                              {"unsupported", probe.unsupported},
                              {"failed", probe.failed},
                              {"failure", probe.failure},
                              {"contract", contract.value_or(nlohmann::json())}};
  fmt::print("{}\n", document.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

void print_table(const records::Probe& probe, bool quiet) {
  std::vector<std::vector<std::string>> cells;
  if (!quiet) {
    if (!probe.description.empty()) fmt::print("{}\n", cases::one_line(probe.description));
    cells.push_back({"", "declared", "measured", "from"});
  }
  std::vector<records::Measured> rows = probe.rows;
  std::stable_partition(rows.begin(), rows.end(), [](const auto& row) { return row.contradicts; });
  for (const records::Measured& row : rows) {
    cells.push_back(
        {(row.contradicts ? "! " : "") + row.what, row.declared, row.measured, row.detail});
  }
  fmt::print("{}", reports::text_table(cells, quiet ? std::nullopt : terminal_columns()));
  if (quiet) return;
  const auto contradictions =
      std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.contradicts; });
  if (contradictions > 0) {
    fmt::print("\n! marks {} of {} measurements that contradict what the backend declares.\n",
               contradictions, rows.size());
  }
  fmt::print("\n{} drawings, {} of unsupported cases, {} failed{}\n", probe.drawings,
             probe.unsupported, probe.failed,
             probe.failure.empty() ? "" : ": " + cases::one_line(probe.failure));
}

/// Refuses to overwrite the backend's own file, as in "plugin:FILE", with the contract.
Result<void> check_contract_out(const Options& options) {
  const std::size_t colon = options.backend.find(':');
  if (colon == std::string::npos) return {};
  return check_output_file(options.contract_out, options.backend.substr(colon + 1));
}

ExitCode run(const Options& options) {
  const Result<properties::ProbeOptions> read = read_options(options);
  if (!read) return fail(read.error());
  if (const auto checked = check_contract_out(options); !checked) return fail(checked.error());
  const auto backend = backend_factory(options.timeout).make(options.backend);
  if (!backend) return fail_backend(backend.error());
  ProgressBar bar(options.quiet || options.json);
  const auto progress = [&bar](std::uint64_t done, std::uint64_t all) {
    bar.show(done, all, "generators");
  };
  const Result<records::Probe> probe =
      properties::probe(options.backend, **backend, *read, progress);
  bar.erase();
  if (!probe) {
    fail(probe.error());
    return ExitCode::backend_unavailable;
  }
  if (options.json) {
    print_json(*probe);
  } else {
    print_table(*probe, options.quiet);
  }
  if (options.contract_out.empty()) return ExitCode::ok;
  const Result<void> written =
      cases::write_file(options.contract_out, cases::to_json(probe->terms));
  if (!written) return fail(written.error());
  if (!options.json && !options.quiet) {
    fmt::print("Contract: {} (rastercheck run --backend {} --contract {})\n", options.contract_out,
               options.backend, options.contract_out);
  }
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("BACKEND", options->backend, "Backend to measure (see rastercheck list backends)")
      ->type_name(kBackend)
      ->required();
  app.add_option("--contract-out", options->contract_out,
                 "Write the result to this file, as a contract for `run --contract`")
      ->type_name(kFile);
  app.add_option("--ask", options->ask,
                 "Coverage that all cases ask for: exact, snapped:BITS or snapped:BITS:ROUNDING, "
                 "with the BITS of the subpixel grid, such as snapped:8; default: also measure "
                 "whether the backend honours requests")
      ->type_name("COVERAGE");
  app.add_option("--ask-basis", options->ask_basis,
                 "Basis of attributes that all cases ask for: ideal, the triangle as given, or "
                 "snapped, its snapped vertices")
      ->type_name("BASIS")
      ->check(CLI::IsMember({"ideal", "snapped"}));
  app.add_option("--ask-fill-rule", options->ask_fill_rule,
                 "Rule for samples on an edge that all cases ask for")
      ->type_name("RULE")
      ->check(CLI::IsMember({"top_left", "bottom_left"}));
  app.add_option("--cases", options->cases, "Random cases per generator")
      ->check(CLI::Range(1, 100000))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--seed", options->seed, "Seed of the random cases")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  add_timeout(app, options->timeout);
  app.add_flag("--json", options->json, "Print the result as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print only the table's rows, and no progress bar");
  app.footer(
      "Measures the subpixel grid, rounding, fill rule, guard band and errors, without judging "
      "them. Exit code 0 if the backend was measured, 4 if it cannot run here or draws nothing.\n\n"
      "Example:\n"
      "  rastercheck probe gl:llvmpipe --contract-out llvmpipe.json");
  return [options] { return run(*options); };
}

const Registration kRegistration("probe", "Measure what a backend draws, next to what it declares",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::probe_command
