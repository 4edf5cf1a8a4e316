#include "properties/campaign.h"

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "cases/case_reader.h"
#include "cases/json.h"
#include "oracle/transform.h"
#include "properties/draw.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;

/// Cases in a task: some seconds of work at most, and a process more or less makes no difference.
constexpr std::uint64_t kCasesPerTask = 10;
/// Of a law and backend; beyond it tasks grow, as what each found has to be handed over and merged.
constexpr std::uint64_t kMostTasks = 500;

auto place_of(const Counterexample& counterexample) {
  const cases::Found& found = *counterexample.source.found;
  return std::tie(found.law, found.backend, found.index, counterexample.source.name);
}

/// Drops what is beyond the lowest few of each law and backend.
void keep_lowest(std::vector<Counterexample>& all) {
  std::sort(all.begin(), all.end(), [](const Counterexample& a, const Counterexample& b) {
    return place_of(a) < place_of(b);
  });
  std::vector<Counterexample> kept;
  std::size_t of_this_kind = 0;
  for (Counterexample& one : all) {
    const cases::Found& found = *one.source.found;
    const bool is_same_kind = !kept.empty() && kept.back().source.found->law == found.law &&
                              kept.back().source.found->backend == found.backend;
    of_this_kind = is_same_kind ? of_this_kind + 1 : 1;
    if (of_this_kind <= records::kMostCounterexamples) kept.push_back(std::move(one));
  }
  all = std::move(kept);
}

/// The case with one of its triangles only, and that triangle's vertices.
cases::Case with_one_triangle(const cases::Case& c, std::size_t triangle) {
  cases::Case one = c;
  one.positions.clear();
  one.attribute_values.clear();
  one.clip_distances.clear();
  for (const std::uint32_t vertex : c.triangles[triangle]) {
    one.positions.push_back(c.positions[vertex]);
    const auto attributes = c.attributes_of(vertex);
    one.attribute_values.insert(one.attribute_values.end(), attributes.begin(), attributes.end());
    const auto distances = c.clip_distances_of(vertex);
    one.clip_distances.insert(one.clip_distances.end(), distances.begin(), distances.end());
  }
  one.triangles = {{0, 1, 2}};
  return one;
}

/// How many random cases of a law were checked, and of these how many reached each label. Nobody
/// says what a corpus or a scene is to reach.
std::pair<std::uint64_t, std::map<std::string, std::uint64_t>> random_labels(
    const records::RecordSet& records, const std::string& law, const std::string& backend) {
  std::uint64_t checked = 0;
  std::map<std::string, std::uint64_t> labels;
  for (const auto& [key, record] : records) {
    const bool is_random = key.stratum != kCorpusStratum && !key.stratum.starts_with(kSceneStratum);
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

void merge(Findings& into, Findings from) {
  records::merge(into.records, from.records);
  into.counterexamples.insert(into.counterexamples.end(),
                              std::make_move_iterator(from.counterexamples.begin()),
                              std::make_move_iterator(from.counterexamples.end()));
  keep_lowest(into.counterexamples);
  if (!into.fault) into.fault = std::move(from.fault);
}

std::vector<Task> tasks_of(const CampaignOptions& options, std::size_t corpus_size) {
  std::vector<Task> tasks;
  const auto add = [&](bool is_corpus, std::uint64_t count) {
    const std::uint64_t size = std::max(kCasesPerTask, count / kMostTasks);
    for (const std::string& backend : options.backends) {
      for (const std::string& law : options.laws) {
        for (std::uint64_t first = 0, last = 0; first < count; first = last) {
          last = first + std::min(size, count - first);
          tasks.push_back({backend, law, is_corpus, first, last});
        }
      }
    }
  };
  add(true, corpus_size);
  add(false, options.cases_per_law);
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
  Counterexample found{numbered.source, check.violation_count, check.violations};
  std::string verdict = verdict_of(check);
  // Triangles are drawn as if alone, so that mostly one of them suffices.
  if (numbered.source.triangles.size() > 1 && !check.violations.empty()) {
    const std::uint32_t triangle = check.violations.front().triangle;
    if (triangle < numbered.source.triangles.size()) {
      const cases::Case one = with_one_triangle(numbered.source, triangle);
      const Check alone = check_or_note(law, one, backend, {numbered.index});
      if (alone.violation_count > 0 && !alone.fault) {
        found = {one, alone.violation_count, alone.violations};
        verdict = verdict_of(alone);
      }
    }
  }
  found.source.found =
      cases::Found{std::string(law.name), specification, verdict, seed, numbered.index};
  findings.counterexamples.push_back(std::move(found));
  keep_lowest(findings.counterexamples);
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

TaskRunner::TaskRunner(std::uint64_t seed, std::vector<cases::Case> corpus)
    : seed_(seed), corpus_(std::move(corpus)) {}

Result<backends::Backend*> TaskRunner::backend(const std::string& specification) {
  std::unique_ptr<backends::Backend>& made = backends_[specification];
  if (!made) {
    Result<std::unique_ptr<backends::Backend>> backend = backends::make_backend(specification);
    if (!backend) return tl::unexpected(backend.error());
    made = *std::move(backend);
  }
  return made.get();
}

Result<Findings> TaskRunner::run(const Task& task) {
  const Law* law = find_law(task.law);
  if (law == nullptr) return tl::unexpected(Error{task.law, "", "there is no law of that name"});
  if (task.is_corpus && task.last > corpus_.size()) {
    return tl::unexpected(Error{"the corpus", "", "has fewer cases than a task asks for"});
  }
  const Result<backends::Backend*> drawing = backend(task.backend);
  if (!drawing) return tl::unexpected(drawing.error());

  Findings findings;
  for (std::uint64_t i = task.first; i < task.last && !findings.fault; ++i) {
    NumberedCase numbered;
    numbered.index = i;
    if (task.is_corpus) {
      numbered.source = corpus_[i];
      numbered.stratum = kCorpusStratum;
    } else {
      Draw draw(seed_, law->name, i);
      Generated generated = law->generate(draw);
      numbered.source = std::move(generated.source);
      numbered.stratum = std::move(generated.stratum);
    }
    check_case(*law, task.backend, **drawing, seed_, numbered, findings);
  }
  return findings;
}

Result<std::vector<cases::Case>> read_corpus(const std::string& directory) {
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

  std::vector<cases::Case> corpus;
  for (const std::filesystem::path& file : files) {
    Result<cases::Case> c = cases::read_case(file.string());
    if (!c) return tl::unexpected(c.error());
    if (c->name.empty()) c->name = cases::valid_utf8(file.stem().string());
    corpus.push_back(*std::move(c));
  }
  return corpus;
}

}  // namespace rastercheck::properties
