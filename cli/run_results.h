#pragma once

// The end of `rastercheck run`: its printed results and its exit code.

#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "records/run.h"
#include "records/shard.h"
#include "records/summary.h"

namespace rastercheck::cli {

/// The help of --all.
inline constexpr const char* kAllHelp = "Print a row for each property, including those that held";

/// How much print_results() prints.
enum class Detail {
  rows,     ///< the table's rows, and the labels that too few cases reached
  summary,  ///< rows that need a look, counts, causes, and the verdict last
  all,      ///< like `summary`, but with all rows
};

/// The detail that the options --quiet and --all ask for.
Detail detail_of(bool quiet, bool all);

/// Prints a run's results; the folder `output` holds its counterexamples.
void print_results(const records::Run& run, const std::vector<records::LawSummary>& rows,
                   const std::string& output, Detail detail);

/// Returns the exit code of a run without faults, given what its backends promise. `violated` takes
/// precedence over `nothing_checked`, which means that a law or the requested scene checked too
/// little.
ExitCode exit_code_of(const records::Run& run, const std::vector<records::LawSummary>& rows,
                      const std::vector<records::BackendPromises>& promises);
/// Returns the exit code of a shard, which may have nothing to check: violated or ok.
ExitCode exit_code_of_shard(const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::cli
