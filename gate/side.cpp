#include "gate/side.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "cases/files.h"
#include "gate/compare.h"
#include "gate/sections.h"
#include "records/baseline_json.h"
#include "reports/run_reader.h"

namespace rastercheck::gate {
namespace {

/// True if a text is meant to be a baseline file: both kinds of files name their kind at the
/// beginning.
bool is_baseline(std::string_view text) {
  constexpr std::size_t kHead = 1000;
  return text.substr(0, kHead).find("rastercheck-baseline") != std::string_view::npos;
}

std::string in(const std::map<std::string, std::string>& environment, const std::string& name) {
  const auto found = environment.find(name);
  return found == environment.end() ? "" : found->second;
}

/// A placeholder for the section of a future run.
records::BaselineSection awaited(const std::string& backend,
                                 const std::map<std::string, std::string>& environment) {
  records::BaselineSection section;
  section.key = {records::section_name(backend), in(environment, "architecture"), "", ""};
  section.taken.backend = backend;
  section.taken.instruction_set = in(environment, "instruction_set");
  section.taken.compiler = in(environment, "compiler");
  return section;
}

}  // namespace

Result<Side> side_of(records::Run run, const std::string& file) {
  Result<records::Baseline> sections = baseline_of(run);
  if (!sections) return tl::unexpected(Error{file, "", sections.error().reason});
  return Side{file, std::move(run), *std::move(sections)};
}

Result<Side> read_side(const std::string& file) {
  std::error_code ignored;
  const std::string name = std::filesystem::is_directory(file, ignored)
                               ? (std::filesystem::path(file) / "run.json").string()
                               : file;
  const Result<std::string> text = cases::read_text(name);
  if (!text) return tl::unexpected(text.error());
  if (is_baseline(*text)) {
    Result<records::Baseline> sections = records::parse_baseline(*text, name);
    if (!sections) return tl::unexpected(sections.error());
    return Side{name, std::nullopt, *std::move(sections)};
  }
  Result<records::Run> run = reports::parse_run(*text, name);
  if (!run) return tl::unexpected(run.error());
  return side_of(*std::move(run), name);
}

Result<void> rename_backend(Side& side, const std::string& name) {
  if (name.empty()) return {};
  if (side.sections.sections.size() != 1) {
    return tl::unexpected(
        Error{side.file, "",
              fmt::format("--as needs a file with exactly one section; this one has {}",
                          side.sections.sections.size())});
  }
  side.sections.sections.front().key.backend = records::section_name(name);
  return {};
}

void set_commit(Side& side, const std::string& commit) {
  for (records::BaselineSection& section : side.sections.sections) section.taken.commit = commit;
}

Result<CaseSet> case_set_for(const Side& baseline, const std::vector<std::string>& backends,
                             const std::map<std::string, std::string>& environment) {
  std::optional<CaseSet> set;
  for (const std::string& backend : backends) {
    const records::BaselineSection current = awaited(backend, environment);
    const Result<const records::BaselineSection*> section =
        section_for(baseline.sections, current, baseline.file);
    if (!section) return tl::unexpected(section.error());
    const CaseSet of_section{to_string((*section)->key), (*section)->plan};
    if (const auto same = check_versions(**section, current); !same) {
      return tl::unexpected(Error{baseline.file, same.error().place, same.error().reason});
    }
    if (set && set->plan != of_section.plan) {
      return tl::unexpected(Error{
          baseline.file, "",
          fmt::format("the sections {} and {} have different cases; run one backend at a time",
                      set->section, of_section.section)});
    }
    set = of_section;
  }
  if (!set) return tl::unexpected(Error{baseline.file, "", "no backend to compare"});
  return *set;
}

}  // namespace rastercheck::gate
