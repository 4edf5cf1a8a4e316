#include "properties/campaign/campaign.h"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

#include "backends/factory.h"
#include "backends/isolation.h"
#include "properties/campaign/internal/explanation.h"
#include "properties/campaign/power.h"
#include "properties/campaign/side_by_side.h"
#include "properties/draw.h"
#include "properties/fitted_case.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;

/// Cases in a small task: at most a few seconds of work, so that processes end at about the same
/// time.
constexpr std::uint64_t kCasesPerTask = 10;
/// A campaign of many cases has larger tasks, because the findings of each task must be handed over
/// and merged. A larger task has at most a 500th of the cases of its law and backend.
constexpr std::uint64_t kMostTasks = 500;
/// A larger task also has at most 1/16 of the number of cases before it, because an interrupted run
/// loses its tasks in progress.
constexpr std::uint64_t kShareOfThoseBefore = 16;
/// Minimum number of tasks per shard for a law and backend, if there are several shards and enough
/// cases. With so many tasks, one task more or less makes no difference.
constexpr std::uint64_t kTasksPerShard = 4;

/// Default limit, in seconds, for shrinking a case on which a backend hangs: each try may take the
/// whole time-out.
constexpr double kHangSeconds = 60;

/// Deals tasks out to shards in turn, and tells one shard which of them are its own.
class Deal {
 public:
  explicit Deal(records::ShardNumber ours) : ours_(ours) {}

  /// Returns the number of cases in the task that begins at case `first` of a law with `count`
  /// cases.
  std::uint64_t task_size(std::uint64_t first, std::uint64_t count) const {
    const std::uint64_t most = std::max(kCasesPerTask, count / kMostTasks);
    const std::uint64_t usual = std::clamp(first / kShareOfThoseBefore, kCasesPerTask, most);
    if (ours_.count == 1) return usual;
    return std::clamp<std::uint64_t>(count / (kTasksPerShard * ours_.count), 1, usual);
  }

  bool is_next_ours() { return next_++ % ours_.count == ours_.index - 1; }

  /// Cases grow with their index. If the shards get equally many tasks of a law, a shard is skipped
  /// before the next law begins. Without this, one shard would get the smallest cases of every law,
  /// and another the largest.
  void end_law(std::uint64_t tasks) {
    if (tasks % ours_.count == 0) ++next_;
  }

 private:
  records::ShardNumber ours_;
  std::uint64_t next_ = 0;
};

/// Counts a law's checked random cases, and how many of them reached each label. Leaves out corpora
/// and scenes, which have no required labels.
std::pair<std::uint64_t, std::map<std::string, std::uint64_t>> random_labels(
    const records::RecordSet& records, const std::string& law, const std::string& backend) {
  std::uint64_t checked = 0;
  std::map<std::string, std::uint64_t> labels;
  for (const auto& [key, record] : records) {
    const bool is_random = records::is_frozen(key) && key.stratum != records::kCorpusStratum;
    if (key.law != law || key.backend != backend || !is_random) continue;
    checked += record.cases.checked;
    for (const auto& [label, cases] : record.labels) labels[label] += cases;
  }
  return {checked, std::move(labels)};
}

bool is_skipped(const KnownByBackend& known, const std::string& backend, const std::string& law) {
  const auto of_backend = known.find(backend);
  return of_backend != known.end() && of_backend->second.is_skipped(law);
}

}  // namespace

std::vector<Task> tasks_of(const records::Plan& plan, std::size_t corpus_size,
                           std::span<const cases::Case> saved, const KnownByBackend& known) {
  std::vector<Task> tasks;
  Deal deal(plan.shard.value_or(records::ShardNumber()));
  const auto add = [&](TaskKind kind, std::uint64_t count) {
    for (const std::string& backend : plan.backends) {
      for (const std::string& law : plan.laws) {
        if (is_skipped(known, backend, law)) continue;
        std::uint64_t dealt = 0;
        for (std::uint64_t first = 0, last = 0; first < count; first = last, ++dealt) {
          last = first + std::min(deal.task_size(first, count), count - first);
          if (deal.is_next_ours()) tasks.push_back({backend, law, kind, first, last});
        }
        deal.end_law(dealt);
      }
    }
  };
  add(TaskKind::corpus, corpus_size);
  for (const cases::Case& c : saved) {
    Counterexample subject;
    subject.source = c;
    subject.origin = records::Origin::saved;
    if (is_skipped(known, c.found->backend, c.found->law)) continue;
    tasks.push_back({c.found->backend, c.found->law, TaskKind::saved, 0, 1, subject});
  }
  for (const auto& [backend, defects] : known) {
    for (const std::size_t entry : entries_to_check(defects, plan.laws)) {
      if (!deal.is_next_ours()) continue;
      tasks.push_back(
          {backend, defects.defects[entry].shown->found->law, TaskKind::known, entry, entry + 1});
    }
  }
  add(TaskKind::random, plan.cases_per_law);
  return tasks;
}

std::vector<Task> shrink_tasks(const Findings& findings) {
  std::vector<Task> tasks;
  for (const Counterexample& one : findings.counterexamples) {
    if (one.shrinking) continue;
    const cases::Found& found = *one.source.found;
    tasks.push_back({found.backend, found.law, TaskKind::shrink, 0, 1, one});
  }
  return tasks;
}

std::vector<records::UnreachedLabel> unreached_labels(const Law& law,
                                                      const records::BackendPromises& promises,
                                                      const records::RecordSet& records) {
  // The required shares were measured on backends that draw every case; with limits, fewer cases
  // may reach a label.
  if (promises.has_limits) return {};
  const std::string law_name(law.id);
  const auto [checked, labels] = random_labels(records, law_name, promises.backend);
  std::vector<records::UnreachedLabel> unreached;
  for (const Cover& cover : law.covers) {
    if (cover.is_decided && !promises.draws_what_is_asked_for) continue;
    const std::string label(cover.label);
    const std::uint64_t least = least_reached(cover, checked);
    const auto found = labels.find(label);
    const std::uint64_t reached = found == labels.end() ? 0 : found->second;
    if (reached < least) {
      unreached.push_back({law_name, promises.backend, label, reached, least, checked});
    }
  }
  return unreached;
}

std::vector<records::UnreachedLabel> unreached_labels(
    std::span<const std::string> laws, std::span<const records::BackendPromises> backends,
    const records::RecordSet& records) {
  std::vector<records::UnreachedLabel> unreached;
  for (const records::BackendPromises& backend : backends) {
    for (const std::string& name : laws) {
      const Law* law = find_law(name);
      if (law == nullptr) continue;
      const auto of_law = unreached_labels(*law, backend, records);
      unreached.insert(unreached.end(), of_law.begin(), of_law.end());
    }
  }
  std::sort(unreached.begin(), unreached.end(), [](const auto& a, const auto& b) {
    return std::tie(a.law, a.backend, a.label) < std::tie(b.law, b.backend, b.label);
  });
  return unreached;
}

ShrinkLimits shrink_limits(const records::ShrinkBudget& budget,
                           const Counterexample& counterexample, const IsToEnd& is_to_end) {
  const auto start = std::chrono::steady_clock::now();
  const bool is_hang =
      counterexample.source.found->verdict == records::to_string(records::FragmentClass::hang);
  const std::optional<double> seconds = budget.seconds || !is_hang ? budget.seconds : kHangSeconds;
  const auto is_late = [start, seconds, is_to_end] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return (seconds && passed.count() >= *seconds) || (is_to_end && is_to_end());
  };
  return {budget.tries, is_late};
}

backends::BackendFactory factory_for(const records::Plan& plan,
                                     const std::vector<std::string>& worker) {
  backends::BackendFactory factory;
  if (!worker.empty()) {
    factory.make_foreign = backends::isolated_by(
        {.command = worker, .timeout = std::chrono::duration<double>(plan.timeout)});
  }
  factory.terms = records::terms_of(plan);
  factory.draw_by = plan.draw_by;
  return factory;
}

TaskRunner::TaskRunner(records::Plan plan, std::vector<cases::Case> corpus, KnownSources known,
                       backends::BackendFactory backends)
    : plan_(std::move(plan)),
      corpus_(std::move(corpus)),
      known_(std::move(known)),
      backends_(std::move(backends)) {}

Result<const TaskRunner::Made*> TaskRunner::made(const std::string& specification) {
  Made& made = made_[specification];
  if (!made.backend) {
    Result<std::unique_ptr<backends::Backend>> backend = backends_.make(specification);
    if (!backend) return tl::unexpected(backend.error());
    Result<std::optional<KnownDefects>> known =
        read_known_defects(known_, specification, **backend);
    if (!known) return tl::unexpected(known.error());
    made = {*std::move(backend), *std::move(known)};
  }
  return &made;
}

Result<KnownByBackend> TaskRunner::known() {
  KnownByBackend all;
  for (const std::string& specification : plan_.backends) {
    const Result<const Made*> drawing = made(specification);
    if (!drawing) return tl::unexpected(drawing.error());
    if ((*drawing)->known) all.emplace(specification, *(*drawing)->known);
  }
  return all;
}

namespace {

/// Returns false if cases are not to be shrunk, or if the backend hangs on the counterexample: each
/// try would take the whole time-out.
bool is_explained(const records::Counterexample& one, const ShrinkLimits& limits) {
  return limits.tries > 0 && one.source.found->verdict != to_string(records::FragmentClass::hang);
}

}  // namespace

Result<Findings> TaskRunner::run(const Task& task, const IsToEnd& is_to_end) {
  const Law* law = find_law(task.law);
  if (law == nullptr) return tl::unexpected(Error{task.law, "", "no property is called this"});
  if (task.kind == TaskKind::corpus && task.last > corpus_.size()) {
    return tl::unexpected(Error{"the corpus", "", "has fewer cases than a task asks for"});
  }
  const Result<const Made*> drawing = made(task.backend);
  if (!drawing) return tl::unexpected(drawing.error());
  backends::Backend& backend = *(*drawing)->backend;
  const KnownDefects* known = (*drawing)->known_defects();
  const bool has_entry =
      known != nullptr && task.first < known->defects.size() && known->defects[task.first].shown;
  if (task.kind == TaskKind::known && !has_entry) {
    return tl::unexpected(Error{task.backend, "", "lacks the known defect that a task asks for"});
  }

  Findings findings;
  const bool is_frozen = task.kind == TaskKind::corpus || task.kind == TaskKind::random;
  if (plan_.keeps_cases && is_frozen) findings.cases.emplace();
  if (plan_.backends.size() > 1 && is_frozen) findings.outcomes.emplace();
  if (task.kind == TaskKind::shrink) {
    const ShrinkLimits limits = shrink_limits(plan_.shrinking, *task.subject, is_to_end);
    shrink_counterexample(*law, backend, *task.subject, limits, findings, known);
    for (records::Counterexample& one : findings.counterexamples) {
      if (!is_explained(one, limits) || findings.fault) continue;
      one.explanation = explain(*law, backend, one, task.subject->source, known, limits.is_to_end);
    }
    return findings;
  }
  if (task.kind == TaskKind::known) {
    check_known_case(*law, task.backend, backend, plan_.seed, *known, task.first, findings);
    return findings;
  }
  for (std::uint64_t i = task.first; i < task.last && !findings.fault; ++i) {
    if (is_to_end && is_to_end()) break;
    if (task.kind != TaskKind::random) {
      check_case(*law, task.backend, backend, plan_.seed, numbered_case(task, i), findings, known);
      continue;
    }
    const std::optional<NumberedCase> held =
        check_random_case(*law, task.backend, backend, plan_.seed, i,
                          records::capabilities_of(plan_, task.backend), findings, known);
    if (!held || !is_sabotaged(plan_, *law, i)) continue;
    const records::RecordKey key{task.law, task.backend, records::AttributeKind::coverage,
                                 held->stratum};
    measure_power(plan_, *law, backend, held->source, findings.records[key].power);
  }
  note_unlike_cases(plan_, corpus_, findings);
  return findings;
}

std::vector<records::BackendPromises> TaskRunner::promises() {
  std::vector<records::BackendPromises> all;
  for (const std::string& specification : plan_.backends) {
    const Result<const Made*> drawing = made(specification);
    all.push_back(
        promises_of(specification, drawing ? (*drawing)->backend.get() : nullptr, plan_.laws));
  }
  return all;
}

std::map<std::string, cases::Capabilities> TaskRunner::capabilities() {
  std::map<std::string, cases::Capabilities> all;
  for (const std::string& specification : plan_.backends) {
    const Result<const Made*> drawing = made(specification);
    if (!drawing) continue;
    cases::Capabilities one = capabilities_of(*(*drawing)->backend);
    if (!one.is_everything()) all.emplace(specification, std::move(one));
  }
  return all;
}

NumberedCase TaskRunner::numbered_case(const Task& task, std::uint64_t i) const {
  if (task.kind == TaskKind::corpus) {
    return {fitted_case(records::capabilities_of(plan_, task.backend), corpus_[i]),
            std::string(records::kCorpusStratum), i, records::Origin::corpus};
  }
  const cases::Case& source = task.subject->source;
  return {source, std::string(records::kSavedStratum), source.found->index, records::Origin::saved};
}

}  // namespace rastercheck::properties
