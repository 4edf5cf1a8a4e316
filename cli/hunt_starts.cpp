#include "cli/hunt_starts.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "cli/corpus_folder.h"
#include "properties/campaign/corpus.h"
#include "properties/inspect/largest_errors.h"
#include "reports/run_reader.h"

namespace rastercheck::cli {
namespace {

/// The first of these errors whose case still exists, as that case.
std::optional<cases::Case> first_case(const std::vector<properties::RunError>& errors,
                                      const records::Run& run,
                                      const properties::CaseSources& sources) {
  for (const properties::RunError& error : errors) {
    std::optional<cases::Case> found = properties::case_of(error, run.plan, sources);
    if (found) return found;
  }
  return std::nullopt;
}

Result<std::vector<cases::Case>> worst_of_run(const std::string& file, const records::Plan& plan) {
  const Result<records::Run> run = reports::read_run(file);
  if (!run) return tl::unexpected(run.error());
  const Result<std::vector<cases::Case>> corpus =
      properties::corpus_of(run->plan, corpus_folder_of(run->plan));
  if (!corpus) return tl::unexpected(corpus.error());
  properties::CaseSources sources;
  sources.corpus = *corpus;
  const properties::LargestErrors errors = properties::largest_errors(*run);
  const auto is_ours = [&plan](const auto& of_kind) {
    const std::string& backend = std::get<0>(of_kind.first);
    return std::find(plan.backends.begin(), plan.backends.end(), backend) != plan.backends.end();
  };
  const bool has_ours = std::any_of(errors.begin(), errors.end(), is_ours);
  std::vector<cases::Case> worst;
  for (const auto& of_kind : errors) {
    if (has_ours && !is_ours(of_kind)) continue;
    std::optional<cases::Case> found = first_case(of_kind.second, *run, sources);
    // One case may have the largest error of several kinds.
    if (found && std::find(worst.begin(), worst.end(), *found) == worst.end()) {
      worst.push_back(*std::move(found));
    }
  }
  return worst;
}

}  // namespace

Result<std::vector<cases::Case>> read_starts(const std::string& folder, const records::Plan& plan) {
  namespace fs = std::filesystem;
  const std::string hunted = folder + "/worst";
  const std::string run = folder + "/run.json";
  Result<std::vector<cases::Case>> starts;
  if (fs::is_directory(hunted)) {
    starts = properties::read_corpus(hunted);
  } else if (fs::exists(run)) {
    starts = worst_of_run(run, plan);
  } else {
    return tl::unexpected(
        Error{folder, "", "is not the output folder of a hunt (worst/) or a run (run.json)"});
  }
  if (starts && starts->empty()) return tl::unexpected(Error{folder, "", "has no worst case"});
  return starts;
}

}  // namespace rastercheck::cli
