// Known defects of a driver, tested through the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/properties/campaign/known_list.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::known_test {
namespace {

using nlohmann::json;
using properties::kKnownList;
using properties::put_known;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

/// A campaign of one law on a damaged driver, with a list of its known defects.
class Known : public testing::Test {
 protected:
  Known() { put_known(known_); }

  std::vector<std::string> arguments(const std::string& backend) const {
    return {"run",    "--backend", backend,   "--property",  kCoverage,  "--cases",     "30",
            "--seed", "1",         "--known", known_.path(), "--output", output_.path()};
  }
  Outcome run_known(const std::string& backend, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = arguments(backend);
    all.insert(all.end(), more.begin(), more.end());
    return run_damaged_program(all);
  }
  json run_json() const { return json::parse(output_.content("run.json")); }

  TemporaryFolder known_;
  TemporaryFolder output_;
};

TEST_F(Known, DefectsAreCountedAndAreNoViolations) {
  const Outcome outcome = run_known("damaged:driver");
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("Known defects of damaged:driver: damaged-1 in "));
  EXPECT_THAT(output_.content("summary.md"), HasSubstr("## Known defects"));
  EXPECT_THAT(output_.content("report.html"), HasSubstr("A scissor loses the last fragment."));
  EXPECT_THAT(run_json().at("counterexamples"), IsEmpty());
  EXPECT_EQ(run_json().at("known").at(0).at("driver_version"), "1");
  std::uint64_t known = 0;
  const json run = run_json();
  for (const json& record : run.at("records")) {
    EXPECT_EQ(record.at("cases").at("violations"), 0);
    if (record.contains("known")) known += record.at("known").at("damaged-1").get<std::uint64_t>();
  }
  EXPECT_GT(known, 1U);  // more than the entry's own case
}

TEST_F(Known, CountsAreTheSameForAnySplit) {
  ASSERT_EQ(run_known("damaged:driver").code, 0);
  const std::string alone = without_environment(output_.content("run.json"));
  ASSERT_EQ(run_known("damaged:driver", {"--jobs", "2"}).code, 0);
  EXPECT_EQ(without_environment(output_.content("run.json")), alone);
}

TEST_F(Known, DefectsAreViolationsWithoutTheList) {
  const Outcome outcome =
      run_damaged_program({"run", "--backend", "damaged:driver", "--property", kCoverage, "--cases",
                           "0", "--no-known", "--jobs", "2", "--output", output_.path()});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_FALSE(run_json().contains("known"));
}

// Kills: a list that hides defects that are not on it.
TEST_F(Known, DefectsDoNotHideNewOnes) {
  const Outcome outcome = run_known("damaged:worse");
  EXPECT_EQ(outcome.code, 1) << outcome;
  const json run = run_json();
  const json& found = run.at("counterexamples");
  ASSERT_GE(found.size(), 1U);
  for (const json& one : found) {
    EXPECT_FALSE(one.at("case").contains("scissor"));
    EXPECT_TRUE(one.at("shrinking").at("is_least"));
  }
}

TEST_F(Known, DefectThatIsGoneIsAStaleList) {
  const Outcome outcome = run_known("damaged:mended", {"--quiet"});
  EXPECT_EQ(outcome.code, 1) << outcome;
  const std::string sentence =
      "Unexpected pass: the case of damaged-1 no longer violates "
      "coverage-obeys-the-contract on damaged:mended; the list of known defects is wrong, which "
      "counts as a "
      "violation.";
  EXPECT_THAT(outcome.out, HasSubstr(sentence));
  EXPECT_THAT(output_.content("report.html"), HasSubstr(sentence));
  EXPECT_THAT(output_.content("summary.md"), HasSubstr("unexpected pass"));
  EXPECT_EQ(run_json().at("unexpected_passes").size(), 1U);
}

TEST_F(Known, DefectThatIsGoneInAnotherVersionIsAWarning) {
  const Outcome outcome = run_known("damaged:newer");
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out,
              HasSubstr("this is only a warning, because the list is for another version"));
  EXPECT_THAT(outcome.out,
              HasSubstr("The known defects of damaged:newer were found with 1; this is 2."));
}

// Kills: a list reported as wrong because a contract file permits what its entries violate.
TEST_F(Known, ContractFileMakesNoListStale) {
  const std::string lax =
      known_.put("lax.json", R"({"format": "rastercheck-contract", "version": 1})");
  const Outcome mended = run_known("damaged:mended", {"--contract", lax});
  EXPECT_EQ(mended.code, 0) << mended;
  EXPECT_FALSE(run_json().contains("unexpected_passes"));
  const Outcome damaged = run_known("damaged:driver", {"--contract", lax});
  EXPECT_EQ(damaged.code, 0) << damaged;
  EXPECT_THAT(damaged.out, HasSubstr("Known defects of damaged:driver: damaged-1 in "));
}

TEST_F(Known, DefectIsNamedWhereItIsReplayed) {
  const std::string file = known_.path("damaged/known/damaged-1.json");
  const Outcome known = run_damaged_program({"replay", "--known", known_.path(), file});
  EXPECT_EQ(known.code, 0) << known;
  EXPECT_THAT(known.out, HasSubstr("missing (as found); known: damaged-1\n"));
  const Outcome none = run_damaged_program({"replay", "--no-known", file});
  EXPECT_EQ(none.code, 1) << none;
  EXPECT_THAT(none.out, Not(HasSubstr("; known")));
}

TEST_F(Known, ListsThatCannotBeReadEndTheRun) {
  std::string list = kKnownList;
  list.replace(list.find("section 1"), 9, "");
  put_known(known_, list);
  const Outcome outcome = run_known("damaged:driver");
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("known.json: /entries/0/rule: must not be empty"));
}

// Kills: a misspelt folder treated as a folder without lists.
TEST_F(Known, ListsAreWhereTheyAreSaidToBe) {
  for (const char* const command : {"run", "list"}) {
    const Outcome outcome = run_program({command, "--known", known_.path() + "-elsewhere"});
    EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
    EXPECT_THAT(outcome.err, HasSubstr("--known"));
  }
}

// Kills: resuming with another list, which makes other tasks.
TEST_F(Known, ListsMayNotChangeUnderARunThatGoesOn) {
  RunningProgram running({"run", "--backend", "damaged:slow", "--backend", "damaged:driver",
                          "--property", kCoverage, "--cases", "100000", "--seed", "1", "--known",
                          known_.path(), "--output", output_.path()});
  while (output_.content("unfinished.json").empty()) {
  }
  running.kill(9);
  running.wait();
  std::string list = kKnownList;
  list.replace(list.find("section 1"), 9, "section 2");
  put_known(known_, list);
  const Outcome outcome = run_damaged_program({"run", "--resume", "--output", output_.path()});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("changed since the run was started"));
}

TEST_F(Known, DefectsAreListed) {
  const Outcome outcome = run_program({"list", "known", "--known", known_.path(), "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  const json listed = json::parse(outcome.out);
  const json& row = listed.at("known").at(0);
  EXPECT_EQ(row.at("name"), "damaged-1");
  EXPECT_EQ(row.at("driver"), "damaged");
  EXPECT_EQ(row.at("version"), "1");
}

}  // namespace
}  // namespace rastercheck::cli::known_test
