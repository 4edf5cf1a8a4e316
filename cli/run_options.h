#pragma once

// The options of `rastercheck run`, and the plan made from them.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cases/error.h"
#include "cli/gate.h"
#include "cli/shard_option.h"
#include "records/plan.h"
#include "reports/format.h"

namespace rastercheck::cli {

/// The command line of `rastercheck run`.
struct RunOptions {
  records::Plan plan;                 ///< without the members that make_plan() sets
  std::optional<std::uint64_t> seed;  ///< empty: a random one
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
  bool all = false;  ///< prints a row for each law
};

/// The plan that the options ask for, complete with the laws chosen by patterns, a seed, the
/// shard's number and the contract read from its file.
Result<records::Plan> make_plan(const RunOptions& options);

/// True if the user gave a value for an option, such as "--seed".
using IsGiven = std::function<bool(const char* option)>;

/// Adopts the corpus, the contract and the other terms by which the baseline's cases are judged;
/// fails if the user gave different ones.
Result<void> take_terms(const IsGiven& is_given, const gate::CaseSet& set, RunOptions& options);

/// Checks that the plan's contract, read from its file, equals the baseline's, before the work
/// rather than after it.
Result<void> check_contract(const gate::CaseSet& set, const records::Plan& plan);

/// Adopts, besides the terms, the baseline's seed, cases and every other setting that affects the
/// findings; fails if the user gave a different value. If the corpus or contract has moved,
/// compares digests to tell whether the content is the same.
Result<void> take_case_set(const IsGiven& is_given, const gate::CaseSet& set, RunOptions& options);

/// Adopts, from the run in the folder `rerun_failed`, the violated laws and backends and every
/// setting that affects the findings: the same cases fail again unless something has changed. Fails
/// if nothing was violated.
Result<void> take_failed(RunOptions& options);

}  // namespace rastercheck::cli
