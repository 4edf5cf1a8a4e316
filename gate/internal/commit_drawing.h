#pragma once

// Builds and draws one commit of a bisection and compares it with the good one.

#include <set>
#include <string>
#include <vector>

#include "gate/bisect.h"
#include "gate/internal/outside_command.h"
#include "records/run.h"

namespace rastercheck::gate {

/// Folder names, within the plan's folder, of the bisection's first two commits; other commits use
/// their hash.
inline constexpr const char* kGoodFolder = "good";
inline constexpr const char* kBadFolder = "bad";

/// Builds the checked-out commit and draws with it; keeps both logs and the run in folder `name`.
/// Fails if either step fails; a violated law is not a failure. Ignores the log of `how`.
Result<records::Run> draw_commit(const BisectPlan& plan, const std::string& name, OutsideRun how);

/// Return the path of a drawn commit's run, and the run itself.
std::string run_file(const std::string& folder, const std::string& name);
Result<records::Run> read_drawing(const std::string& folder, const std::string& name);

/// Keeps only the results for these laws, and among them only results for cases that every run with
/// the same seed has (records::is_frozen).
records::Run only_laws(records::Run run, const std::set<std::string>& laws);

/// Returns a --property pattern that matches exactly these laws.
std::string pattern_of(const std::set<std::string>& laws);

/// Compares a run with the good commit's.
Result<std::vector<records::Comparison>> against_good(const records::Run& good,
                                                      records::Run current);

/// Returns the laws of entries that are worse.
std::set<std::string> worse_laws(const std::vector<records::Comparison>& comparisons);

/// The outcome of a commit.
struct JudgedCommit {
  std::string hash;
  CommitVerdict verdict = CommitVerdict::skipped;
  std::string reason;  ///< why the commit is skipped; for a bad one, what is worse
};

/// "ab12cd34ef skipped: …".
std::string judged_text(const JudgedCommit& commit);

/// Saves a plan for judge_commit(): how to build and draw, and which laws to check.
Result<void> write_plan(const BisectPlan& plan);
Result<BisectPlan> read_plan(const std::string& folder);

/// Adds an outcome to the list of outcomes of judge_commit().
Result<void> note(const std::string& folder, const JudgedCommit& commit);
/// Returns all outcomes so far, in order.
std::vector<JudgedCommit> read_judged(const std::string& folder);

}  // namespace rastercheck::gate
