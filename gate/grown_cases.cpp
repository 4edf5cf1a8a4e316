#include "gate/grown_cases.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "properties/campaign/corpus.h"
#include "properties/inspect/run_cases.h"

namespace rastercheck::gate {
namespace {

/// Returns the case if it still exists: a corpus may be gone or replaced.
std::optional<cases::Case> case_of(const records::Comparison& comparison,
                                   const records::CaseGrowth& growth,
                                   const std::string& corpus_folder) {
  std::vector<cases::Case> corpus;
  if (growth.origin == records::Origin::corpus) {
    Result<std::vector<cases::Case>> read =
        properties::corpus_of(comparison.plan, corpus_folder_of(comparison, corpus_folder));
    if (!read) return std::nullopt;
    corpus = *std::move(read);
  }
  std::optional<cases::Case> found = properties::frozen_case(
      {growth.law, comparison.backend, growth.origin, growth.index}, comparison.plan, corpus);
  const bool is_other =
      found && growth.origin == records::Origin::corpus && found->name != growth.name;
  return is_other ? std::nullopt : found;
}

Result<void> save(const reports::Gate& gate, const records::Comparison& comparison,
                  const records::CaseGrowth& growth, const std::string& corpus_folder) {
  std::optional<cases::Case> source = case_of(comparison, growth, corpus_folder);
  if (!source) return {};
  cases::Case& c = *source;
  c.found = cases::Found{growth.law, comparison.backend, "worse than the baseline",
                         comparison.plan.seed, growth.index};
  const std::filesystem::path file =
      std::filesystem::path(gate.folder) / reports::file_of(comparison, growth);
  std::error_code why;
  std::filesystem::create_directories(file.parent_path(), why);
  if (why) {
    return tl::unexpected(
        Error{file.parent_path().string(), "", "cannot be created: " + why.message()});
  }
  return cases::write_file(file.string(), cases::to_json(c));
}

}  // namespace

std::string corpus_folder_of(const records::Comparison& comparison,
                             const std::string& without_option) {
  return comparison.plan.corpus.empty() ? without_option : comparison.plan.corpus;
}

Result<void> save_grown_cases(const reports::Gate& gate, const std::string& corpus) {
  for (const records::Comparison& comparison : gate.comparisons) {
    for (const records::CaseGrowth& growth : comparison.growths) {
      if (Result<void> saved = save(gate, comparison, growth, corpus); !saved) return saved;
    }
  }
  return {};
}

}  // namespace rastercheck::gate
