#pragma once

// `rastercheck bisect`: the first commit of a user's repository whose drawing is less precise, by
// `git bisect run`. What makes the backend is the user's command, what judges is this program.
//
// GOOD is drawn first and is what all others are held against (compare.h); then BAD, which says
// what to look for: the laws whose figures grew. git then has a commit after the other checked out,
// built and held against GOOD by judge_commit(), in a process of its own. A commit that cannot be
// built or judged is skipped.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "records/bisection.h"
#include "records/plan.h"
#include "records/run.h"

namespace rastercheck::gate {

/// Carries out a plan, whose laws are still to be chosen by its patterns, in a folder that is there
/// and by so many processes, until `is_to_end`.
using DrawPlan =
    std::function<Result<records::Run>(const records::Plan& plan, const std::string& folder,
                                       int jobs, const std::function<bool()>& is_to_end)>;

struct BisectPlan {
  std::string good;                ///< what names the commit to hold others against
  std::string bad;                 ///< what names a later one that is worse
  std::vector<std::string> build;  ///< the command that makes what is judged
  /// The rastercheck that draws and judges, where that is what is built; empty: `draw` does.
  std::string program;
  DrawPlan draw;  ///< used where `program` is empty
  /// Says what to draw of each commit. Files and folders that it names are taken as they are now,
  /// whatever is checked out; corpus and known defects are named, unless the latter are ignored.
  records::Plan plan;
  int jobs = 1;
  /// This program with its hidden command, which is given a folder and calls judge_commit().
  std::vector<std::string> step;
  /// The folder for all that is drawn and said, which is to be empty or not there, and stays so
  /// where nothing is drawn; without a name a temporary one.
  std::string folder;
};

/// What is to be known of a bisection while it goes on.
struct BisectWatch {
  std::function<bool()> is_to_end;                 ///< asked several times a second
  std::function<void(const std::string&)> report;  ///< called for each commit, with one line
};

enum class CommitVerdict { good, bad, skipped };
constexpr auto names_of(CommitVerdict /*type*/) {
  return std::to_array<std::string_view>({"good", "bad", "skipped"});
}
constexpr std::string_view to_string(CommitVerdict verdict) { return cases::name_of(verdict); }

/// The top folder of the work tree that a folder is in; fails where it is in none.
Result<std::string> work_tree_of(const std::string& folder);

/// Bisects the repository whose top folder is the current one. Refuses what is no history to
/// search, and a work tree with changes or in which a bisection goes on; whatever happens after
/// that, what was checked out is checked out again.
Result<records::BisectOutcome> bisect(BisectPlan plan, const BisectWatch& watch);

/// Saves what the first commit is worse in, with the cases that grew, in a folder of the plan's,
/// which the outcome is told. `corpus` is the folder of the cases that come first.
Result<void> save_comparison(const BisectPlan& plan, records::BisectOutcome& outcome,
                             const std::string& corpus);

/// What `git bisect run` is told of the commit that is checked out, as an exit code: 0 no worse, 1
/// worse, 125 not to be judged, 128 that something is wrong with the bisection itself.
int judge_commit(const std::string& folder, const DrawPlan& draw);

}  // namespace rastercheck::gate
