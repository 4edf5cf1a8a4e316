#pragma once

// The plan of a run: one type for the command line, worker processes, checkpoints, shards,
// run.json, baselines and comparisons.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/capabilities.h"
#include "cases/case.h"
#include "cases/contract_terms.h"
#include "cases/draw_by.h"
#include "records/shard.h"

namespace rastercheck::records {

/// Default time limit of a foreign backend for one drawing, seconds.
inline constexpr double kDefaultTimeout = 10;

/// Default of Plan::power: gives most defects 30 drawings in 1,000 cases and costs a few percent of
/// a run.
inline constexpr std::uint64_t kUsualPower = 15;

/// Limits the shrinking of one counterexample.
struct ShrinkBudget {
  std::uint64_t tries = 1000;     ///< the most cases that are checked; 0: no shrinking
  std::optional<double> seconds;  ///< a time limit, which makes the result depend on the machine
  bool operator==(const ShrinkBudget&) const = default;
};

/// A contract file that replaces the backends' own promises.
struct ContractFile {
  std::string file;  ///< as the user named it
  cases::ContractTerms terms;
  bool operator==(const ContractFile&) const = default;
};

struct Plan {
  std::uint64_t seed = 0;
  std::uint64_t cases_per_law = 1000;        ///< number of random cases
  std::vector<std::string> backends{"cpu"};  ///< specifications, as the user gave them
  std::vector<std::string> laws = {};        ///< ids, in the order of tables
  /// The patterns that chose the laws; empty: all laws.
  std::vector<std::string> properties = {};
  std::string scene = {};  ///< file of a mesh or a case to draw and judge as well; empty: none
  int scene_size = 512;    ///< width and height of a mesh's picture, pixels
  std::optional<ContractFile> contract = std::nullopt;
  /// The promise that drivers are held to; empty: each driver's default.
  std::optional<cases::DriverPromise> promise = std::nullopt;
  /// The way of drawing for drivers that have several; `frame` draws cases as a scene is drawn,
  /// with a depth test. Empty: the cheapest way for each case.
  std::optional<cases::DrawBy> draw_by = std::nullopt;
  std::string corpus = {};  ///< folder of case files; empty: the corpus shipped with the program
  /// Worst cases of hunts, which a baseline keeps; checked as the last cases of the corpus.
  std::vector<cases::Case> hunted = {};
  std::vector<std::string> known = {};  ///< folders and files of lists of known defects
  bool ignores_known = false;           ///< known defects count as any other violation
  ShrinkBudget shrinking = {};
  /// One in this many random cases of two laws gets a wrong drawing, to measure which defects laws
  /// notice (properties/campaign/power.h); 0: none.
  std::uint64_t power = kUsualPower;
  /// Least number of cases on which each law must be judged; if a law misses this number, the run
  /// ends as if it had checked nothing. Empty: the usual number (records/summary.h), which does not
  /// affect how the run ends.
  std::optional<std::uint64_t> require_cases = std::nullopt;
  bool keeps_cases = false;          ///< true if each case's result is kept (CaseRecord)
  double timeout = kDefaultTimeout;  ///< limit of a foreign backend for one drawing, seconds
  /// The part of the work to do; empty: all.
  std::optional<ShardNumber> shard = std::nullopt;
  /// The capabilities of each backend that cannot draw every case; its random cases are made to
  /// fit. Determined before the first case.
  std::map<std::string, cases::Capabilities> capabilities = {};
  bool operator==(const Plan&) const = default;
};

/// Returns the capabilities that a backend's random cases are made to fit.
const cases::Capabilities& capabilities_of(const Plan& plan, const std::string& backend);

/// Returns the terms, with the drivers' promise replaced if one is given.
std::optional<cases::ContractTerms> with_promise(std::optional<cases::ContractTerms> terms,
                                                 std::optional<cases::DriverPromise> promise);

/// Returns the terms that all backends are held to; empty if the plan sets none.
std::optional<cases::ContractTerms> terms_of(const Plan& plan);

/// Keeps the members that decide which cases a baseline has and how they are judged: seed, cases,
/// patterns, capabilities, contract, promise, way of drawing, corpus, worst cases of hunts, known
/// defects and power.
/// Empties `backends`; all other members get their default.
Plan frozen(const Plan& plan);

/// Returns the options of `rastercheck run` that reproduce the plan, except backends, cases, seed,
/// scene and shard. For people to read and repeat.
std::vector<std::string> option_words(const Plan& plan);
/// Returns the subset of option_words() that sets what backends are held to.
std::vector<std::string> contract_words(const Plan& plan);
/// Returns the subset of option_words() that `rastercheck replay` accepts too.
std::vector<std::string> replay_words(const Plan& plan);

}  // namespace rastercheck::records
