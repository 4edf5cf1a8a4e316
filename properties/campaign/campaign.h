#pragma once

// A campaign checks every chosen law on every chosen backend, with the corpus and with random
// cases.
//
// A campaign is cut into independent tasks whose findings merge exactly: the outcome is the same to
// the byte, however tasks are split over processes and in whatever order they end.

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

/// The work of a task, in the order in which a campaign does it. `saved` checks a saved
/// counterexample again, `known` checks the case of a known defect, `shrink` shrinks a
/// counterexample from any source.
enum class TaskKind { corpus, saved, known, random, shrink };
constexpr auto names_of(TaskKind /*type*/) {
  return std::to_array<std::string_view>({"corpus", "saved", "known", "random", "shrink"});
}

/// Some cases of one law on one backend: corpus cases, random ones of the campaign's seed, or a
/// single given case.
struct Task {
  std::string backend;  ///< specification
  std::string law;      ///< id
  TaskKind kind = TaskKind::random;
  std::uint64_t first = 0;  ///< index of the first case; for `known`, index of the entry
  std::uint64_t last = 0;   ///< one past the last
  /// The counterexample to check again or to shrink; its case must have `found`.
  std::optional<records::Counterexample> subject = std::nullopt;
  bool operator==(const Task&) const = default;

  /// Number of cases that the task adds to the records.
  std::uint64_t cases() const { return kind == TaskKind::shrink ? 0 : last - first; }
};

/// Returns the limits for shrinking a counterexample, counted from now. Shrinking also ends when
/// `is_to_end` returns true. If the budget sets no seconds and the backend hangs on the case, the
/// limit is one minute.
ShrinkLimits shrink_limits(const records::ShrinkBudget& budget,
                           const records::Counterexample& counterexample,
                           const IsToEnd& is_to_end = {});

/// Returns the campaign's tasks except shrinking: the corpus, saved counterexamples of its laws and
/// backends, cases of known defects, random cases. Leaves out laws that are to be skipped. Tasks
/// are short, so that processes end at about the same time.
///
/// A shard gets its own part: each task belongs to exactly one of the plan's shards. A law's cases
/// are dealt out like cards, so that shards take about equally long. Only saved counterexamples are
/// not divided: a shard checks all that it is given.
std::vector<Task> tasks_of(const records::Plan& plan, std::size_t corpus_size,
                           std::span<const cases::Case> saved = {},
                           const KnownByBackend& known = {});

/// Returns the tasks that remain after checking: one for each counterexample not yet shrunk.
std::vector<Task> shrink_tasks(const Findings& findings);

/// Returns the labels that random cases of a law reached too seldom (least_reached), in the law's
/// order. Leaves out labels that depend on a promise the backend does not make. Returns none for a
/// backend with limits.
std::vector<records::UnreachedLabel> unreached_labels(const Law& law,
                                                      const records::BackendPromises& promises,
                                                      const records::RecordSet& records);

/// unreached_labels() of all laws and backends, ordered by law, backend and label.
std::vector<records::UnreachedLabel> unreached_labels(
    std::span<const std::string> laws, std::span<const records::BackendPromises> backends,
    const records::RecordSet& records);

/// Returns a factory of a plan's backends, which holds them to the plan's contract. Foreign
/// backends run with the plan's time-out in processes started by the command `worker`
/// (backends::Isolation), or in this process if `worker` is empty.
backends::BackendFactory factory_for(const records::Plan& plan,
                                     const std::vector<std::string>& worker);

/// Runs a plan's tasks one after the other, and reuses backends once made.
class TaskRunner {
 public:
  TaskRunner(records::Plan plan, std::vector<cases::Case> corpus, KnownSources known = {},
             backends::BackendFactory backends = {});

  const std::vector<cases::Case>& corpus() const { return corpus_; }

  /// Runs a task and returns its findings. Fails if law, backend or corpus case do not exist. If
  /// `is_to_end` returns true, shrinking ends with its best case so far, and checking ends after
  /// the current case, with findings for a part of the task.
  Result<Findings> run(const Task& task, const IsToEnd& is_to_end = {});

  /// Reads the known defects of the plan's backends. Fails if a backend cannot be made or its list
  /// cannot be read.
  Result<KnownByBackend> known();

  /// Asks each of the plan's backends for its promises. A backend that can no longer be made counts
  /// as making every promise that a law needs, except draws_what_is_asked_for().
  std::vector<records::BackendPromises> promises();
  /// Asks the plan's backends for their capabilities; leaves out backends that draw every case.
  std::map<std::string, cases::Capabilities> capabilities();
  /// Sets the capabilities for which random cases are made.
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
  /// Returns case i of a task that is not random.
  NumberedCase numbered_case(const Task& task, std::uint64_t i) const;

  records::Plan plan_;
  std::vector<cases::Case> corpus_;
  KnownSources known_;
  backends::BackendFactory backends_;
  std::map<std::string, Made> made_;
};

}  // namespace rastercheck::properties
