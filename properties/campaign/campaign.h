#pragma once

// A campaign: every chosen law on every chosen backend, over the corpus and over random cases.
//
// It is cut into tasks that depend on nothing but themselves, and what tasks find merges exactly:
// however they are split over processes, and in whatever order they end, the outcome is the same to
// the byte.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/findings.h"
#include "properties/campaign/known_defects.h"
#include "properties/law.h"
#include "records/counterexample.h"
#include "records/plan.h"
#include "records/record.h"
#include "records/run.h"

namespace rastercheck::properties {

/// What is done in a task, in the order in which a campaign does it. `saved` is one saved
/// counterexample checked again, `known` the case of a known defect; `shrink` makes one smaller,
/// whatever it came from.
enum class TaskKind { corpus, saved, known, random, shrink };
constexpr auto names_of(TaskKind /*type*/) {
  return std::to_array<std::string_view>({"corpus", "saved", "known", "random", "shrink"});
}

/// Some cases of one law on one backend: corpus cases, or random ones of the campaign's seed; or a
/// single case of its own.
struct Task {
  std::string backend;  ///< specification
  std::string law;      ///< id
  TaskKind kind = TaskKind::random;
  std::uint64_t first = 0;  ///< index of the first case; of known ones of the entry
  std::uint64_t last = 0;   ///< one past the last
  /// What is checked again or made smaller; its case has `found`.
  std::optional<records::Counterexample> subject = std::nullopt;
  bool operator==(const Task&) const = default;

  /// Cases that it adds to the records.
  std::uint64_t cases() const { return kind == TaskKind::shrink ? 0 : last - first; }
};

/// The limits of making a counterexample smaller, which begins now; `is_to_end` ends it, too. Where
/// the budget gives no seconds they are a minute if the backend hangs at the case.
ShrinkLimits shrink_limits(const records::ShrinkBudget& budget,
                           const records::Counterexample& counterexample,
                           const IsToEnd& is_to_end = {});

/// The campaign's work but for shrinking: the corpus, saved counterexamples of its laws and
/// backends, the cases of what is known of these, random cases; but for laws that are to be
/// skipped. Short tasks, so that processes end together.
///
/// Of a shard those that fall to it: each is in one of all `count` shards, but for saved
/// counterexamples, which only those have that were given any. A law's cases are dealt out like
/// cards, so that shards take about equally long.
std::vector<Task> tasks_of(const records::Plan& plan, std::size_t corpus_size,
                           std::span<const cases::Case> saved = {},
                           const KnownByBackend& known = {});

/// The work that remains when all cases are checked: to shrink what was found and was not yet.
std::vector<Task> shrink_tasks(const Findings& findings);

/// The labels that random cases of a law did not reach often enough (least_reached), in the law's
/// order. What the backend does not promise need not have been reached, and of one with limits
/// nothing.
std::vector<records::UnreachedLabel> unreached_labels(const Law& law,
                                                      const records::BackendPromises& promises,
                                                      const records::RecordSet& records);

/// The same of all laws and backends, by law, backend and label.
std::vector<records::UnreachedLabel> unreached_labels(
    std::span<const std::string> laws, std::span<const records::BackendPromises> backends,
    const records::RecordSet& records);

/// Makes the backends of a plan: held to its contract, and those that are foreign, with its
/// time-out, in processes that a command starts (backends::Isolation); without one in this process.
backends::BackendFactory factory_for(const records::Plan& plan,
                                     const std::vector<std::string>& worker);

/// Runs a plan's tasks, one after the other; keeps the backends it has made.
class TaskRunner {
 public:
  TaskRunner(records::Plan plan, std::vector<cases::Case> corpus, KnownSources known = {},
             backends::BackendFactory backends = {});

  const std::vector<cases::Case>& corpus() const { return corpus_; }

  /// What the task found. Fails where there is no such law, backend or corpus case. When
  /// `is_to_end` says so, shrinking ends with what it has, and checking between two cases: what it
  /// found is then of a part of the task.
  Result<Findings> run(const Task& task, const IsToEnd& is_to_end = {});

  /// Reads what is known of the plan's backends. Fails where one cannot be made, or its list not be
  /// read.
  Result<KnownByBackend> known();

  /// Asks each of the plan's backends what it promises. One that cannot be made any more counts as
  /// promising what every law asks, and as drawing in a way of its own.
  std::vector<records::BackendPromises> promises();
  /// Asks the plan's backends what they draw, and leaves out those that draw every case.
  std::map<std::string, cases::Capabilities> capabilities();
  /// Has it make its random cases for these.
  void make_cases_for(std::map<std::string, cases::Capabilities> capabilities) {
    plan_.capabilities = std::move(capabilities);
  }

 private:
  struct Made {
    std::unique_ptr<backends::Backend> backend;
    std::optional<KnownDefects> known;

    const KnownDefects* known_defects() const { return known ? &*known : nullptr; }
  };
  Result<const Made*> made(const std::string& specification);
  /// A case of a task whose cases are at hand.
  NumberedCase numbered_case(const Task& task, std::uint64_t i) const;

  records::Plan plan_;
  std::vector<cases::Case> corpus_;
  KnownSources known_;
  backends::BackendFactory backends_;
  std::map<std::string, Made> made_;
};

}  // namespace rastercheck::properties
