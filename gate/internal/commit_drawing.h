#pragma once

// One commit of a bisection: built, drawn, and held against the good one.

#include <set>
#include <string>
#include <vector>

#include "gate/bisect.h"
#include "gate/internal/outside_command.h"
#include "records/run.h"

namespace rastercheck::gate {

/// The folders of the two commits that a bisection begins with, below that of the plan; of the
/// others it is their hash.
inline constexpr const char* kGoodFolder = "good";
inline constexpr const char* kBadFolder = "bad";

/// Builds what is checked out and has it drawn; what both say and the run are kept in `name`. Fails
/// where either does; that a law was violated is no failure. The log of `how` is not used.
Result<records::Run> draw_commit(const BisectPlan& plan, const std::string& name, OutsideRun how);

/// The run of a commit that was drawn before, and its file.
std::string run_file(const std::string& folder, const std::string& name);
Result<records::Run> read_drawing(const std::string& folder, const std::string& name);

/// A run as if it had been of these laws only: what it has of frozen cases, and no more.
records::Run only_laws(records::Run run, const std::set<std::string>& laws);

/// A pattern of --property that these laws match, and no others.
std::string pattern_of(const std::set<std::string>& laws);

/// A run against that of the good commit.
Result<std::vector<records::Comparison>> against_good(const records::Run& good,
                                                      records::Run current);

/// The laws of entries that are worse.
std::set<std::string> worse_laws(const std::vector<records::Comparison>& comparisons);

/// What became of a commit.
struct JudgedCommit {
  std::string hash;
  CommitVerdict verdict = CommitVerdict::skipped;
  std::string reason;  ///< why it is skipped; of a bad one what is worse
};

/// "ab12cd34ef skipped: …".
std::string judged_text(const JudgedCommit& commit);

/// Keeps a plan for judge_commit(): how to build and draw, and of which laws.
Result<void> write_plan(const BisectPlan& plan);
Result<BisectPlan> read_plan(const std::string& folder);

/// Adds to those that judge_commit() has judged.
Result<void> note(const std::string& folder, const JudgedCommit& commit);
/// All of them so far, in their order.
std::vector<JudgedCommit> read_judged(const std::string& folder);

}  // namespace rastercheck::gate
