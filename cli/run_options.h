#pragma once

// What `rastercheck run` is asked for, and the plan that comes of it.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/error.h"
#include "cli/gate.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/shard_option.h"
#include "properties/campaign/checkpoint.h"
#include "reports/format.h"

namespace rastercheck::cli {

/// What the command line of `rastercheck run` says.
struct RunOptions {
  std::vector<std::string> backends{"cpu"};
  std::vector<std::string> properties{"*"};
  std::uint64_t cases = 1000;
  std::optional<std::uint64_t> seed;
  ShardOption shard;
  std::string scene;
  int scene_size = 512;
  std::string contract;
  std::string corpus;
  KnownOption known;
  std::string output = "rastercheck-out";
  std::vector<std::string> formats = reports::default_format_names();
  std::uint64_t shrink_tries = properties::ShrinkBudget().tries;
  std::optional<double> shrink_seconds;
  double timeout = kDefaultTimeout;
  bool keeps_cases = false;
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

/// What the options ask for.
Result<properties::RunPlan> plan_of(const RunOptions& options);

/// Takes seed, cases and all that decides what is found from the baseline; refuses another value
/// that was given. Of a corpus or contract that lies elsewhere now, digests tell whether it is the
/// same.
Result<void> take_case_set(const CLI::App& app, const gate::CaseSet& set, RunOptions& options);

/// Takes from the run in the folder `rerun_failed` the laws and backends that were violated, and
/// all that decides what is found: the same cases fail again unless something has changed. Fails
/// where nothing was violated.
Result<void> take_failed(RunOptions& options);

}  // namespace rastercheck::cli
