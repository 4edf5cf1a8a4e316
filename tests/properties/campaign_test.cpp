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
#include "tests/properties/gathered.h"
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
  std::map<std::tuple<std::string, std::string, TaskKind, std::uint64_t>, int> times;
  std::vector<cases::Case> saved(3, square());
  for (std::size_t i = 0; i < saved.size(); ++i) {
    saved[i].found = {"law " + std::to_string(i), "cpu", "missing", 7, 9};
  }
  TaskKind last_kind = TaskKind::corpus;
  for (const Task& task : tasks_of(options, 12, saved)) {
    EXPECT_GE(task.kind, last_kind);
    last_kind = task.kind;
    EXPECT_LT(task.first, task.last);
    for (std::uint64_t i = task.first; i < task.last; ++i) {
      EXPECT_LT(i, task.kind == TaskKind::corpus ? 12U : 25U);
      ++times[{task.backend, task.law, task.kind, i}];
    }
    EXPECT_EQ(task.kind == TaskKind::saved, task.subject.has_value());
  }
  EXPECT_THAT(times, SizeIs(2 * 2 * (12 + 25) + 3));
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
  EXPECT_EQ(to_string(runner.run({"cpu", "no law", TaskKind::random, 0, 1}).error()),
            "no law: there is no law of that name");
  EXPECT_EQ(to_string(runner.run({"cpu", kCoverage, TaskKind::corpus, 0, 2}).error()),
            "the corpus: has fewer cases than a task asks for");
  for (int twice = 0; twice < 2; ++twice) {  // a failure is not kept in a backend's place
    EXPECT_THAT(to_string(runner.run({"gpu", kCoverage, TaskKind::random, 0, 1}).error()),
                HasSubstr("gpu: no backend of that name"));
  }
}

TEST(TaskRunner, StopsAtAFault) {
  TaskRunner runner(1, {});
  const Findings findings = runner.run({"cpu", kFaultyLaw, TaskKind::random, 0, 10}).value();
  EXPECT_EQ(findings.fault, "case 3");
  ASSERT_THAT(findings.records, SizeIs(1));
  EXPECT_EQ(findings.records.begin()->second.cases.checked, 4U);
}

// Kills: work that goes on although its results are worth nothing.
TEST(RunTasks, StopsWhereNoMoreAreWanted) {
  TaskRunner runner(1, {});
  const std::vector<Task> tasks = tasks_of({1, 40, {"cpu"}, {kFaultyLaw}}, 0);
  const auto findings =
      gathered([&](const TaskDone& done) { return run_tasks(runner, tasks, done); });
  EXPECT_EQ(findings.value().fault, "case 3");
  EXPECT_EQ(findings.value().records.begin()->second.cases.checked, 4U);
}

TEST(RunTasks, TellsOfEveryTask) {
  TaskRunner runner(1, {square()});
  std::vector<std::size_t> told;
  const CampaignOptions options{1, 12, {"cpu"}, {kCoverage}};
  ASSERT_TRUE(run_tasks(runner, tasks_of(options, 1), [&](std::size_t task, const Findings&) {
    told.push_back(task);
    return true;
  }));
  EXPECT_THAT(told, ElementsAre(0, 1, 2));
}

// Kills: an interrupt that is heard when all is done.
TEST(RunTasks, EndsWhenAsked) {
  TaskRunner runner(1, {square()});
  int told = 0;
  const auto done = [&told](std::size_t, const Findings&) { return ++told > 0; };
  const std::vector<Task> tasks = tasks_of({1, 40, {"cpu"}, {kCoverage}}, 1);
  ASSERT_TRUE(run_tasks(runner, tasks, done, [&told] { return told == 2; }));
  EXPECT_EQ(told, 2);
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
  const std::vector<Task> tasks = tasks_of(kSmall, 3);
  return gathered([&](const TaskDone& done) { return run_tasks(runner, tasks, done); }).value();
}

TEST(Campaign, HasSomethingToFind) {
  const Findings whole = whole_campaign();
  EXPECT_EQ(whole.fault, std::nullopt);
  ASSERT_THAT(whole.counterexamples, SizeIs(1));
  const Counterexample& one = whole.counterexamples[0];
  EXPECT_EQ(one.origin, records::Origin::corpus);
  EXPECT_EQ(one.source.name, "one");
  EXPECT_EQ(one.source.found, (cases::Found{kCoverage, "damaged", "missing", 7, 0}));
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
Findings found_one(const cases::Found& found, records::Origin origin = records::Origin::random,
                   const std::string& name = "") {
  Findings findings;
  Counterexample one;
  one.source.found = found;
  one.source.name = name;
  one.origin = origin;
  findings.counterexamples = {one};
  return findings;
}

// Kills: one failure that hides another, and more of one kind than a reader asked for.
TEST(Merge, KeepsTheFirstOfEachWayToFail) {
  Findings all;
  for (const std::uint64_t index : {9U, 3U, 8U, 1U, 7U, 5U}) {
    for (const char* law : {"b", "a"}) {
      for (const char* backend : {"y", "x"}) {
        for (const char* verdict : {"missing", "extra"}) {
          merge(all, found_one({law, backend, verdict, 1, index}));
        }
      }
    }
  }
  std::vector<std::string> kept;
  for (const Counterexample& one : all.counterexamples) {
    const cases::Found& found = *one.source.found;
    kept.push_back(found.law + found.backend + found.verdict[0] + std::to_string(found.index));
  }
  EXPECT_THAT(kept, ElementsAre("axe1", "axm1", "aye1", "aym1", "bxe1", "bxm1", "bye1", "bym1"));
}

// Kills: a random case in the place of one that has a name and a sentence.
TEST(Merge, TakesTheCorpusBeforeSavedCasesAndTheseBeforeOthers) {
  using records::Origin;
  const cases::Found late{"law", "cpu", "missing", 1, 9};
  const cases::Found early{"law", "cpu", "missing", 1, 2};
  Findings all = found_one(early);
  const auto origin = [&all] { return all.counterexamples.at(0).origin; };
  merge(all, found_one(late, Origin::scene));
  EXPECT_EQ(origin(), Origin::scene);
  merge(all, found_one(late, Origin::saved));
  EXPECT_EQ(origin(), Origin::saved);
  merge(all, found_one(late, Origin::corpus, "b"));
  merge(all, found_one(early, Origin::saved));
  EXPECT_EQ(origin(), Origin::corpus);
  merge(all, found_one(late, Origin::corpus, "a"));
  EXPECT_EQ(all.counterexamples.at(0).source.name, "a");
  merge(all, found_one(early, Origin::corpus, "z"));
  EXPECT_EQ(all.counterexamples.at(0).source.name, "z");
  EXPECT_THAT(all.counterexamples, SizeIs(1));
}

// Kills: a reader who begins with nine vertices and a mirror.
TEST(FirstToRead, IsOfTheCaseAsItStandsAndSmall) {
  const auto one = [](const char* law, std::size_t triangles) {
    Counterexample counterexample;
    counterexample.source.found = cases::Found{law, "cpu", "missing", 1, 2};
    counterexample.source.triangles.resize(triangles);
    return counterexample;
  };
  EXPECT_EQ(first_to_read({one("a", 3), one("b", 2), one("c", 2)}), 1U);
  EXPECT_EQ(first_to_read({one("a", 1), one("coverage obeys the contract", 9), one("c", 1),
                           one("values stay within the bound", 4)}),
            3U);
  EXPECT_EQ(first_to_read({}), 0U);
}

// Kills: two saved files of one place, of which the one that was read first wins.
TEST(Merge, TakesTheSameOfTwoWhateverTheOrder) {
  const cases::Found found{"law", "cpu", "missing", 1, 2};
  Findings one = found_one(found, records::Origin::saved);
  Findings other = one;
  other.counterexamples[0].source.framebuffer.width = 7;
  Findings there = one;
  merge(there, other);
  merge(other, one);
  EXPECT_EQ(there, other);
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

/// What `damaged` does (damaged_kind.cpp).
void lose_last(const cases::Case& /*c*/, cases::Framebuffer& drawn) {
  if (drawn.size() == 0) return;
  const std::size_t last = drawn.size() - 1;
  drop(drawn, drawn.triangle[last], drawn.x[last], drawn.y[last]);
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

TEST(CheckCase, KeepsTheLowestIndex) {
  DamagedBackend backend(&lose_last_corner);
  Findings findings;
  for (std::uint64_t left = 8; left > 0; --left) {
    check_case(*find_law(kCoverage), "damaged", backend, 1, {square(), "here", left - 1}, findings);
  }
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].source.found->index, 0U);
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

// --- Saved counterexamples -----------------------------------------------------------------------

cases::Case found_by(const std::string& law, const std::string& backend) {
  cases::Case c = square();
  c.found = {law, backend, "missing", 3, 4};
  return c;
}

// Kills: a broken file that ends the run, or goes unsaid; cases that nobody asked for.
TEST(ReadSaved, TakesWhatThisRunCanCheckAgain) {
  const TemporaryFolder folder;
  CampaignOptions options;
  options.backends = {"cpu", "damaged"};
  options.laws = {kCoverage, kValues};
  folder.put("1.json", cases::to_json(found_by(kCoverage, "damaged")));
  folder.put("2.json", cases::to_json(found_by(kValues, "cpu")));
  folder.put("3.json", cases::to_json(found_by(kValues, "gl")));
  folder.put("4.json", cases::to_json(found_by("constants stay constant", "cpu")));
  folder.put("5.json", cases::to_json(square()));
  const std::string broken = folder.put("6.json", "{");
  folder.put("notes.txt", "{");
  const SavedCases saved = read_saved(folder.path(), options);
  EXPECT_THAT(saved.cases, ElementsAre(found_by(kCoverage, "damaged"), found_by(kValues, "cpu")));
  ASSERT_THAT(saved.unreadable, SizeIs(1));
  EXPECT_THAT(to_string(saved.unreadable[0]), testing::StartsWith(broken + ": 1:"));
  EXPECT_THAT(read_saved(folder.path("none"), options).cases, IsEmpty());
  EXPECT_THAT(read_saved(folder.path("none"), options).unreadable, IsEmpty());
}

// Kills: a saved counterexample that says it was found today, or is not counted.
TEST(TaskRunner, ChecksASavedCounterexampleAgain) {
  TaskRunner runner(99, {});
  CampaignOptions options{99, 0, {"damaged"}, {kCoverage}};
  const std::vector<Task> tasks = tasks_of(options, 0, {{found_by(kCoverage, "damaged")}});
  ASSERT_THAT(tasks, SizeIs(1));
  const Findings findings = runner.run(tasks[0]).value();
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].origin, records::Origin::saved);
  EXPECT_EQ(findings.counterexamples[0].source.found,
            (cases::Found{kCoverage, "damaged", "missing", 3, 4}));
  const auto& [key, record] = *findings.records.begin();
  EXPECT_EQ(key.stratum, "saved");
  EXPECT_EQ(record.cases, (records::CaseCounts{1, 0, 1}));
}

// --- Shrinking -----------------------------------------------------------------------------------

// Kills: a counterexample that fails otherwise than the one it was made from, or is not looked at.
TEST(TaskRunner, ShrinksWhatFails) {
  TaskRunner runner(1, {});
  Findings found;
  DamagedBackend backend(&lose_last_corner);
  check_case(*find_law(kCoverage), "damaged", backend, 1, {square(), "here", 5}, found);
  const std::vector<Task> tasks = shrink_tasks(found);
  ASSERT_THAT(tasks, SizeIs(1));
  EXPECT_EQ(tasks[0].cases(), 0U);
  const Findings shrunk = runner.run(tasks[0]).value();
  EXPECT_TRUE(shrunk.records.empty());
  ASSERT_THAT(shrunk.counterexamples, SizeIs(1));
  const Counterexample& one = shrunk.counterexamples[0];
  EXPECT_EQ(one.source.found, found.counterexamples[0].source.found);
  EXPECT_LE(one.source.framebuffer.width * one.source.framebuffer.height, 6);
  EXPECT_THAT(one.source.attributes, IsEmpty());
  ASSERT_TRUE(one.shrinking);
  EXPECT_TRUE(one.shrinking->is_least);
  EXPECT_GT(one.shrinking->tries, 0U);
  EXPECT_THAT(one.close_up, testing::Contains(HasSubstr("[-]")));
  EXPECT_THAT(shrink_tasks(shrunk), IsEmpty());
  EXPECT_GT(check_of(kCoverage, one.source, &lose_last).violation_count, 0U);
}

TEST(TaskRunner, ShrinksNoLongerThanItMay) {
  Findings found;
  DamagedBackend backend(&lose_last_corner);
  check_case(*find_law(kCoverage), "damaged", backend, 1, {square(), "here", 5}, found);
  const Task task = shrink_tasks(found).at(0);
  const auto tries = [&task](const ShrinkBudget& budget, const std::function<bool()>& is_to_end) {
    TaskRunner runner(1, {}, budget);
    const Findings shrunk = runner.run(task, is_to_end).value();
    EXPECT_FALSE(shrunk.counterexamples.at(0).shrinking->is_least);
    return shrunk.counterexamples.at(0).shrinking->tries;
  };
  EXPECT_EQ(tries({0, std::nullopt}, {}), 0U);
  EXPECT_EQ(tries({3, std::nullopt}, {}), 3U);
  EXPECT_EQ(tries({1000, 1e-9}, {}), 0U);
  int asked = 0;
  EXPECT_LT(tries({1000, std::nullopt}, [&asked] { return ++asked > 5; }), 6U);
}

}  // namespace
}  // namespace rastercheck::properties
