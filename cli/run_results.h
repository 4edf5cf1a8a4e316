#pragma once

// How `rastercheck run` ends: what it prints, and its exit code.

#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "records/run.h"
#include "records/shard.h"
#include "records/summary.h"

namespace rastercheck::cli {

/// Prints the table of the run, what was not reached, and, unless `quiet`, its counts, its
/// counterexamples, which are saved in the folder `output`, and what else is to be known of it.
void print_results(const records::Run& run, const std::vector<records::LawSummary>& rows,
                   const std::string& output, bool quiet);

/// Of a run without faults, and of backends that promise that much. Where several apply: violated,
/// then nothing checked, of a law or of the scene that was asked for.
ExitCode exit_code_of(const records::Run& run, const std::vector<records::LawSummary>& rows,
                      const std::vector<records::BackendPromises>& promises);
/// Of a shard, which may have nothing to check: violated or ok.
ExitCode exit_code_of_shard(const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::cli
