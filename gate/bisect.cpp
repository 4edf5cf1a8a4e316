#include "gate/bisect.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

#include "cases/json.h"
#include "gate/hold.h"
#include "gate/internal/bisect_folder.h"
#include "gate/internal/commit_drawing.h"
#include "gate/internal/git.h"
#include "reports/bisect_text.h"
#include "reports/run_reader.h"
#include "reports/write.h"

namespace rastercheck::gate {
namespace {

tl::unexpected<Error> refused_because(const std::string& place, const std::string& reason) {
  return tl::unexpected(Error{place, "", reason});
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The commits to search between, and the original checkout.
struct History {
  std::string good;  ///< hash
  std::string bad;   ///< hash
  std::string head;  ///< branch or hash
  std::uint64_t commits = 0;
};

/// Refuses a work tree with changes or with a bisection in progress.
Result<void> check_work_tree(const Git& git) {
  const Result<bool> is_bisecting = git.has_file("BISECT_LOG");
  if (!is_bisecting) return tl::unexpected(is_bisecting.error());
  if (*is_bisecting) {
    return refused_because("git bisect",
                           "a bisection is in progress here; end it with `git bisect reset`");
  }
  const Result<std::string> changed = git.changed_files();
  if (!changed) return tl::unexpected(changed.error());
  if (changed->empty()) return {};
  const std::vector<std::string> files = lines_of(*changed);
  return refused_because(
      "git status",
      fmt::format("the work tree has uncommitted changes ({} file{}, first '{}'); commit or stash "
                  "them first, because bisecting checks out other commits",
                  files.size(), files.size() == 1 ? "" : "s", cases::printable(files.front())));
}

Result<History> check_history(const Git& git, const BisectPlan& plan) {
  if (const Result<void> tree = check_work_tree(git); !tree) return tl::unexpected(tree.error());
  const Result<std::string> good = git.commit(plan.good);
  if (!good) return tl::unexpected(good.error());
  const Result<std::string> bad = git.commit(plan.bad);
  if (!bad) return tl::unexpected(bad.error());
  if (*good == *bad) return refused_because(plan.bad, "is the same commit as " + plan.good);
  const Result<std::string> base = git.ask({"merge-base", *good, *bad});
  if (!base || *base != *good) {
    return refused_because(plan.good,
                           fmt::format("is not an ancestor of {}{}", plan.bad,
                                       base ? "; their common ancestor is " + *base : ""));
  }
  const Result<std::string> commits = git.ask({"rev-list", "--count", *good + ".." + *bad});
  if (!commits) return tl::unexpected(commits.error());
  const Result<std::string> head = git.head();
  if (!head) return tl::unexpected(head.error());
  History history{*good, *bad, *head, 0};
  std::from_chars(commits->data(), commits->data() + commits->size(), history.commits);
  return history;
}

/// Restores the original checkout.
Result<void> check_out_head(const Git& git, const std::string& head) {
  const Result<bool> is_bisecting = git.has_file("BISECT_LOG");
  if (!is_bisecting.value_or(false)) return git.check_out(head);
  return git.ask({"bisect", "reset", head}).map([](const auto&) {});
}

/// Restores the original checkout. Moves changes to tracked files into git's stash: the build made
/// them, as the work tree had none before.
Result<void> restore(const Git& git, const std::string& head, const BisectWatch& watch) {
  if (const Result<std::string> changed = git.changed_files(); changed && !changed->empty()) {
    const Result<std::string> kept =
        git.ask({"stash", "push", "--quiet", "-m", "rastercheck bisect"});
    if (kept)
      watch.report("BUILD changed tracked files; the changes are stashed (see git stash list)");
  }
  return check_out_head(git, head).map_error([&](const Error& error) {
    return Error{error.file, "", fmt::format("cannot check out {} again: {}", head, error.reason)};
  });
}

class Bisection {
 public:
  Bisection(const BisectPlan& plan, const BisectWatch& watch, const Git& git,
            const History& history)
      : plan_(plan), watch_(watch), git_(git), history_(history) {}

  Result<records::BisectOutcome> search();

 private:
  Result<void> name_ends();
  /// Checks out, builds and draws a commit.
  Result<records::Run> draw(const std::string& commit, const char* folder,
                            const std::string& name) const;
  /// Finds the laws that are worse in `bad` and narrows the plan to them.
  Result<void> judge_ends();
  Result<void> narrow(records::Run good);
  /// Lets git search between the good and the bad commit.
  Result<void> run_git();
  /// Takes `bad` as the first worse commit.
  void take_bad();
  /// Takes the candidates for the first worse commit once git has ended.
  Result<void> take_first();
  void report_judged();

  BisectPlan plan_;
  const BisectWatch& watch_;
  const Git& git_;
  const History& history_;
  records::BisectOutcome outcome_;
  std::size_t reported_ = 0;
};

Result<records::BisectOutcome> Bisection::search() {
  outcome_.commits = history_.commits;
  outcome_.good_run = run_file(plan_.folder, kGoodFolder);
  Result<void> done = name_ends().and_then([this] { return judge_ends(); });
  if (done && !outcome_.of_bad.empty() && refused(outcome_.of_bad) != 0) {
    if (history_.commits == 1) {
      outcome_.first = {outcome_.bad};
      take_bad();
    } else {
      done = run_git();
    }
  }
  outcome_.is_interrupted = watch_.is_to_end();
  if (!done && !outcome_.is_interrupted) return tl::unexpected(done.error());
  return std::move(outcome_);
}

Result<void> Bisection::name_ends() {
  const Result<records::CommitTitle> good = git_.title(history_.good);
  if (!good) return tl::unexpected(good.error());
  const Result<records::CommitTitle> bad = git_.title(history_.bad);
  if (!bad) return tl::unexpected(bad.error());
  outcome_.good = *good;
  outcome_.bad = *bad;
  return {};
}

Result<records::Run> Bisection::draw(const std::string& commit, const char* folder,
                                     const std::string& name) const {
  if (const Result<void> out = git_.check_out(commit); !out) return tl::unexpected(out.error());
  OutsideRun how;
  how.is_to_end = watch_.is_to_end;
  Result<records::Run> run = draw_commit(plan_, folder, how);
  const Result<std::string> changed = git_.changed_files();
  if (run && changed && !changed->empty()) {
    return refused_because(
        name, "BUILD changes tracked files: " + cases::printable(lines_of(*changed).front()));
  }
  return run.map_error([&](const Error& error) { return Error{name, "", to_string(error)}; });
}

Result<void> Bisection::judge_ends() {
  Result<records::Run> good = draw(history_.good, kGoodFolder, plan_.good);
  if (!good) return tl::unexpected(good.error());
  watch_.report(judged_text({history_.good, CommitVerdict::good, "others are compared with it"}));
  Result<records::Run> bad = draw(history_.bad, kBadFolder, plan_.bad);
  if (!bad) return tl::unexpected(bad.error());
  Result<std::vector<records::Comparison>> comparisons = against_good(*good, *std::move(bad));
  if (!comparisons) {
    return refused_because(plan_.bad, to_string(comparisons.error()));
  }
  outcome_.tried = 2;
  outcome_.of_bad = *std::move(comparisons);
  const std::uint64_t worse = refused(outcome_.of_bad);
  if (worse == 0) return {};
  watch_.report(judged_text({history_.bad, CommitVerdict::bad, reports::worse_text(worse)}));
  return narrow(*std::move(good));
}

Result<void> Bisection::narrow(records::Run good) {
  const std::set<std::string> laws = worse_laws(outcome_.of_bad);
  plan_.plan.properties = {pattern_of(laws)};
  if (const Result<void> kept = write_plan(plan_); !kept) return kept;
  return reports::write_reports(only_laws(std::move(good), laws), plan_.folder + "/" + kGoodFolder,
                                std::vector<std::string>{"json"});
}

void Bisection::report_judged() {
  const std::vector<JudgedCommit> all = read_judged(plan_.folder);
  for (; reported_ < all.size(); ++reported_) watch_.report(judged_text(all[reported_]));
}

Result<void> Bisection::run_git() {
  const auto is_to_end = [this] {
    report_judged();
    return watch_.is_to_end();
  };
  std::vector<std::string> run{"bisect", "run"};
  run.insert(run.end(), plan_.step.begin(), plan_.step.end());
  run.push_back(plan_.folder);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"bisect", "start", history_.bad, history_.good}, run}) {
    const Result<cases::ProcessEnd> end = git_.run(words, is_to_end);
    if (!end) return tl::unexpected(end.error());
    if (is_to_end()) return {};
  }
  return take_first();
}

void Bisection::take_bad() {
  outcome_.of_first = outcome_.of_bad;
  outcome_.first_run = run_file(plan_.folder, kBadFolder);
}

Result<void> Bisection::take_first() {
  const Result<std::string> left =
      git_.ask({"rev-list", "refs/bisect/bad", "--not", "--glob=refs/bisect/good-*"});
  if (!left) return tl::unexpected(left.error());
  std::set<std::string> skipped;
  for (const JudgedCommit& commit : read_judged(plan_.folder)) {
    const bool is_skipped = commit.verdict == CommitVerdict::skipped;
    if (is_skipped) skipped.insert(commit.hash);
    ++(is_skipped ? outcome_.skipped : outcome_.tried);
  }
  const std::vector<std::string> hashes = lines_of(*left);
  for (const std::string& hash : hashes) {
    if (hash != hashes.front() && !skipped.contains(hash)) {
      return refused_because("git bisect run", git_.last_said());
    }
    const Result<records::CommitTitle> title = git_.title(hash);
    if (!title) return tl::unexpected(title.error());
    outcome_.first.push_back(*title);
  }
  if (hashes.size() != 1) return {};
  if (hashes.front() == history_.bad) {
    take_bad();
    return {};
  }
  outcome_.first_run = run_file(plan_.folder, hashes.front());
  const Result<records::Run> good = read_drawing(plan_.folder, kGoodFolder);
  if (!good) return tl::unexpected(good.error());
  return read_drawing(plan_.folder, hashes.front())
      .and_then([&](records::Run run) { return against_good(*good, std::move(run)); })
      .map([this](std::vector<records::Comparison> comparisons) {
        outcome_.of_first = std::move(comparisons);
      });
}

/// Builds and draws the checked-out commit and compares it with the good one.
Result<JudgedCommit> judged(const BisectPlan& plan, const std::string& hash) {
  const Result<records::Run> good = read_drawing(plan.folder, kGoodFolder);
  if (!good) return tl::unexpected(good.error());
  JudgedCommit commit{hash, CommitVerdict::skipped, ""};
  OutsideRun how;
  how.group = cases::ProcessGroup::of_parent;  // so that one signal ends both processes
  const auto comparisons = draw_commit(plan, hash, how).and_then([&](records::Run run) {
    return against_good(*good, std::move(run));
  });
  if (!comparisons) {
    commit.reason = to_string(comparisons.error());
    return commit;
  }
  const std::uint64_t worse = refused(*comparisons);
  commit.verdict = worse == 0 ? CommitVerdict::good : CommitVerdict::bad;
  if (worse != 0) commit.reason = reports::worse_text(worse);
  return commit;
}

/// Finds the commits to search between; afterwards the plan's files are copies that no checkout
/// changes.
Result<History> prepare(const Git& git, const BisectFolder& folder, BisectPlan& plan) {
  Result<History> history = check_history(git, plan);
  if (!history) return history;
  Result<records::Plan> copied = folder.with_copies(plan.plan, ".");
  if (!copied) return tl::unexpected(copied.error());
  plan.plan = *std::move(copied);
  return history;
}

}  // namespace

Result<std::string> work_tree_of(const std::string& folder) {
  constexpr std::uint64_t kMostOutput = 1 << 16;
  const Result<cases::ChildOutcome> answer =
      cases::run_child({"git", "-C", folder, "rev-parse", "--show-toplevel"}, kMostOutput);
  if (!answer) return tl::unexpected(answer.error());
  const std::vector<std::string> lines = lines_of(answer->output);
  if (answer->end.exit_code == 0 && lines.size() == 1) return lines.front();
  return refused_because(folder, "is not in a git work tree");
}

Result<records::BisectOutcome> bisect(BisectPlan plan, const BisectWatch& watch) {
  const Result<BisectFolder> folder = BisectFolder::make(plan.folder);
  if (!folder) return tl::unexpected(folder.error());
  plan.folder = folder->path();
  const Git git(plan.folder);
  const Result<History> history = prepare(git, *folder, plan);
  if (!history) {
    folder->discard();
    return tl::unexpected(history.error());
  }
  Result<records::BisectOutcome> outcome = Bisection(plan, watch, git, *history).search();
  if (const Result<void> restored = restore(git, history->head, watch); !restored) {
    return tl::unexpected(restored.error());
  }
  return outcome;
}

int judge_commit(const std::string& folder, const DrawPlan& draw) {
  // Exit codes for `git bisect run`; any code above 127 ends the bisection.
  constexpr int kSkip = 125;
  constexpr int kEnd = 128;
  Result<BisectPlan> plan = read_plan(folder);
  if (!plan) return kEnd;
  plan->draw = draw;
  const Result<std::string> hash = Git(folder).commit("HEAD");
  if (!hash) return kEnd;
  const Result<JudgedCommit> commit = judged(*plan, *hash);
  if (!commit || !note(folder, *commit)) return kEnd;
  if (commit->verdict == CommitVerdict::skipped) return kSkip;
  return commit->verdict == CommitVerdict::bad ? 1 : 0;
}

Result<void> save_comparison(const BisectPlan& plan, records::BisectOutcome& outcome,
                             const std::string& corpus) {
  const Result<records::Run> good = reports::read_run(outcome.good_run);
  if (!good) return tl::unexpected(good.error());
  const Result<records::Run> first = reports::read_run(outcome.first_run);
  if (!first) return tl::unexpected(first.error());
  outcome.comparison = plan.folder + "/comparison";
  reports::Gate gate;
  gate.comparisons = outcome.of_first;
  gate.baseline_file = plan.good;
  gate.current_file = outcome.first.front().hash;
  gate.folder = outcome.comparison;
  gate.before_run = &*good;
  gate.after_run = &*first;
  return write_files(gate, corpus);
}

}  // namespace rastercheck::gate
