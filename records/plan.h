#pragma once

// The plan of a run: one type for the command line, worker processes, checkpoints, shards,
// run.json, baselines and comparisons.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/capabilities.h"
#include "cases/contract_terms.h"
#include "cases/draw_by.h"
#include "records/shard.h"

namespace rastercheck::records {

/// Seconds that a foreign backend has for one drawing, unless others are given.
inline constexpr double kDefaultTimeout = 10;

/// Gives most defects their 30 drawings in 1,000 cases, for a few percent of what a run costs.
inline constexpr std::uint64_t kUsualPower = 15;

/// How long one counterexample may be made smaller.
struct ShrinkBudget {
  std::uint64_t tries = 1000;     ///< cases checked; 0: it stays as it was found
  std::optional<double> seconds;  ///< what comes of it depends on the machine then
  bool operator==(const ShrinkBudget&) const = default;
};

/// A file that backends are held to, instead of what they promise themselves.
struct ContractFile {
  std::string file;  ///< as the user named it
  cases::ContractTerms terms;
  bool operator==(const ContractFile&) const = default;
};

struct Plan {
  std::uint64_t seed = 0;
  std::uint64_t cases_per_law = 1000;        ///< random ones
  std::vector<std::string> backends{"cpu"};  ///< as asked for
  std::vector<std::string> laws = {};        ///< ids, in the order of tables
  /// The patterns that chose the laws; none: all laws were to be run.
  std::vector<std::string> properties = {};
  std::string scene =
      {};                ///< file of a mesh or a case, which is drawn and judged, too; empty: none
  int scene_size = 512;  ///< width and height of a mesh's picture, pixels
  std::optional<ContractFile> contract = std::nullopt;
  /// What drivers are held to; nothing: what is usual of each.
  std::optional<cases::DriverPromise> promise = std::nullopt;
  /// How drivers that have several ways draw; `frame` is the scene's, drawn with a depth test.
  /// Nothing: each case in the way that takes least.
  std::optional<cases::DrawBy> draw_by = std::nullopt;
  std::string corpus = {};  ///< folder of case files; empty: that which comes with the program
  std::vector<std::string> known = {};  ///< folders and files of lists of known defects
  bool ignores_known = false;           ///< what is known of backends counts as any other violation
  ShrinkBudget shrinking = {};
  /// The drawing of one in so many random cases of two laws is made wrong, to see what is noticed
  /// (properties/campaign/power.h); 0: of none.
  std::uint64_t power = kUsualPower;
  /// How many cases every law has to be judged on, or the run ends as one that checked nothing;
  /// nothing: what is usual (records/summary.h), and the run ends as it does without it.
  std::optional<std::uint64_t> require_cases = std::nullopt;
  bool keeps_cases = false;          ///< whether what each case gave is kept (CaseRecord)
  double timeout = kDefaultTimeout;  ///< seconds that a foreign backend has for one drawing
  /// The part of the work that is done; nothing: all of it.
  std::optional<ShardNumber> shard = std::nullopt;
  /// Holds, for each backend that does not draw every case, what it does draw: its random cases are
  /// made for that. Found before the first case.
  std::map<std::string, cases::Capabilities> capabilities = {};
  bool operator==(const Plan&) const = default;
};

/// Says what a plan's random cases of a backend are made for.
const cases::Capabilities& capabilities_of(const Plan& plan, const std::string& backend);

/// The terms with this promise of drivers in place of their own, if one is given.
std::optional<cases::ContractTerms> with_promise(std::optional<cases::ContractTerms> terms,
                                                 std::optional<cases::DriverPromise> promise);

/// Gives what all backends are held to; nothing where the plan does not say.
std::optional<cases::ContractTerms> terms_of(const Plan& plan);

/// Keeps what decides which cases are frozen and what they are held to: seed, cases, patterns,
/// contract, promise, corpus and known defects. Everything else gets its usual value.
Plan frozen(const Plan& plan);

/// Gives the command-line options of `rastercheck run` that ask for the same, except backends,
/// cases, seed, scene and shard. For people to read and repeat.
std::vector<std::string> option_words(const Plan& plan);
/// Gives those of them that say what backends are held to.
std::vector<std::string> contract_words(const Plan& plan);
/// Gives those options that `rastercheck replay` takes, too.
std::vector<std::string> replay_words(const Plan& plan);

}  // namespace rastercheck::records
