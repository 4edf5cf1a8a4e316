#pragma once

// What `rastercheck run` is asked for, and the plan that comes of it.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/error.h"
#include "cli/gate.h"
#include "cli/shard_option.h"
#include "records/plan.h"
#include "reports/format.h"

namespace rastercheck::cli {

/// What the command line of `rastercheck run` says: what is to be done, and how.
struct RunOptions {
  records::Plan plan;                 ///< but for what is settled by make_plan()
  std::optional<std::uint64_t> seed;  ///< nothing: a random one
  ShardOption shard;
  std::string contract;  ///< file
  std::string output = "rastercheck-out";
  std::vector<std::string> formats = reports::default_format_names();
  std::string baseline;
  std::string policy;
  bool resume = false;
  std::string rerun_failed;  ///< folder of the run whose failures are checked again
  bool fail_fast = false;
  std::optional<double> max_time;  ///< seconds
  int jobs = 1;
  bool json = false;
  bool quiet = false;
};

/// What the options ask for: with the laws that the patterns choose, a seed, the shard's number and
/// the contract, which is read.
Result<records::Plan> make_plan(const RunOptions& options);

/// Takes seed, cases and all that decides what is found from the baseline; refuses another value
/// that was given. Of a corpus or contract that lies elsewhere now, digests tell whether it is the
/// same.
Result<void> take_case_set(const CLI::App& app, const gate::CaseSet& set, RunOptions& options);

/// Takes from the run in the folder `rerun_failed` the laws and backends that were violated, and
/// all that decides what is found: the same cases fail again unless something has changed. Fails
/// where nothing was violated.
Result<void> take_failed(RunOptions& options);

}  // namespace rastercheck::cli
