#include "cli/grown_cases.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "cli/corpus_folder.h"
#include "properties/campaign/corpus.h"
#include "properties/inspect/run_cases.h"

namespace rastercheck::cli {
namespace {

/// The case, where there still is one: a corpus may be gone, or be another one.
std::optional<cases::Case> case_of(const reports::Comparison& comparison,
                                   const reports::CaseGrowth& growth) {
  std::vector<cases::Case> corpus;
  if (growth.origin == records::Origin::corpus) {
    Result<std::vector<cases::Case>> read = properties::read_corpus(corpus_of(comparison));
    if (!read) return std::nullopt;
    corpus = *std::move(read);
  }
  std::optional<cases::Case> found = properties::frozen_case(
      {growth.law, comparison.backend, growth.origin, growth.index}, comparison.seed, corpus);
  const bool is_other =
      found && growth.origin == records::Origin::corpus && found->name != growth.name;
  return is_other ? std::nullopt : found;
}

Result<void> save(const reports::Gate& gate, const reports::Comparison& comparison,
                  const reports::CaseGrowth& growth) {
  std::optional<cases::Case> source = case_of(comparison, growth);
  if (!source) return {};
  cases::Case& c = *source;
  c.found = cases::Found{growth.law, comparison.backend, "worse than the baseline", comparison.seed,
                         growth.index};
  const std::filesystem::path file =
      std::filesystem::path(gate.folder) / reports::file_of(comparison, growth);
  std::error_code why;
  std::filesystem::create_directories(file.parent_path(), why);
  if (why) {
    return tl::unexpected(
        Error{file.parent_path().string(), "", "cannot be made: " + why.message()});
  }
  return cases::write_file(file.string(), cases::to_json(c));
}

}  // namespace

std::string corpus_of(const reports::Comparison& comparison) {
  return records::option_of(comparison.options, "--corpus").value_or(corpus_folder());
}

Result<void> save_grown_cases(const reports::Gate& gate) {
  for (const reports::Comparison& comparison : gate.comparisons) {
    for (const reports::CaseGrowth& growth : comparison.growths) {
      if (Result<void> saved = save(gate, comparison, growth); !saved) return saved;
    }
  }
  return {};
}

}  // namespace rastercheck::cli
