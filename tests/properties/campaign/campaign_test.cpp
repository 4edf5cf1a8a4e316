#include "properties/campaign/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <limits>
#include <map>

#include "backends/factory.h"
#include "properties/campaign/workers.h"
#include "tests/properties/campaign/gathered.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::campaign_test {
namespace {

using records::Counterexample;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage-obeys-the-contract";
constexpr const char* kValues = "values-stay-within-the-bound";

/// The id of a law that reports a fault of the oracle from the case with index 3 on.
constexpr const char* kFaultyLaw = "a-law-of-this-test-with-a-fault";

Generated generate_square(Draw& /*draw*/) { return {square(), "square"}; }

Result<Check> check_with_fault(const cases::ClipCase& /*c*/, backends::Backend& /*backend*/,
                               std::uint64_t index) {
  Check check;
  if (index >= 3) check.fault = "case " + std::to_string(index);
  return check;
}

const LawRegistration kRegistration({.id = kFaultyLaw,
                                     .sentence = "the oracle fails",
                                     .reason = "a test",
                                     .exceptions = "nothing",
                                     .generate = &generate_square,
                                     .check = &check_with_fault});

// --- Tasks ---------------------------------------------------------------------------------------

TEST(TasksOf, HoldsEveryCaseOnceCorpusFirst) {
  const records::Plan options{1, 25, {"cpu", "damaged"}, {"one law", "another"}};
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

// Kills: an index that overflows; a list that fills the memory.
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

/// The shard of each case, by backend, law, kind and index.
using Place = std::tuple<std::string, std::string, TaskKind, std::uint64_t>;
std::map<Place, std::uint64_t> dealt_out(records::Plan options, std::size_t corpus_size,
                                         std::uint64_t count) {
  std::map<Place, std::uint64_t> shards;
  for (std::uint64_t index = 1; index <= count; ++index) {
    options.shard = {index, count};
    for (const Task& task : tasks_of(options, corpus_size)) {
      for (std::uint64_t i = task.first; i < task.last; ++i) {
        const bool is_new = shards.insert({{task.backend, task.law, task.kind, i}, index}).second;
        EXPECT_TRUE(is_new) << task.law << " " << i;
      }
    }
  }
  return shards;
}

// Kills: a case in two shards or in none; shards that each have only some of the laws.
TEST(TasksOf, ShardsHaveEachCaseOnceAndOfEachLawAsMany) {
  const records::Plan options{1, 100, {"cpu", "damaged"}, {"one law", "another", "a third"}};
  for (const std::uint64_t count : std::array<std::uint64_t, 7>{1, 2, 7, 50, 64, 100, 700}) {
    const auto shards = dealt_out(options, 21, count);
    ASSERT_THAT(shards, SizeIs(2 * 3 * (100 + 21)));
    std::map<std::uint64_t, std::uint64_t> cases;
    std::map<std::pair<std::string, std::uint64_t>, std::uint64_t> of_law;
    for (const auto& [place, shard] : shards) {
      ++cases[shard];
      if (std::get<0>(place) == "cpu" && std::get<TaskKind>(place) == TaskKind::random) {
        ++of_law[{std::get<1>(place), shard}];
      }
    }
    const std::uint64_t all = shards.size();
    // Shards may differ by one task for each kind, law and backend, unless these have fewer tasks
    // than shards.
    const std::uint64_t task = std::max<std::uint64_t>(1, std::min<std::uint64_t>(10, 25 / count));
    for (std::uint64_t index = 1; index <= count; ++index) {
      EXPECT_GE(cases[index] + 12 * task, all / count) << count;
      EXPECT_LE(cases[index], all / count + 12 * task) << count;
      for (const char* law : {"one law", "another", "a third"}) {
        EXPECT_LE((of_law[{law, index}]), 100 / count + task) << count;
      }
    }
  }
}

// Kills: a shard that has the smallest cases of all laws, and another shard that has the largest.
TEST(TasksOf, ShardsBeginEachLawElsewhere) {
  const records::Plan options{1, 10, {"cpu"}, {"one law", "another", "a third"}};
  const auto shards = dealt_out(options, 0, 10);
  const std::uint64_t of_one = shards.at({"cpu", "one law", TaskKind::random, 0});
  EXPECT_NE(of_one, shards.at({"cpu", "another", TaskKind::random, 0}));
  EXPECT_NE(of_one, shards.at({"cpu", "a third", TaskKind::random, 0}));
}

TEST(TasksOf, AShardMayHaveNothingToDo) {
  EXPECT_THAT(dealt_out({1, 1, {"cpu"}, {"law"}}, 0, records::kMostShards), SizeIs(1));
}

// Kills: with shards, an index that overflows or a list that fills the memory.
TEST(TasksOf, ShardsTakeAnyNumberOfCases) {
  records::Plan options{1, std::numeric_limits<std::uint64_t>::max(), {"cpu"}, {"law"}};
  for (const std::uint64_t count : {std::uint64_t{2}, records::kMostShards}) {
    options.shard = {count, count};
    const std::vector<Task> tasks = tasks_of(options, 0);
    EXPECT_GT(tasks.size(), 2U);
    EXPECT_LT(tasks.size(), 10000U);
  }
}

TEST(TaskRunner, NamesWhatThereIsNot) {
  TaskRunner runner({.seed = 1}, {square()});
  EXPECT_EQ(to_string(runner.run({"cpu", "no law", TaskKind::random, 0, 1}).error()),
            "no law: no property is called this");
  EXPECT_EQ(to_string(runner.run({"cpu", kCoverage, TaskKind::corpus, 0, 2}).error()),
            "the corpus: has fewer cases than a task asks for");
  for (int twice = 0; twice < 2; ++twice) {  // a failure must not be cached like a backend
    EXPECT_THAT(to_string(runner.run({"gpu", kCoverage, TaskKind::random, 0, 1}).error()),
                HasSubstr("gpu: unknown backend"));
  }
}

TEST(TaskRunner, StopsAtAFault) {
  TaskRunner runner({.seed = 1}, {});
  const Findings findings = runner.run({"cpu", kFaultyLaw, TaskKind::random, 0, 10}).value();
  EXPECT_EQ(findings.fault, "case 3");
  ASSERT_THAT(findings.records, SizeIs(1));
  EXPECT_EQ(findings.records.begin()->second.cases.checked, 4U);
}

// Kills: work that goes on although its results are no longer wanted.
TEST(RunTasks, StopsWhereNoMoreAreWanted) {
  TaskRunner runner({.seed = 1}, {});
  const std::vector<Task> tasks = tasks_of({1, 40, {"cpu"}, {kFaultyLaw}}, 0);
  const auto findings =
      gathered([&](const TaskDone& done) { return run_tasks(runner, tasks, done); });
  EXPECT_EQ(findings.value().fault, "case 3");
  EXPECT_EQ(findings.value().records.begin()->second.cases.checked, 4U);
}

TEST(RunTasks, TellsOfEveryTask) {
  TaskRunner runner({.seed = 1}, {square()});
  std::vector<std::size_t> told;
  const records::Plan options{1, 12, {"cpu"}, {kCoverage}};
  ASSERT_TRUE(run_tasks(runner, tasks_of(options, 1), [&](std::size_t task, const Findings&) {
    told.push_back(task);
    return true;
  }));
  EXPECT_THAT(told, ElementsAre(0, 1, 2));
}

// Kills: an interrupt that is noticed only when everything is done.
TEST(RunTasks, EndsWhenAsked) {
  TaskRunner runner({.seed = 1}, {square()});
  int told = 0;
  const auto done = [&told](std::size_t, const Findings&) { return ++told > 0; };
  const std::vector<Task> tasks = tasks_of({1, 40, {"cpu"}, {kCoverage}}, 1);
  ASSERT_TRUE(run_tasks(runner, tasks, done, [&told] { return told == 2; }));
  EXPECT_EQ(told, 2);
}

// --- Merging -------------------------------------------------------------------------------------

/// A campaign that finds more counterexamples than are kept, but none for some laws.
const records::Plan kSmall{7, 12, {"cpu", "damaged"}, {kCoverage, kValues}};

std::vector<cases::Case> small_corpus() {
  std::vector<cases::Case> corpus;
  for (const char* name : {"one", "two", "three"}) {
    corpus.push_back(square());
    corpus.back().name = name;
  }
  return corpus;
}

Findings whole_campaign() {
  TaskRunner runner({.seed = kSmall.seed, .backends = kSmall.backends, .keeps_cases = true},
                    small_corpus());
  const std::vector<Task> tasks = tasks_of(kSmall, 3);
  return gathered([&](const TaskDone& done) { return run_tasks(runner, tasks, done); }).value();
}

TEST(Campaign, HasSomethingToFind) {
  const Findings whole = whole_campaign();
  EXPECT_EQ(whole.fault, std::nullopt);
  ASSERT_THAT(whole.counterexamples, SizeIs(testing::Ge(1)));
  const auto ordinary = std::find_if(
      whole.counterexamples.begin(), whole.counterexamples.end(),
      [](const Counterexample& one) { return one.source.found->condition == "ordinary"; });
  ASSERT_NE(ordinary, whole.counterexamples.end());
  const Counterexample& one = *ordinary;
  EXPECT_EQ(one.origin, records::Origin::corpus);
  EXPECT_EQ(one.source.name, "one");
  EXPECT_EQ(one.source.found,
            (cases::Found{kCoverage, "damaged", "missing", 7, 0, "coverage", "ordinary"}));
  // Two laws, two backends, three cases of the corpus and twelve random ones.
  ASSERT_TRUE(whole.cases);
  EXPECT_THAT(*whole.cases, SizeIs(4 * (3 + 12)));
  // Kept cases and outcomes say the same.
  ASSERT_TRUE(whole.outcomes);
  for (const auto& [key, record] : *whole.cases) {
    const auto outcomes = whole.outcomes->find({key.law, key.backend, key.origin});
    ASSERT_NE(outcomes, whole.outcomes->end());
    EXPECT_EQ(outcomes->second.right.contains(key.index),
              record.outcome == records::CaseOutcome::held);
    EXPECT_EQ(outcomes->second.wrong.contains(key.index),
              record.outcome == records::CaseOutcome::violated);
    EXPECT_TRUE(outcomes->second.unlike.empty());  // both draw everything
  }
}

// Kills: records or counterexamples that depend on which process checked what, or which was ready
// first.
RC_GTEST_PROP(Campaign, IsTheSameHoweverItIsSplit, ()) {
  static const Findings kWhole = whole_campaign();
  static const std::vector<Findings> kSingle = [] {
    TaskRunner runner({.seed = kSmall.seed, .backends = kSmall.backends, .keeps_cases = true},
                      small_corpus());
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

// --- Labels --------------------------------------------------------------------------------------

/// Records of the law: `checked` cases of a stratum were checked, and `reached` of them had the
/// label "tie".
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

// Kills: counting labels that are reached only in the corpus or a scene; ignoring a label that is
// missing; requiring a label from a backend whose contract leaves open what the label is about.
TEST(UnreachedLabels, AreThoseOfRandomCases) {
  const std::string law = "coverage-obeys-the-contract";
  records::Plan options;
  options.laws = {law};
  const auto unreached_in = [&](const records::RecordSet& records) {
    return unreached_labels(options.laws, TaskRunner(options, {}).promises(), records);
  };
  EXPECT_TRUE(unreached_in(ties(law, "ordinary", 1000, 500)).empty());
  EXPECT_TRUE(unreached_in(ties(law, "corpus", 1000, 0)).empty());
  EXPECT_TRUE(unreached_in(ties(law, "scene bunny", 1000, 0)).empty());
  records::RecordSet few = ties(law, "ordinary", 1000, 1);
  records::merge(few, ties(law, "slivers", 1000, 2));
  records::merge(few, ties(law, "corpus", 1000, 1000));
  const auto unreached = unreached_in(few);
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
  EXPECT_TRUE(unreached_in(of_method).empty());
}

// Kills: a law that requires no labels of a backend that is gone when the run ends; a law that
// requires labels of a backend that does not draw every case.
TEST(UnreachedLabels, DependOnWhatIsPromised) {
  const Law& law = *find_law("coverage-obeys-the-contract");
  records::RecordSet few = ties(std::string(law.id), "ordinary", 1000, 0);
  few.begin()->second.labels["clipped"] = 0;
  const std::vector<std::string> laws{std::string(law.id)};
  records::BackendPromises promises = promises_of("cpu", nullptr, laws);
  const auto unreached = unreached_labels(law, promises, few);
  ASSERT_EQ(unreached.size(), 1U);
  EXPECT_EQ(unreached[0].label, "clipped");
  promises.draws_what_is_asked_for = true;
  EXPECT_THAT(unreached_labels(law, promises, few), SizeIs(2));
  promises.has_limits = true;
  EXPECT_THAT(unreached_labels(law, promises, few), IsEmpty());
}

// --- Saved counterexamples -----------------------------------------------------------------------

cases::Case found_by(const std::string& law, const std::string& backend) {
  cases::Case c = square();
  c.found = {law, backend, "missing", 3, 4};
  return c;
}

// Kills: a saved counterexample that claims to be found today, or is not counted.
TEST(TaskRunner, ChecksASavedCounterexampleAgain) {
  TaskRunner runner({.seed = 99}, {});
  records::Plan options{99, 0, {"damaged"}, {kCoverage}};
  const std::vector<Task> tasks = tasks_of(options, 0, {{found_by(kCoverage, "damaged")}});
  ASSERT_THAT(tasks, SizeIs(1));
  const Findings findings = runner.run(tasks[0]).value();
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].origin, records::Origin::saved);
  EXPECT_EQ(findings.counterexamples[0].source.found,
            (cases::Found{kCoverage, "damaged", "missing", 3, 4, "coverage", "ordinary"}));
  const auto& [key, record] = *findings.records.begin();
  EXPECT_EQ(key.stratum, "saved");
  EXPECT_EQ(record.cases, (records::CaseCounts{1, 0, 1}));
}

// --- Shrinking -----------------------------------------------------------------------------------

// Kills: a shrunk counterexample that fails differently from the original; a shrunk counterexample
// without a close-up.
TEST(TaskRunner, ShrinksWhatFails) {
  TaskRunner runner({.seed = 1}, {});
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
  const auto damaged = backends::make_backend("damaged").value();
  EXPECT_GT(check_law(*find_law(kCoverage), one.source, *damaged, 0).value().violation_count, 0U);
}

TEST(TaskRunner, ShrinksNoLongerThanItMay) {
  Findings found;
  DamagedBackend backend(&lose_last_corner);
  check_case(*find_law(kCoverage), "damaged", backend, 1, {square(), "here", 5}, found);
  const Task task = shrink_tasks(found).at(0);
  const auto tries = [&task](const records::ShrinkBudget& budget,
                             const std::function<bool()>& is_to_end) {
    TaskRunner runner({.seed = 1, .shrinking = budget}, {});
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
}  // namespace rastercheck::properties::campaign_test
