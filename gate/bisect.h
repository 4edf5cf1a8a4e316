#pragma once

// `rastercheck bisect`: uses `git bisect run` to find the first commit of a user's repository whose
// drawing is less precise. The user's command builds the backend, this program judges.
//
// Draws GOOD first, which is the reference for all other commits (compare.h). Then draws BAD, which
// determines what to look for: the laws whose figures grew. git then checks out one commit after
// the other; judge_commit() builds each and compares it with GOOD, in a separate process. A commit
// that cannot be built or judged is skipped.

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

/// Runs a plan in an existing folder with `jobs` processes, and ends early once `is_to_end` returns
/// true. The plan names laws by patterns only; the callee expands them.
using DrawPlan =
    std::function<Result<records::Run>(const records::Plan& plan, const std::string& folder,
                                       int jobs, const std::function<bool()>& is_to_end)>;

struct BisectPlan {
  std::string good;                ///< names the reference commit
  std::string bad;                 ///< names a later, worse commit
  std::vector<std::string> build;  ///< the command that builds the backend to judge
  /// The rastercheck program that draws and judges, if the build makes one; empty: uses `draw`.
  std::string program;
  DrawPlan draw;  ///< used if `program` is empty
  /// The plan to draw for each commit. Files and folders named here are taken in their present
  /// state, whatever is checked out. The corpus must be named, and so must known defects unless
  /// ignored.
  records::Plan plan;
  int jobs = 1;
  /// This program with its hidden command, which takes a folder and calls judge_commit().
  std::vector<std::string> step;
  /// Output folder. Must be empty or absent; left untouched if nothing is drawn. Empty name: a
  /// temporary folder.
  std::string folder;
};

/// Callbacks during a bisection.
struct BisectWatch {
  std::function<bool()> is_to_end;                 ///< asked several times a second
  std::function<void(const std::string&)> report;  ///< called for each commit, with one line
};

enum class CommitVerdict { good, bad, skipped };
constexpr auto names_of(CommitVerdict /*type*/) {
  return std::to_array<std::string_view>({"good", "bad", "skipped"});
}
constexpr std::string_view to_string(CommitVerdict verdict) { return cases::name_of(verdict); }

/// Returns the top folder of the work tree around a folder; fails if there is none.
Result<std::string> work_tree_of(const std::string& folder);

/// Bisects the repository whose top folder is the current folder. Refuses commits without a history
/// to search, and a work tree with changes or a bisection in progress. Whatever happens afterwards,
/// the original checkout is restored.
Result<records::BisectOutcome> bisect(BisectPlan plan, const BisectWatch& watch);

/// Saves the comparison of the first worse commit, with the grown cases, in a subfolder of the
/// plan's folder, and records that folder in the outcome. `corpus` is the folder of the corpus.
Result<void> save_comparison(const BisectPlan& plan, records::BisectOutcome& outcome,
                             const std::string& corpus);

/// Judges the checked-out commit for `git bisect run` and returns an exit code: 0 no worse, 1
/// worse, 125 cannot be judged, 128 the bisection itself failed.
int judge_commit(const std::string& folder, const DrawPlan& draw);

}  // namespace rastercheck::gate
