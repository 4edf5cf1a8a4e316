// `rastercheck probe BACKEND`: measures what a backend does and compares it with what it declares.

#include "properties/probing/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
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
  double seconds = 60;
  bool json = false;
  bool quiet = false;
};

/// Limits of --seconds: a millisecond and a day.
constexpr double kLeastSeconds = 0.001;
constexpr double kMostSeconds = 86400;

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

/// True if the probe found out anything that a contract can say.
bool has_contract(const records::Probe& probe) {
  return probe.faults.empty() && probe.measures > 0;
}

ordered_json json_of(const records::Sureness& sureness) {
  if (sureness.unit.empty()) return nullptr;
  return {{"of", sureness.unit},
          {"for", sureness.in_favour},
          {"against", sureness.against},
          {"undecided", sureness.undecided}};
}

void print_json(const records::Probe& probe) {
  ordered_json faults = ordered_json::array();
  for (const records::DrawingFault& fault : probe.faults) {
    faults.push_back(
        {{"id", fault.id}, {"sentence", fault.sentence}, {"sureness", json_of(fault.sureness)}});
  }
  ordered_json rows = ordered_json::array();
  for (const records::Measured& row : probe.rows) {
    rows.push_back({{"what", row.what},
                    {"declared", row.declared},
                    {"measured", row.measured},
                    {"detail", row.detail},
                    {"contradicts", row.contradicts},
                    {"sureness", json_of(row.sureness)}});
  }
  ordered_json unmeasured = ordered_json::array();
  for (const records::Unmeasured& one : probe.unmeasured) {
    unmeasured.push_back({{"what", one.what}, {"keys", one.keys}});
  }
  nlohmann::json contract;
  if (has_contract(probe)) {
    contract = cases::parse_json(cases::to_json(probe.terms), "").value_or(nlohmann::json());
  }
  const ordered_json document{{"format", "rastercheck-probe"},
                              {"version", 1},
                              {"backend", probe.backend},
                              {"description", probe.description},
                              {"seed", probe.seed},
                              {"faults", std::move(faults)},
                              {"measured", std::move(rows)},
                              {"not_measured", std::move(unmeasured)},
                              {"drawings", probe.drawings},
                              {"unsupported", probe.unsupported},
                              {"failed", probe.failed},
                              {"failure", probe.failure},
                              {"contract", std::move(contract)}};
  fmt::print("{}\n", document.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

/// Says how sure a finding is: "all 120 samples, 3 undecided", "118 of 120 samples".
std::string words_of(const records::Sureness& sureness) {
  if (sureness.unit.empty()) return "";
  const std::uint64_t all = sureness.in_favour + sureness.against;
  std::string text;
  if (all == 0) {
    text = fmt::format("no {}", sureness.unit);
  } else if (sureness.against == 0) {
    text = fmt::format("all {} {}", all, sureness.unit);
  } else {
    text = fmt::format("{} of {} {}", sureness.in_favour, all, sureness.unit);
  }
  if (sureness.undecided > 0) text += fmt::format(", {} undecided", sureness.undecided);
  return text;
}

/// Says where a row comes from.
std::string from_of(const records::Measured& row) {
  const std::string words = words_of(row.sureness);
  return words + (words.empty() || row.detail.empty() ? "" : "; ") + row.detail;
}

void print_faults(const records::Probe& probe, bool quiet) {
  if (!quiet && !probe.description.empty()) fmt::print("{}\n", cases::one_line(probe.description));
  for (const records::DrawingFault& fault : probe.faults) {
    fmt::print("{}{}\n", fault.sentence,
               quiet ? "" : fmt::format(" ({})", words_of(fault.sureness)));
  }
  if (!quiet) {
    fmt::print("\nNothing else was measured, and no contract is written: mend this first.\n");
  }
}

/// Returns "a, b and c".
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

/// Says what was not measured, and what the contract file lacks for it.
void print_unmeasured(const records::Probe& probe, double seconds, bool has_file) {
  if (probe.unmeasured.empty()) return;
  std::vector<std::string> names;
  std::vector<std::string> keys;
  for (const records::Unmeasured& one : probe.unmeasured) {
    names.push_back(one.what);
    keys.insert(keys.end(), one.keys.begin(), one.keys.end());
  }
  fmt::print("\nNot measured within {:g} s (--seconds): {}.\n", seconds, listed(names));
  if (!has_file || !has_contract(probe) || keys.empty()) return;
  fmt::print("The contract file has no {}, so what the backend declares stands.\n", listed(keys));
}

void print_table(const records::Probe& probe, bool quiet) {
  std::vector<std::vector<std::string>> cells;
  if (!quiet) {
    if (!probe.description.empty()) fmt::print("{}\n", cases::one_line(probe.description));
    cells.push_back({"", "declared", "measured", "from"});
  }
  std::vector<records::Measured> rows = probe.rows;
  std::stable_partition(rows.begin(), rows.end(), [](const auto& row) { return row.contradicts; });
  for (const records::Unmeasured& one : probe.unmeasured) {
    rows.push_back({one.what, "–", "not measured", "the time was up"});
  }
  for (const records::Measured& row : rows) {
    cells.push_back(
        {(row.contradicts ? "! " : "") + row.what, row.declared, row.measured, from_of(row)});
  }
  fmt::print("{}", reports::text_table(cells, quiet ? std::nullopt : terminal_columns()));
  if (quiet) return;
  const auto contradictions =
      std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.contradicts; });
  if (contradictions > 0) {
    fmt::print("\n! marks {} of {} measurements that contradict what the backend declares.\n",
               contradictions, probe.rows.size());
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

/// Returns the options with a time limit that begins now.
properties::ProbeOptions timed(properties::ProbeOptions options, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  options.is_time_up = [end] { return Clock::now() >= end; };
  return options;
}

Result<void> write_contract(const records::Probe& probe, const Options& options) {
  Result<void> written = cases::write_file(options.contract_out, cases::to_json(probe.terms));
  if (!written || options.json || options.quiet) return written;
  fmt::print("Contract: {} (rastercheck run --backend {} --contract {})\n", options.contract_out,
             options.backend, options.contract_out);
  return {};
}

ExitCode report(const records::Probe& probe, const Options& options) {
  if (options.json) {
    print_json(probe);
  } else if (!probe.faults.empty()) {
    print_faults(probe, options.quiet);
  } else {
    print_table(probe, options.quiet);
    if (!options.quiet) {
      print_unmeasured(probe, options.seconds, !options.contract_out.empty());
    }
  }
  if (!probe.faults.empty()) return ExitCode::violated;
  if (!has_contract(probe)) return ExitCode::nothing_checked;
  if (options.contract_out.empty()) return ExitCode::ok;
  if (const auto written = write_contract(probe, options); !written) return fail(written.error());
  return ExitCode::ok;
}

ExitCode run(const Options& options) {
  const Result<properties::ProbeOptions> read = read_options(options);
  if (!read) return fail(read.error());
  if (const auto checked = check_contract_out(options); !checked) return fail(checked.error());
  const auto backend = backend_factory(options.timeout).make(options.backend);
  if (!backend) return fail_backend(backend.error());
  ProgressBar bar(options.quiet || options.json);
  const auto progress = [&bar](std::uint64_t done, std::uint64_t all, const std::string& what) {
    bar.show(done, all, fmt::format("measures: {}", what).c_str());
  };
  const Result<records::Probe> probe =
      properties::probe(options.backend, **backend, timed(*read, options.seconds), progress);
  bar.erase();
  if (!probe) {
    fail(probe.error());
    return ExitCode::backend_unavailable;
  }
  return report(*probe, options);
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
  app.add_option("--seconds", options->seconds,
                 "Stop measuring after this many seconds and report what was found until then")
      ->check(CLI::Range(kLeastSeconds, kMostSeconds))
      ->type_name("SECONDS")
      ->capture_default_str();
  add_timeout(app, options->timeout);
  app.add_flag("--json", options->json, "Print the result as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print only the table's rows, and no progress bar");
  app.footer(
      "First looks for faults after which no measurement would mean anything, such as a picture "
      "upside down; if there are any, says which, and ends. Otherwise measures the subpixel grid, "
      "rounding, fill rule, guard band and errors, without judging them.\n\n"
      "Exit code 0 if the backend was measured, also if --seconds ended it; 1 if it has such a "
      "fault, or draws nothing; 4 if it cannot run here, or refuses every case; 5 if the time was "
      "up before anything was measured.\n\n"
      "Example:\n"
      "  rastercheck probe gl:llvmpipe --contract-out llvmpipe.json");
  return [options] { return run(*options); };
}

const Registration kRegistration("probe", "Measure what a backend draws, next to what it declares",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::probe_command
