#include "properties/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <map>
#include <numeric>

#include "cases/case_writer.h"
#include "properties/workers.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage obeys the contract";
constexpr const char* kValues = "values stay within the bound";

/// Says that the oracle has failed from the case with index 3 on.
constexpr const char* kFaultyLaw = "a law of this test, with a fault";

Generated generate_square(Draw& /*draw*/) { return {square(), "square"}; }

Result<Check> check_with_fault(const cases::Case& /*c*/, backends::Backend& /*backend*/,
                               const CheckOptions& options) {
  Check check;
  if (options.case_index >= 3) check.fault = "case " + std::to_string(options.case_index);
  return check;
}

const LawRegistration kRegistration({.name = kFaultyLaw,
                                     .reason = "a test",
                                     .exceptions = "nothing",
                                     .generate = &generate_square,
                                     .check = &check_with_fault});

// --- Tasks ---------------------------------------------------------------------------------------

TEST(TasksOf, HoldsEveryCaseOnceCorpusFirst) {
  const CampaignOptions options{1, 25, {"cpu", "damaged"}, {"one law", "another"}};
  std::map<std::tuple<std::string, std::string, bool, std::uint64_t>, int> times;
  bool is_corpus_over = false;
  for (const Task& task : tasks_of(options, 12)) {
    EXPECT_FALSE(is_corpus_over && task.is_corpus);
    is_corpus_over = !task.is_corpus;
    EXPECT_LT(task.first, task.last);
    for (std::uint64_t i = task.first; i < task.last; ++i) {
      EXPECT_LT(i, task.is_corpus ? 12U : 25U);
      ++times[{task.backend, task.law, task.is_corpus, i}];
    }
  }
  EXPECT_THAT(times, SizeIs(2 * 2 * (12 + 25)));
  for (const auto& [what, count] : times) EXPECT_EQ(count, 1);
}

TEST(TasksOf, IsEmptyWithoutCases) {
  EXPECT_THAT(tasks_of({1, 0, {"cpu"}, {"law"}}, 0), IsEmpty());
}

// Kills: an index that overflows, and a list that fills the memory.
TEST(TasksOf, TakesAnyNumberOfCases) {
  constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
  const std::vector<Task> tasks = tasks_of({1, kAll, {"cpu"}, {"law"}}, 0);
  EXPECT_LT(tasks.size(), 20000U);
  std::uint64_t next = 0;
  for (const Task& task : tasks) {
    ASSERT_EQ(task.first, next);
    ASSERT_GT(task.last, task.first);
    next = task.last;
  }
  EXPECT_EQ(next, kAll);
}

TEST(TaskRunner, NamesWhatThereIsNot) {
  TaskRunner runner(1, {square()});
  EXPECT_EQ(to_string(runner.run({"cpu", "no law", false, 0, 1}).error()),
            "no law: there is no law of that name");
  EXPECT_EQ(to_string(runner.run({"cpu", kCoverage, true, 0, 2}).error()),
            "the corpus: has fewer cases than a task asks for");
  for (int twice = 0; twice < 2; ++twice) {  // a failure is not kept in a backend's place
    EXPECT_THAT(to_string(runner.run({"gpu", kCoverage, false, 0, 1}).error()),
                HasSubstr("gpu: no backend of that name"));
  }
}

TEST(TaskRunner, StopsAtAFault) {
  TaskRunner runner(1, {});
  const Findings findings = runner.run({"cpu", kFaultyLaw, false, 0, 10}).value();
  EXPECT_EQ(findings.fault, "case 3");
  ASSERT_THAT(findings.records, SizeIs(1));
  EXPECT_EQ(findings.records.begin()->second.cases.checked, 4U);
}

// Kills: work that goes on although its results are worth nothing.
TEST(RunTasks, StopsAtAFault) {
  TaskRunner runner(1, {});
  int told = 0;
  const auto findings =
      run_tasks(runner, tasks_of({1, 40, {"cpu"}, {kFaultyLaw}}, 0), [&](auto, auto) { ++told; });
  EXPECT_EQ(findings.value().fault, "case 3");
  EXPECT_EQ(findings.value().records.begin()->second.cases.checked, 4U);
  EXPECT_EQ(told, 0);
}

TEST(RunTasks, TellsOfEveryTask) {
  TaskRunner runner(1, {square()});
  std::vector<std::uint64_t> told;
  const CampaignOptions options{1, 12, {"cpu"}, {kCoverage}};
  ASSERT_TRUE(run_tasks(runner, tasks_of(options, 1), [&](std::uint64_t done, std::uint64_t all) {
    EXPECT_EQ(all, 13U);
    told.push_back(done);
  }));
  EXPECT_THAT(told, ElementsAre(1, 11, 13));
}

// --- Merging -------------------------------------------------------------------------------------

/// A campaign that finds something: more counterexamples than are kept, of some laws none.
const CampaignOptions kSmall{7, 12, {"cpu", "damaged"}, {kCoverage, kValues}};

std::vector<cases::Case> small_corpus() {
  std::vector<cases::Case> corpus;
  for (const char* name : {"one", "two", "three"}) {
    corpus.push_back(square());
    corpus.back().name = name;
  }
  return corpus;
}

Findings whole_campaign() {
  TaskRunner runner(kSmall.seed, small_corpus());
  return run_tasks(runner, tasks_of(kSmall, 3), {}).value();
}

TEST(Campaign, HasSomethingToFind) {
  const Findings whole = whole_campaign();
  EXPECT_EQ(whole.fault, std::nullopt);
  EXPECT_THAT(whole.counterexamples, SizeIs(records::kMostCounterexamples));
  for (const Counterexample& one : whole.counterexamples) {
    EXPECT_EQ(one.source.found->law, kCoverage);
    EXPECT_EQ(one.source.found->backend, "damaged");
  }
}

// Kills: records or counterexamples that depend on which process did what, or who was ready first.
RC_GTEST_PROP(Campaign, IsTheSameHoweverItIsSplit, ()) {
  static const Findings kWhole = whole_campaign();
  static const std::vector<Findings> kSingle = [] {
    TaskRunner runner(kSmall.seed, small_corpus());
    std::vector<Findings> all;
    for (Task task : tasks_of(kSmall, 3)) {
      const std::uint64_t last = task.last;
      for (; task.first < last; ++task.first) {
        task.last = task.first + 1;
        all.push_back(runner.run(task).value());
      }
    }
    return all;
  }();

  const auto part_count = *rc::gen::inRange<std::size_t>(1, 6);
  std::vector<Findings> parts(part_count);
  std::vector<Findings> single = kSingle;
  while (!single.empty()) {
    const auto which = *rc::gen::inRange<std::size_t>(0, single.size());
    const auto part = *rc::gen::inRange<std::size_t>(0, part_count);
    std::swap(single[which], single.back());
    merge(parts[part], std::move(single.back()));
    single.pop_back();
  }
  while (parts.size() > 1) {
    const auto into = *rc::gen::inRange<std::size_t>(0, parts.size() - 1);
    merge(parts[into], std::move(parts.back()));
    parts.pop_back();
  }
  RC_ASSERT(parts.front() == kWhole);
}

/// A counterexample that merging has nothing more to ask about.
Findings found_one(const std::string& law, const std::string& backend, std::uint64_t index) {
  Findings findings;
  Counterexample one;
  one.source.found = cases::Found{law, backend, "missing", 1, index};
  findings.counterexamples = {one};
  return findings;
}

TEST(Merge, KeepsTheLowestIndicesOfEachLawAndBackend) {
  Findings all;
  for (const std::uint64_t index : {9U, 3U, 8U, 1U, 7U, 0U, 5U}) {
    for (const char* law : {"b", "a"}) {
      for (const char* backend : {"y", "x"}) merge(all, found_one(law, backend, index));
    }
  }
  std::vector<std::string> kept;
  for (const Counterexample& one : all.counterexamples) {
    kept.push_back(one.source.found->law + one.source.found->backend +
                   std::to_string(one.source.found->index));
  }
  EXPECT_THAT(
      kept, ElementsAre("ax0", "ax1", "ax3", "ax5", "ax7", "ay0", "ay1", "ay3", "ay5", "ay7", "bx0",
                        "bx1", "bx3", "bx5", "bx7", "by0", "by1", "by3", "by5", "by7"));
}

TEST(Merge, KeepsTheFirstFault) {
  Findings all;
  merge(all, {});
  EXPECT_EQ(all.fault, std::nullopt);
  for (const char* fault : {"first", "second"}) {
    Findings findings;
    findings.fault = fault;
    merge(all, findings);
  }
  EXPECT_EQ(all.fault, "first");
}

// --- One case ------------------------------------------------------------------------------------

Findings check_square(backends::Backend& backend, cases::Case c = square()) {
  c.name = "square";
  Findings findings;
  check_case(*find_law(kCoverage), "damaged", backend, 7, {std::move(c), "here", 4}, findings);
  return findings;
}

TEST(CheckCase, CountsAndSaysWhereItIsFrom) {
  DamagedBackend backend([](const cases::Case&, cases::Framebuffer& d) { drop(d, 0, 1, 1); });
  const Findings findings = check_square(backend);
  const auto record =
      findings.records.find({kCoverage, "damaged", records::AttributeKind::coverage, "here"});
  ASSERT_NE(record, findings.records.end());
  EXPECT_EQ(record->second.cases, (records::CaseCounts{1, 0, 1}));
  EXPECT_GE(record->second.counts.required, 56U);  // all but the diagonal, which may be open
  EXPECT_EQ(record->second.labels.at("drawn"), 1U);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].source.found,
            (cases::Found{kCoverage, "damaged", "missing", 7, 4}));
}

/// Loses (7, 7), the last fragment that triangle B draws, whatever it is called.
void lose_last_corner(const cases::Case& /*c*/, cases::Framebuffer& drawn) {
  const std::uint32_t last = drawn.triangle.back();
  if (find(drawn, last, 7, 7) < drawn.size()) drop(drawn, last, 7, 7);
}

// Kills: the first triangle instead of the guilty one, values left with their old vertices.
TEST(CheckCase, KeepsTheOneTriangleThatSuffices) {
  cases::Case c = square();
  c.clip_distance_count = 1;
  c.clip_distances = {10, 11, 12, 13};
  DamagedBackend backend(&lose_last_corner);
  const Findings findings = check_square(backend, c);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  const Counterexample& found = findings.counterexamples[0];
  EXPECT_THAT(found.source.triangles, ElementsAre(cases::Triangle{0, 1, 2}));
  EXPECT_THAT(found.source.positions, ElementsAre(c.positions[2], c.positions[1], c.positions[3]));
  EXPECT_THAT(found.source.attribute_values, ElementsAre(0, 1, 0, 8, 1, 0, 8, 1, 0));
  EXPECT_THAT(found.source.clip_distances, ElementsAre(12, 11, 13));
  ASSERT_THAT(found.violations, SizeIs(1));
  EXPECT_EQ(found.violations[0].triangle, 0U);
  EXPECT_EQ(found.violations[0].x, 7U);
}

// Kills: a counterexample that holds when it is replayed.
TEST(CheckCase, KeepsTheWholeCaseWhereNoTriangleSuffices) {
  DamagedBackend backend([](const cases::Case& c, cases::Framebuffer& drawn) {
    if (c.triangles.size() > 1) lose_last_corner(c, drawn);
  });
  const Findings findings = check_square(backend);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_THAT(findings.counterexamples[0].source.triangles, SizeIs(2));
  EXPECT_EQ(findings.counterexamples[0].violations[0].triangle, 1U);
}

/// The law's cases: so many of a stratum were checked, and so many reached "tie".
records::RecordSet ties(const std::string& law, const std::string& stratum, std::uint64_t checked,
                        std::uint64_t reached) {
  records::RecordSet records;
  records::Record& record = records[{law, "cpu", records::AttributeKind::coverage, stratum}];
  record.cases.checked = checked;
  for (const Cover& cover : find_law(law)->covers)
    record.labels[std::string(cover.label)] = checked;
  record.labels["tie"] = reached;
  return records;
}

// Kills: a label that is reached in the corpus or a scene alone, and counts; one that is missing
// and does not; one asked of a backend that leaves open what it says.
TEST(UnreachedLabels, AreThoseOfRandomCases) {
  const std::string law = "coverage obeys the contract";
  CampaignOptions options;
  options.laws = {law};
  EXPECT_TRUE(unreached_labels(options, ties(law, "ordinary", 1000, 500)).empty());
  EXPECT_TRUE(unreached_labels(options, ties(law, "corpus", 1000, 0)).empty());
  EXPECT_TRUE(unreached_labels(options, ties(law, "scene bunny", 1000, 0)).empty());
  records::RecordSet few = ties(law, "ordinary", 1000, 1);
  records::merge(few, ties(law, "slivers", 1000, 2));
  records::merge(few, ties(law, "corpus", 1000, 1000));
  const auto unreached = unreached_labels(options, few);
  ASSERT_EQ(unreached.size(), 1U);
  EXPECT_EQ(unreached[0].law, law);
  EXPECT_EQ(unreached[0].backend, "cpu");
  EXPECT_EQ(unreached[0].label, "tie");
  EXPECT_EQ(unreached[0].reached, 3U);
  EXPECT_EQ(unreached[0].checked, 2000U);
  EXPECT_GT(unreached[0].least, 3U);

  records::RecordSet of_method;
  for (auto& [key, record] : few) {
    records::RecordKey other = key;
    other.backend = "method:rational-linear";
    of_method[other] = record;
  }
  options.backends = {"method:rational-linear"};
  EXPECT_TRUE(unreached_labels(options, of_method).empty());
}

TEST(CheckCase, KeepsTheLowestIndices) {
  DamagedBackend backend(&lose_last_corner);
  Findings findings;
  for (std::uint64_t left = 8; left > 0; --left) {
    check_case(*find_law(kCoverage), "damaged", backend, 1, {square(), "here", left - 1}, findings);
  }
  std::vector<std::uint64_t> kept;
  for (const Counterexample& one : findings.counterexamples) {
    kept.push_back(one.source.found->index);
  }
  EXPECT_THAT(kept, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(findings.records.begin()->second.cases.violations, 8U);
}

TEST(CheckCase, HoldsADrawingThatFailsAgainstTheBackend) {
  const auto backend = backends::make_backend("damaged:refuses").value();
  const Findings findings = check_square(*backend);
  EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{1, 0, 1}));
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  ASSERT_THAT(findings.counterexamples[0].violations, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].violations[0].note, "out of memory");
  EXPECT_EQ(findings.counterexamples[0].source.found->verdict, "missing");
}

// Kills: blaming a backend for a case that it never got.
TEST(CheckCase, SaysNothingOfPositionsBeyondFloat32) {
  cases::Case c = square();
  c.camera.emplace();
  c.camera->model[0] = 0x1p127F;
  c.camera->view[0] = 4;
  const auto backend = backends::make_backend("cpu").value();
  const Findings findings = check_square(*backend, c);
  EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{0, 1, 0}));
  EXPECT_THAT(findings.counterexamples, IsEmpty());
}

// --- The corpus ----------------------------------------------------------------------------------

cases::Case named(const std::string& name) {
  cases::Case c = square();
  c.name = name;
  return c;
}

// Kills: the order in which files were made, either way round, or that of their cases' names.
TEST(ReadCorpus, GoesByTheNamesOfFiles) {
  const TemporaryFolder folder;
  for (const char* name : {"5", "3", "8", "1", "9", "0", "7", "2", "6", "4"}) {
    folder.put(std::string(name) + ".json", cases::to_json(named(name[0] == '3' ? "z" : "")));
  }
  const auto corpus = read_corpus(folder.path());
  ASSERT_TRUE(corpus) << to_string(corpus.error());
  std::string names;
  for (const cases::Case& c : *corpus) names += c.name;
  EXPECT_EQ(names, "012z456789");
}

TEST(ReadCorpus, NamesCasesThatHaveNoName) {
  const TemporaryFolder folder;
  folder.put("b.json", cases::to_json(named("its own name")));
  folder.put("a.json", cases::to_json(named("")));
  folder.put("c\xff.json", cases::to_json(named("")));
  folder.put("notes.txt", "no case");
  const auto corpus = read_corpus(folder.path());
  ASSERT_TRUE(corpus) << to_string(corpus.error());
  std::vector<std::string> names;
  for (const cases::Case& c : *corpus) names.push_back(c.name);
  // The last as it comes back from a file: records of it are the same in every process.
  EXPECT_THAT(names, ElementsAre("a", "its own name", "c\ufffd"));
}

TEST(ReadCorpus, MayBeEmpty) {
  const TemporaryFolder folder;
  EXPECT_THAT(read_corpus(folder.path()).value(), IsEmpty());
}

TEST(ReadCorpus, NamesWhatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_EQ(to_string(read_corpus(folder.path("none")).error()),
            folder.path("none") + ": cannot be read: No such file or directory");
  const std::string file = folder.put("x/broken.json", "{");
  EXPECT_THAT(to_string(read_corpus(folder.path("x")).error()), testing::StartsWith(file + ": 1:"));
  EXPECT_EQ(to_string(read_corpus(file).error()), file + ": cannot be read: Not a directory");
}

}  // namespace
}  // namespace rastercheck::properties
