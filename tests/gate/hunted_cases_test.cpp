#include "gate/hunted_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/case_writer.h"
#include "gate/sections.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/workers.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::gate::hunted_cases_test {
namespace {

using properties::square;
using testing::HasSubstr;

const std::string kFloat = "cpu:precision=float32";

records::Plan small_plan() {
  records::Plan plan;
  plan.seed = 1;
  plan.cases_per_law = 5;
  plan.backends = {kFloat};
  plan.laws = {"the-nearest-fragment-wins", "values-stay-within-the-bound"};
  plan.keeps_cases = true;
  return plan;
}

/// Runs the plan with that corpus in this process.
records::Run run_of(const records::Plan& plan, const std::vector<cases::Case>& corpus) {
  properties::TaskRunner runner(plan, corpus);
  properties::Findings findings;
  const Result<void> done = properties::run_tasks(runner, properties::tasks_of(plan, corpus.size()),
                                                  [&](std::size_t /*task*/, auto found) {
                                                    merge(findings, std::move(found));
                                                    return true;
                                                  });
  EXPECT_TRUE(done) << to_string(done.error());
  records::Run run;
  run.plan = plan;
  run.records = std::move(findings.records);
  run.cases = std::move(findings.cases);
  return run;
}

/// A worst case: one triangle of the square, with uneven values.
cases::Case worst_case() {
  cases::Case worst = square();
  worst.name = "smooth-ordinary-seed-1-step-7";
  worst.triangles.resize(1);
  return worst;
}

/// A corpus of one case, in memory and as a folder.
struct Corpus {
  Corpus() {
    cases.front().name = "square";
    folder.put("square.json", cases::to_json(cases.front()));
    conduct.corpus = folder.path();
  }
  TemporaryFolder folder;
  std::vector<cases::Case> cases{square()};
  properties::Conduct conduct;
};

// Kills: figures, digests or counts that a run with these cases would not have.
TEST(AddHunted, GivesTheSectionOfARunWithTheCases) {
  Corpus corpus;
  records::Plan plan = small_plan();
  auto section = section_of(run_of(plan, corpus.cases), kFloat);
  ASSERT_TRUE(section) << to_string(section.error());
  const records::BaselineSection before = *section;
  const auto added = add_hunted(*section, kFloat, {worst_case()}, corpus.conduct);
  ASSERT_TRUE(added) << to_string(added.error());

  plan.hunted = {worst_case()};
  corpus.cases.push_back(worst_case());
  const auto whole = section_of(run_of(plan, corpus.cases), kFloat);
  ASSERT_TRUE(whole) << to_string(whole.error());
  EXPECT_EQ(*section, *whole);
  EXPECT_FALSE(*section == before);
  EXPECT_EQ(section->corpus.at(1), "smooth-ordinary-seed-1-step-7");
  EXPECT_EQ(section->laws.at("values-stay-within-the-bound").count, 7U);

  // Further cases come after those before.
  cases::Case more = worst_case();
  more.name = "more";
  ASSERT_TRUE(add_hunted(*section, kFloat, {more}, corpus.conduct));
  EXPECT_EQ(section->corpus.at(2), "more");
  EXPECT_EQ(section->plan.hunted.size(), 2U);
}

TEST(AddHunted, RefusesAnotherCorpusAndTooManyCases) {
  Corpus corpus;
  auto section = section_of(run_of(small_plan(), corpus.cases), kFloat);
  ASSERT_TRUE(section);
  const records::BaselineSection before = *section;
  const auto full = add_hunted(*section, kFloat, std::vector(500, worst_case()), corpus.conduct);
  ASSERT_FALSE(full);
  EXPECT_THAT(full.error().reason, HasSubstr("has no room for 500 more worst cases"));
  corpus.folder.put("another.json", cases::to_json(square()));
  const auto other = add_hunted(*section, kFloat, {worst_case()}, corpus.conduct);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().reason, HasSubstr("has other cases than the baseline's section"));
  EXPECT_EQ(*section, before);
}

}  // namespace
}  // namespace rastercheck::gate::hunted_cases_test
