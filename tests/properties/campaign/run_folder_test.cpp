#include "properties/campaign/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/case_writer.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::properties::run_folder_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage-obeys-the-contract";
constexpr const char* kFile = "counterexamples/coverage-obeys-the-contract-damaged-missing.json";

records::Plan plan() {
  records::Plan plan{7, 25, {"damaged"}, {kCoverage}};
  plan.corpus = "corpus";
  return plan;
}

/// A run that was interrupted after it had found one counterexample.
Checkpoint unfinished() {
  Checkpoint checkpoint;
  checkpoint.plan = plan();
  checkpoint.corpus_digest = digest_of({square()});
  checkpoint.program = "1";
  checkpoint.is_done.resize(tasks_of(checkpoint.plan, 1).size());
  records::Counterexample one;
  one.source = square();
  one.source.found = cases::Found{kCoverage, "damaged", "missing", 7, 4};
  checkpoint.findings.counterexamples = {one};
  return checkpoint;
}

class RunFolder : public testing::Test {
 protected:
  Warn warn() {
    return [this](const Error& error) { warnings_.push_back(to_string(error)); };
  }
  std::string resume_error(const Checkpoint& checkpoint) const {
    folder_.put("unfinished.json", to_json(checkpoint));
    const auto read = resume_run(folder_.path(), "1");
    return read ? "" : to_string(read.error());
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(RunFolder, ThatIsEmptyBeginsAtNothing) {
  const Checkpoint start = begin_run(plan(), folder_.path("none"), warn()).value();
  EXPECT_EQ(start.plan, plan());
  EXPECT_THAT(start.saved, IsEmpty());
  EXPECT_THAT(start.is_done, IsEmpty());
  EXPECT_THAT(warnings_, IsEmpty());
}

// Kills: deleting an unfinished run's counterexamples together with the run's file.
TEST_F(RunFolder, OfAnUnfinishedRunKeepsWhatItHadFound) {
  folder_.put("unfinished.json", to_json(unfinished()));
  const Checkpoint start = begin_run(plan(), folder_.path(), warn()).value();
  const cases::Case found = unfinished().findings.counterexamples[0].source;
  EXPECT_THAT(start.saved, ElementsAre(found));
  EXPECT_EQ(folder_.content(kFile), cases::to_json(found));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("counterexamples kept from it: 1")));

  // A file that is there already holds the shrunk case and is kept.
  folder_.put(kFile, "mine");
  begin_run(plan(), folder_.path(), warn()).value();
  EXPECT_EQ(folder_.content(kFile), "mine");
}

TEST_F(RunFolder, WithFilesThatCannotBeReadIsWarnedOf) {
  folder_.put("unfinished.json", "{");
  folder_.put("counterexamples/broken.json", "{");
  ASSERT_TRUE(begin_run(plan(), folder_.path(), warn()));
  EXPECT_THAT(warnings_,
              ElementsAre(HasSubstr("unfinished.json: 1:"), HasSubstr("broken.json: 1:")));
}

// Kills: resuming a run as a different one.
TEST_F(RunFolder, GoesOnOnlyAsItWasBegun) {
  EXPECT_THAT(to_string(resume_run(folder_.path(), "1").error()),
              HasSubstr("no run was interrupted"));
  EXPECT_EQ(resume_error(unfinished()), "");
  EXPECT_EQ(resume_run(folder_.path(), "1").value(), unfinished());
  EXPECT_THAT(to_string(resume_run(folder_.path(), "2").error()), HasSubstr("/program: "));
  Checkpoint other = unfinished();
  other.plan.scene = "-";
  EXPECT_THAT(resume_error(other), HasSubstr("/plan/scene: was read from standard input"));
  other = unfinished();
  other.plan.laws.emplace_back("no law");
  EXPECT_THAT(resume_error(other), HasSubstr("/plan/properties: no property is called 'no law'"));
}

TEST_F(RunFolder, GoesOnWithTheSameCorpusOnly) {
  EXPECT_TRUE(check_same(unfinished(), {square()}, {}));
  EXPECT_EQ(to_string(check_same(unfinished(), {}, {}).error()),
            "corpus: changed since the run was started");
  cases::Case other = square();
  other.name = "another";
  EXPECT_FALSE(check_same(unfinished(), {other}, {}));
  Checkpoint fewer = unfinished();
  fewer.is_done.pop_back();
  EXPECT_FALSE(check_same(fewer, {square()}, {}));
}

}  // namespace
}  // namespace rastercheck::properties::run_folder_test
