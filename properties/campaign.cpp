#include "properties/campaign.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <tuple>
#include <utility>

#include "cases/case_reader.h"
#include "cases/json.h"
#include "oracle/transform.h"
#include "properties/close_up.h"
#include "properties/draw.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;

/// Cases in a task: some seconds of work at most, and a process more or less makes no difference.
constexpr std::uint64_t kCasesPerTask = 10;
/// Of a law and backend; beyond it tasks grow, as what each found has to be handed over and merged.
constexpr std::uint64_t kMostTasks = 500;

/// How many random cases of a law were checked, and of these how many reached each label. Nobody
/// says what a corpus or a scene is to reach.
std::pair<std::uint64_t, std::map<std::string, std::uint64_t>> random_labels(
    const records::RecordSet& records, const std::string& law, const std::string& backend) {
  std::uint64_t checked = 0;
  std::map<std::string, std::uint64_t> labels;
  for (const auto& [key, record] : records) {
    const bool is_random = key.stratum != kCorpusStratum && key.stratum != kSavedStratum &&
                           !key.stratum.starts_with(kSceneStratum);
    if (key.law != law || key.backend != backend || !is_random) continue;
    checked += record.cases.checked;
    for (const auto& [label, cases] : record.labels) labels[label] += cases;
  }
  return {checked, std::move(labels)};
}

}  // namespace

std::string verdict_of(const Check& check) {
  if (check.violation_count == 0) return "held";
  if (check.violations.empty()) return "violated";
  return std::string(to_string(check.violations.front().fragment_class));
}

std::vector<Task> tasks_of(const CampaignOptions& options, std::size_t corpus_size,
                           std::span<const cases::Case> saved) {
  std::vector<Task> tasks;
  const auto add = [&](TaskKind kind, std::uint64_t count) {
    const std::uint64_t size = std::max(kCasesPerTask, count / kMostTasks);
    for (const std::string& backend : options.backends) {
      for (const std::string& law : options.laws) {
        for (std::uint64_t first = 0, last = 0; first < count; first = last) {
          last = first + std::min(size, count - first);
          tasks.push_back({backend, law, kind, first, last});
        }
      }
    }
  };
  add(TaskKind::corpus, corpus_size);
  for (const cases::Case& c : saved) {
    Counterexample subject;
    subject.source = c;
    subject.origin = records::Origin::saved;
    tasks.push_back({c.found->backend, c.found->law, TaskKind::saved, 0, 1, subject});
  }
  add(TaskKind::random, options.cases_per_law);
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

std::vector<records::UnreachedLabel> unreached_labels(const CampaignOptions& options,
                                                      const records::RecordSet& records) {
  std::vector<records::UnreachedLabel> unreached;
  for (const std::string& backend : options.backends) {
    const auto made = backends::make_backend(backend);
    const bool is_decided = made && draws_what_is_asked_for(**made);
    for (const std::string& name : options.laws) {
      const Law* law = find_law(name);
      if (law == nullptr) continue;
      const auto [checked, labels] = random_labels(records, name, backend);
      for (const Cover& cover : law->covers) {
        if (cover.is_decided && !is_decided) continue;
        const std::string label(cover.label);
        const std::uint64_t least = least_reached(cover, checked);
        const auto found = labels.find(label);
        const std::uint64_t reached = found == labels.end() ? 0 : found->second;
        if (reached >= least) continue;
        unreached.push_back({name, backend, label, reached, least, checked});
      }
    }
  }
  std::sort(unreached.begin(), unreached.end(), [](const auto& a, const auto& b) {
    return std::tie(a.law, a.backend, a.label) < std::tie(b.law, b.backend, b.label);
  });
  return unreached;
}

Check check_or_note(const Law& law, const cases::Case& c, backends::Backend& backend,
                    const CheckOptions& options) {
  Result<Check> check = law.check(c, backend, options);
  if (check) return *std::move(check);
  // Positions beyond float32 cannot even be handed over: that is nobody's fault.
  Check failed;
  failed.is_applicable = oracle::to_clip_case(c, "").has_value();
  if (!failed.is_applicable) return failed;
  failed.violation_count = 1;
  records::Violation violation;
  violation.fragment_class = records::FragmentClass::missing;
  violation.exact = "a drawing";
  violation.actual = "none";
  violation.note = to_string(check.error());
  failed.violations = {violation};
  return failed;
}

void keep_counterexample(const Law& law, const std::string& specification,
                         backends::Backend& backend, std::uint64_t seed,
                         const NumberedCase& numbered, const Check& check, Findings& findings) {
  cases::Found place{std::string(law.name), specification, verdict_of(check), seed, numbered.index};
  // A saved counterexample tells where it was found at first.
  if (numbered.origin == records::Origin::saved && numbered.source.found) {
    place.seed = numbered.source.found->seed;
    place.index = numbered.source.found->index;
  }
  if (!is_kept(findings, place, numbered.origin, numbered.source.name)) return;
  Counterexample found{numbered.source, check.violation_count, check.violations, numbered.origin};
  // Of a scene with many triangles, not the whole is handed around until it is shrunk.
  if (numbered.source.triangles.size() > 1 && !check.violations.empty()) {
    const std::size_t triangle = check.violations.front().triangle;
    if (triangle < numbered.source.triangles.size()) {
      cases::Case one = with_triangles(numbered.source, {{triangle}});
      const Check alone = check_or_note(law, one, backend, {numbered.index});
      if (alone.violation_count > 0 && !alone.fault && verdict_of(alone) == place.verdict) {
        found = {std::move(one), alone.violation_count, alone.violations, numbered.origin};
      }
    }
  }
  found.source.found = place;
  keep(findings, std::move(found));
}

void shrink_counterexample(const Law& law, backends::Backend& backend, const Counterexample& found,
                           const ShrinkLimits& limits, Findings& findings) {
  const cases::Found place = found.source.found.value_or(cases::Found());
  const auto fails_alike = [&](const cases::Case& c) -> std::optional<Check> {
    if (findings.fault) return std::nullopt;  // There is nothing more to be learnt.
    Check check = check_or_note(law, c, backend, {place.index});
    findings.fault = check.fault;
    const bool is_alike = check.is_applicable && check.violation_count > 0 && !check.fault &&
                          verdict_of(check) == place.verdict;
    return is_alike ? std::optional(std::move(check)) : std::nullopt;
  };
  Check check;
  check.violation_count = found.violation_count;
  check.violations = found.violations;
  Shrunk shrunk = shrink(found.source, std::move(check), fails_alike, limits);
  Counterexample least{std::move(shrunk.source), shrunk.check.violation_count,
                       std::move(shrunk.check.violations), found.origin,
                       records::Shrinking{shrunk.tries, shrunk.is_least}};
  if (!least.violations.empty()) {
    least.close_up = close_up(least.source, backend, least.violations.front());
  }
  keep(findings, std::move(least));
}

void check_case(const Law& law, const std::string& specification, backends::Backend& backend,
                std::uint64_t seed, const NumberedCase& numbered, Findings& findings) {
  const Check check = check_or_note(law, numbered.source, backend, {numbered.index});
  if (check.fault && !findings.fault) findings.fault = check.fault;
  records::RecordKey key{std::string(law.name), specification, records::AttributeKind::coverage,
                         numbered.stratum};
  records::Record& record = findings.records[key];
  if (!check.is_applicable) {
    ++record.cases.not_applicable;
    return;
  }
  ++record.cases.checked;
  for (const std::string& label : check.labels) ++record.labels[label];
  records::add(findings.records, key, check.judgement);
  if (check.violation_count == 0) return;
  ++record.cases.violations;
  keep_counterexample(law, specification, backend, seed, numbered, check, findings);
}

TaskRunner::TaskRunner(std::uint64_t seed, std::vector<cases::Case> corpus, ShrinkBudget shrinking)
    : seed_(seed), corpus_(std::move(corpus)), shrinking_(shrinking) {}

Result<backends::Backend*> TaskRunner::backend(const std::string& specification) {
  std::unique_ptr<backends::Backend>& made = backends_[specification];
  if (!made) {
    Result<std::unique_ptr<backends::Backend>> backend = backends::make_backend(specification);
    if (!backend) return tl::unexpected(backend.error());
    made = *std::move(backend);
  }
  return made.get();
}

Result<Findings> TaskRunner::run(const Task& task, const std::function<bool()>& is_to_end) {
  const Law* law = find_law(task.law);
  if (law == nullptr) return tl::unexpected(Error{task.law, "", "there is no law of that name"});
  if (task.kind == TaskKind::corpus && task.last > corpus_.size()) {
    return tl::unexpected(Error{"the corpus", "", "has fewer cases than a task asks for"});
  }
  const Result<backends::Backend*> drawing = backend(task.backend);
  if (!drawing) return tl::unexpected(drawing.error());

  Findings findings;
  if (task.kind == TaskKind::shrink) {
    const auto start = std::chrono::steady_clock::now();
    const auto is_late = [&] {
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
      return (shrinking_.seconds && passed.count() >= *shrinking_.seconds) ||
             (is_to_end && is_to_end());
    };
    shrink_counterexample(*law, **drawing, *task.subject, {shrinking_.tries, is_late}, findings);
    return findings;
  }
  for (std::uint64_t i = task.first; i < task.last && !findings.fault; ++i) {
    check_case(*law, task.backend, **drawing, seed_, numbered_case(task, *law, i), findings);
  }
  return findings;
}

NumberedCase TaskRunner::numbered_case(const Task& task, const Law& law, std::uint64_t i) const {
  if (task.kind == TaskKind::corpus) {
    return {corpus_[i], std::string(kCorpusStratum), i, records::Origin::corpus};
  }
  if (task.kind == TaskKind::saved) {
    const cases::Case& source = task.subject->source;
    return {source, std::string(kSavedStratum), source.found->index, records::Origin::saved};
  }
  Draw draw(seed_, law.name, i);
  Generated generated = law.generate(draw);
  return {std::move(generated.source), std::move(generated.stratum), i, records::Origin::random};
}

namespace {

/// The case files of a folder, in the order of their names.
Result<std::vector<std::filesystem::path>> case_files(const std::string& directory) {
  std::error_code problem;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(directory, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  }
  if (problem) {
    return tl::unexpected(Error{directory, "", "cannot be read: " + problem.message()});
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Result<std::vector<cases::Case>> read_corpus(const std::string& directory) {
  const auto files = case_files(directory);
  if (!files) return tl::unexpected(files.error());
  std::vector<cases::Case> corpus;
  for (const std::filesystem::path& file : *files) {
    Result<cases::Case> c = cases::read_case(file.string());
    if (!c) return tl::unexpected(c.error());
    if (c->name.empty()) c->name = cases::valid_utf8(file.stem().string());
    corpus.push_back(*std::move(c));
  }
  return corpus;
}

SavedCases read_saved(const std::string& directory, const CampaignOptions& options) {
  SavedCases saved;
  std::error_code ignored;
  if (!std::filesystem::is_directory(directory, ignored)) return saved;
  const auto files = case_files(directory);
  if (!files) {
    saved.unreadable.push_back(files.error());
    return saved;
  }
  const auto is_among = [](const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  for (const std::filesystem::path& file : *files) {
    Result<cases::Case> c = cases::read_case(file.string());
    if (!c) {
      saved.unreadable.push_back(c.error());
    } else if (c->found && is_among(options.laws, c->found->law) &&
               is_among(options.backends, c->found->backend)) {
      saved.cases.push_back(*std::move(c));
    }
  }
  return saved;
}

}  // namespace rastercheck::properties
