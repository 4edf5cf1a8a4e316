#include "gate/internal/commit_drawing.h"

#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/reports/sample_run.h"
#include "tests/temporary_folder.h"

namespace rastercheck::gate::commit_drawing_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

bool matches(const std::string& pattern, const std::string& law) {
  return ::fnmatch(pattern.c_str(), law.c_str(), FNM_EXTMATCH) == 0;
}

TEST(CommitDrawing, PatternMatchesTheseLawsAndNoOthers) {
  const std::string odd = "1/w (in [0, 1]) is *one* of a|b, isn't it? \\ @(c)";
  EXPECT_EQ(pattern_of({"values-stay-within-the-bound"}), "values-stay-within-the-bound");
  EXPECT_TRUE(matches(pattern_of({odd}), odd));
  EXPECT_FALSE(matches(pattern_of({odd}), "1/w (in 0) is two one of a|b, isn't its \\ @(c)"));
  const std::string both = pattern_of({odd, "coverage"});
  EXPECT_TRUE(matches(both, odd));
  EXPECT_TRUE(matches(both, "coverage"));
  EXPECT_FALSE(matches(both, "coverages"));
  EXPECT_FALSE(matches(both, "a"));
}

TEST(CommitDrawing, OnlyLawsKeepsWhatFrozenCasesGave) {
  records::Run run;
  run.plan.laws = {"one", "two", "three"};
  run.sentences = {{"one", "the first"}, {"two", "the second"}};
  run.cases.emplace();
  for (const std::string& law : run.plan.laws) {
    run.records[{law, "cpu", records::AttributeKind::coverage, ""}];
    (*run.cases)[{law, "cpu", records::Origin::random, 0}];
  }
  run.counterexamples = {reports::sample_counterexample(3)};
  const records::Run only = only_laws(run, {"one", "three", "four"});
  EXPECT_EQ(only.plan.laws, (std::vector<std::string>{"one", "three"}));
  EXPECT_EQ(only.sentences.size(), 1U);
  EXPECT_EQ(only.records.size(), 2U);
  EXPECT_FALSE(only.records.contains({"two", "cpu", records::AttributeKind::coverage, ""}));
  EXPECT_EQ(only.cases->size(), 2U);
  EXPECT_TRUE(only.counterexamples.empty());
}

// --- Building and drawing, by commands that print their arguments --------------------------------

class DrawCommit : public testing::Test {
 protected:
  DrawCommit() {
    plan_.folder = folder_.path();
    plan_.plan = {7, 12, {"cpu", "plugin:./p.so"}, {}, {"a law"}};
  }
  /// `run` is a script that takes the place of the program.
  std::string failure(const std::string& build, const std::string& run) {
    folder_.put("program", "#!/bin/sh\n" + run + "\n");
    fs::permissions(folder_.path("program"), fs::perms::owner_all);
    plan_.build = {"sh", "-c", build};
    plan_.program = folder_.path("program");
    const auto drawn = draw_commit(plan_, "abc", {});
    return drawn ? "" : to_string(drawn.error());
  }
  TemporaryFolder folder_;
  BisectPlan plan_;
};

TEST_F(DrawCommit, SaysWhatFailed) {
  EXPECT_EQ(failure("echo out; echo err >&2; exit 4", ""),
            "sh -c echo out; echo err >&2; exit 4: ended with exit code 4; its output: err");
  EXPECT_THAT(failure("kill -9 $$", ""), HasSubstr("was killed by signal Killed"));
  EXPECT_EQ(failure("true", "echo rastercheck: there is none; exit 2"),
            "rastercheck run: ended with exit code 2; its output: rastercheck: there is none");
  EXPECT_THAT(failure("true", "exit 130"), HasSubstr("ended with exit code 130"));
  for (const char* code : {"0", "1", "5"}) {  // it judged, but left no run.json
    EXPECT_THAT(failure("true", std::string("exit ") + code), HasSubstr("abc/run.json: cannot"));
  }
}

TEST_F(DrawCommit, AsksForTheLawsAndKeepsCases) {
  failure("true", "echo \"$@\"");
  EXPECT_EQ(folder_.content("abc/run.log"),
            "run --backend cpu --backend plugin:./p.so --cases 12 --seed 7 --jobs 1 --output " +
                folder_.path("abc") +
                " --format json --quiet --property a law --shrink-tries 0 --keep-cases\n");
}

TEST(CommitDrawing, PlanReadsAsItWasWritten) {
  const TemporaryFolder folder;
  BisectPlan plan;
  plan.folder = folder.path();
  plan.build = {"make", "with spaces and \"quotes\""};
  plan.program = "/proc/7/exe";
  plan.plan.properties = {"@(a|b)"};
  plan.jobs = 3;
  ASSERT_TRUE(write_plan(plan));
  const auto read = read_plan(folder.path());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->build, plan.build);
  EXPECT_EQ(read->program, plan.program);
  EXPECT_EQ(read->plan, plan.plan);
  EXPECT_EQ(read->jobs, plan.jobs);
  EXPECT_EQ(read->folder, plan.folder);
  folder.put("plan.json", "{}");
  EXPECT_FALSE(read_plan(folder.path()));
}

TEST(CommitDrawing, JudgedCommitsAreReadWhileTheyAreWritten) {
  const TemporaryFolder folder;
  EXPECT_TRUE(read_judged(folder.path()).empty());
  ASSERT_TRUE(note(folder.path(), {"0123456789abcdef", CommitVerdict::skipped, "two\nlines"}));
  ASSERT_TRUE(note(folder.path(), {"fedcba", CommitVerdict::good, ""}));
  folder.put("judged.jsonl", folder.content("judged.jsonl") + "{\"commit\": \"012");
  const std::vector<JudgedCommit> judged = read_judged(folder.path());
  ASSERT_EQ(judged.size(), 2U);
  EXPECT_EQ(judged_text(judged[0]), "0123456789 skipped: two\\nlines");
  EXPECT_EQ(judged_text(judged[1]), "fedcba good");
}

TEST(CommitDrawing, WrongPlansEndABisection) {
  const TemporaryFolder folder;
  EXPECT_EQ(judge_commit(folder.path(), {}), 128);
}

}  // namespace
}  // namespace rastercheck::gate::commit_drawing_test
