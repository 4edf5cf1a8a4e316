#include "cli/gate.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <utility>

#include "cases/files.h"
#include "cli/closer_looks.h"
#include "cli/command.h"
#include "cli/github.h"
#include "cli/grown_cases.h"
#include "cli/output.h"
#include "properties/campaign/corpus.h"
#include "reports/baseline_json.h"
#include "reports/compare.h"
#include "reports/compare_format.h"
#include "reports/compare_text.h"
#include "reports/run_reader.h"

namespace rastercheck::cli {
namespace {

/// Whether a text is meant to be a baseline file: both kinds say what they are in their first line.
bool is_baseline(std::string_view text) {
  constexpr std::size_t kHead = 1000;
  return text.substr(0, kHead).find("rastercheck-baseline") != std::string_view::npos;
}

reports::Day today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); }

std::string in(const std::map<std::string, std::string>& environment, const std::string& name) {
  const auto found = environment.find(name);
  return found == environment.end() ? "" : found->second;
}

/// What stands for the section of a run that is still to come.
reports::BaselineSection awaited(const std::string& backend,
                                 const std::map<std::string, std::string>& environment) {
  reports::BaselineSection section;
  section.key = {reports::section_name(backend), in(environment, "architecture"), "", ""};
  section.taken.backend = backend;
  section.taken.instruction_set = in(environment, "instruction_set");
  section.taken.compiler = in(environment, "compiler");
  return section;
}

/// Of cases that gave other bits, what is seen of them by drawing them again.
std::vector<records::CloserLook> looks_of(const reports::Gate& gate, const GateSide& baseline,
                                          const GateSide& current) {
  std::vector<records::CloserLook> looks;
  for (const reports::Comparison& comparison : gate.comparisons) {
    if (comparison.changed_cases == 0) continue;
    // Pictures are no reason to fail: without the corpus its cases have none.
    const std::vector<cases::Case> corpus =
        properties::read_corpus(corpus_of(comparison)).value_or(std::vector<cases::Case>());
    std::vector<records::CloserLook> found =
        look_closer(comparison, baseline.sections, current.sections, corpus);
    std::move(found.begin(), found.end(), std::back_inserter(looks));
  }
  return looks;
}

/// The comparison's files, its cases among them.
Result<void> write_files(const reports::Gate& gate) {
  return save_grown_cases(gate).and_then(
      [&] { return reports::write_comparison(gate, gate.folder); });
}

Result<reports::Gate> gate_of(const GateSide& baseline, const GateSide& current,
                              const GateOptions& options) {
  Result<std::vector<reports::Comparison>> comparisons =
      reports::compare(baseline.sections, current.sections, {baseline.file, current.file});
  if (!comparisons) return tl::unexpected(comparisons.error());
  reports::Gate gate;
  gate.comparisons = *std::move(comparisons);
  gate.policy = reports::apply(options.policy, today(), gate.comparisons);
  gate.baseline_file = baseline.file;
  gate.current_file = current.file;
  gate.folder = options.output;
  gate.before_run = baseline.run ? &*baseline.run : nullptr;
  gate.after_run = current.run ? &*current.run : nullptr;
  gate.baseline = &baseline.sections;
  return gate;
}

}  // namespace

Result<GateSide> side_of(records::Run run, const std::string& file) {
  Result<reports::Baseline> sections = reports::baseline_of(run);
  if (!sections) return tl::unexpected(Error{file, "", sections.error().reason});
  return GateSide{file, std::move(run), *std::move(sections)};
}

Result<GateSide> read_side(const std::string& file) {
  std::error_code ignored;
  const std::string name = std::filesystem::is_directory(file, ignored)
                               ? (std::filesystem::path(file) / "run.json").string()
                               : file;
  const Result<std::string> text = cases::read_text(name);
  if (!text) return tl::unexpected(text.error());
  if (is_baseline(*text)) {
    Result<reports::Baseline> sections = reports::parse_baseline(*text, name);
    if (!sections) return tl::unexpected(sections.error());
    return GateSide{name, std::nullopt, *std::move(sections)};
  }
  Result<records::Run> run = reports::parse_run(*text, name);
  if (!run) return tl::unexpected(run.error());
  return side_of(*std::move(run), name);
}

Result<void> rename_backend(GateSide& side, const std::string& name) {
  if (name.empty()) return {};
  if (side.sections.sections.size() != 1) {
    return tl::unexpected(
        Error{side.file, "", "--as names one backend, and there is not one section"});
  }
  side.sections.sections.front().key.backend = reports::section_name(name);
  return {};
}

void set_commit(GateSide& side, const std::string& commit) {
  for (reports::BaselineSection& section : side.sections.sections) section.taken.commit = commit;
}

Result<reports::Policy> read_policy(const std::string& file) {
  if (file.empty()) return reports::Policy();
  return reports::read_policy(file);
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

ExitCode hold_against(const GateSide& baseline, const GateSide& current,
                      const GateOptions& options) {
  Result<reports::Gate> gate = gate_of(baseline, current, options);
  if (!gate) return fail(gate.error());
  if (!options.output.empty()) gate->looks = looks_of(*gate, baseline, current);
  if (options.prints && options.json) {
    const Result<reports::CompareFormat> format = reports::find_compare_format("json");
    if (!format) return fail_internally(format.error());
    fmt::print("{}", format->write(*gate));
  } else if (options.prints) {
    fmt::print("{}", reports::comparison_text(*gate, options.quiet));
  }
  if (!options.output.empty()) {
    if (const auto written = write_files(*gate); !written) return fail(written.error());
    if (options.prints && !options.json && !options.quiet) {
      fmt::print("Comparison: {}\n", options.output);
    }
  }
  if (const auto told = tell_github(*gate, options.prints && !options.json); !told) {
    fail(told.error());
  }
  return reports::refused(gate->comparisons) > 0 ? ExitCode::regression : ExitCode::ok;
}

Result<CaseSet> case_set_for(const GateSide& baseline, const std::vector<std::string>& backends,
                             const std::map<std::string, std::string>& environment) {
  std::optional<CaseSet> set;
  for (const std::string& backend : backends) {
    const reports::BaselineSection current = awaited(backend, environment);
    const Result<const reports::BaselineSection*> section =
        reports::section_for(baseline.sections, current, baseline.file);
    if (!section) return tl::unexpected(section.error());
    const CaseSet of_section{to_string((*section)->key), (*section)->seed,
                             (*section)->cases_per_law, (*section)->options,
                             (*section)->contract_digest};
    if (const auto same = reports::check_versions(**section, current); !same) {
      return tl::unexpected(Error{baseline.file, same.error().place, same.error().reason});
    }
    if (set && (set->seed != of_section.seed || set->cases_per_law != of_section.cases_per_law ||
                set->options != of_section.options ||
                set->contract_digest != of_section.contract_digest)) {
      return tl::unexpected(Error{baseline.file, "",
                                  fmt::format("the sections {} and {} are of other cases: run one "
                                              "backend at a time",
                                              set->section, of_section.section)});
    }
    set = of_section;
  }
  if (!set) return tl::unexpected(Error{baseline.file, "", "there is no backend to compare"});
  return *set;
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
