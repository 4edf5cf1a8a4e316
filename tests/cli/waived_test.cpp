// Waivers and expectation lists, tested through the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::waived_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kCoverage = "coverage-obeys-the-contract";
constexpr const char* kDegenerate = "what-is-degenerate-covers-nothing";

class Waived : public testing::Test {
 protected:
  Outcome run(const std::string& backend, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"run",        "--backend", backend,       "--property", kCoverage,
                                 "--property", kDegenerate, "--cases",     "30",         "--seed",
                                 "1",          "--output",  output_.path()};
    all.insert(all.end(), more.begin(), more.end());
    return run_damaged_program(all);
  }
  /// Waives a violation that a run found; returns the outcome of `known add`.
  Outcome add(const std::vector<std::string>& more = {}) const {
    std::string file;
    for (const auto& entry : std::filesystem::directory_iterator(output_.path("counterexamples"))) {
      if (entry.path().extension() == ".json") file = entry.path().string();
    }
    std::vector<std::string> all{"known", "add", file, "--reason", "For now.", "--known", list()};
    all.insert(all.end(), more.begin(), more.end());
    return run_damaged_program(all);
  }
  std::string list() const { return lists_.path("mine.json"); }
  json list_json() const { return json::parse(lists_.content("mine.json")); }

  TemporaryFolder lists_;
  TemporaryFolder output_;
};

TEST_F(Waived, RunEndsWellOnceItsOneFaultIsKnown) {
  ASSERT_EQ(run("damaged:driver").code, 1);
  const Outcome added = add({"--until", "2999-12-31"});
  EXPECT_EQ(added.code, 0) << added;
  EXPECT_THAT(added.out, HasSubstr("damaged-1 in " + list()));
  EXPECT_THAT(added.out, HasSubstr(R"("scissor":true)"));
  const json entry = list_json().at("entries").at(0);
  EXPECT_EQ(entry.at("backends"), json({"damaged:driver"}));
  EXPECT_EQ(entry.at("reason"), "For now.");

  const Outcome again = run("damaged:driver", {"--known", list()});
  EXPECT_EQ(again.code, 0) << again;
  EXPECT_THAT(again.out, HasSubstr("Known defects of damaged:driver: damaged-1 in "));
  ASSERT_EQ(run("damaged:driver").code, 1);
  const Outcome twice = add();
  EXPECT_TRUE(is_failure(twice, 2)) << twice;
  EXPECT_THAT(twice.err, HasSubstr("is already known: damaged-1"));
  // The waiver does not cover another backend's fault.
  EXPECT_EQ(run("damaged:worse", {"--known", list()}).code, 1);
}

TEST_F(Waived, CountsAgainAfterItsLastDay) {
  ASSERT_EQ(run("damaged:driver").code, 1);
  ASSERT_EQ(add({"--until", "2001-01-31"}).code, 0);
  const Outcome again = run("damaged:driver", {"--known", list()});
  EXPECT_EQ(again.code, 1) << again;
  EXPECT_THAT(
      again.out,
      HasSubstr(
          "Known defect damaged-1 of damaged:driver expired after 2001-01-31 and counts again"));
}

TEST_F(Waived, IsToldOfWhenItNoLongerShows) {
  ASSERT_EQ(run("damaged:driver").code, 1);
  ASSERT_EQ(add().code, 0);
  json all = list_json();
  all["entries"][0].erase("backends");
  lists_.put("mine.json", all.dump());
  const Outcome mended = run("damaged:mended", {"--known", list()});
  EXPECT_EQ(mended.code, 0) << mended;
  EXPECT_THAT(mended.out, HasSubstr("Unexpected pass: the case of damaged-1 no longer violates "));
  EXPECT_THAT(mended.out, HasSubstr("; its entry can be removed."));
}

TEST_F(Waived, NeedsAListThatItMayWrite) {
  ASSERT_EQ(run("damaged:driver").code, 1);
  const std::string file =
      output_.path("counterexamples/" + std::string(kCoverage) + "-damaged-driver-missing.json");
  const Outcome none = run_damaged_program({"known", "add", file, "--reason", "R"});
  EXPECT_TRUE(is_failure(none, 2)) << none;
  EXPECT_THAT(none.err, HasSubstr("--known: is required"));
  lists_.put("mine.json", R"({"format": "rastercheck-known", "version": 1, "entries": [],
                              "driver": {"name": "damaged", "version": "1"}})");
  const Outcome driver = add();
  EXPECT_TRUE(is_failure(driver, 2)) << driver;
  EXPECT_THAT(driver.err, HasSubstr("mine.json: /driver: is a driver's list"));
  lists_.put("mine.json", "{}");
  EXPECT_TRUE(is_failure(add(), 2));
  EXPECT_EQ(lists_.content("mine.json"), "{}");  // the file is kept
  const Outcome day = [&] {
    std::filesystem::remove(list());
    return add({"--until", "tomorrow"});
  }();
  EXPECT_TRUE(is_failure(day, 2)) << day;
  EXPECT_THAT(day.err, HasSubstr("must be a date"));
  EXPECT_THAT(lists_.content("mine.json"), IsEmpty());
}

TEST_F(Waived, ExpectationListsAreWrittenAndRead) {
  ASSERT_EQ(run("damaged:driver").code, 1);
  const std::string name = lists_.path("damaged");
  const Outcome written =
      run_damaged_program({"known", "expect", output_.path(), "--output", name});
  EXPECT_EQ(written.code, 0) << written;
  EXPECT_EQ(lists_.content("damaged-fails.txt"), std::string(kCoverage) + "\n");
  EXPECT_EQ(lists_.content("damaged-flakes.txt"), "");

  const Outcome expected =
      run("damaged:driver", {"--known", name + "-fails.txt", "--known", name + "-flakes.txt"});
  EXPECT_EQ(expected.code, 0) << expected;
  EXPECT_THAT(expected.out,
              HasSubstr("Known defects of damaged:driver: " + std::string(kCoverage)));
  const Outcome passed = run("damaged:mended", {"--known", name + "-fails.txt"});
  EXPECT_EQ(passed.code, 0) << passed;
  EXPECT_THAT(passed.out, HasSubstr("Unexpected pass: " + std::string(kCoverage) +
                                    " was expected to fail on damaged:mended"));
}

// Kills: counting a waived case as a violation because a line of another list matches it first.
TEST_F(Waived, ListsOfBothSortsGoTogether) {
  ASSERT_EQ(run("damaged:driver").code, 1);
  ASSERT_EQ(add().code, 0);
  const std::string fails = lists_.put("damaged-fails.txt", std::string(kCoverage) + "\n");
  const Outcome both = run("damaged:driver", {"--known", fails, "--known", list()});
  EXPECT_EQ(both.code, 0) << both;
}

// Kills: a law that is skipped without a message; a skipped law that counts as not checked, which
// gives exit code 5.
TEST_F(Waived, SkippedPropertiesAreSaidToBe) {
  const std::string skips = lists_.put("damaged-skips.txt", std::string(kCoverage) + "\n");
  const Outcome outcome = run("damaged:driver", {"--known", skips});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out,
              HasSubstr("Skipped on damaged:driver by " + skips + ": 1 property, " + kCoverage));
  EXPECT_THAT(output_.content("report.html"), HasSubstr("Skipped on damaged:driver"));
  const json records = json::parse(output_.content("run.json")).at("records");
  for (const json& record : records) EXPECT_EQ(record.at("property"), kDegenerate);
  // A line for another backend skips no law of this one.
  lists_.put("damaged-skips.txt", std::string("cpu/") + kCoverage + "\n");
  EXPECT_EQ(run("damaged:driver", {"--known", skips}).code, 1);
}

TEST_F(Waived, RefusesExpectationsForUnknownLaws) {
  const std::string fails = lists_.put("damaged-fails.txt", "no-such-law\n");
  const Outcome outcome = run("damaged:driver", {"--known", fails});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr(fails + ": no-such-law: no property is called 'no-such-law'"));
}

}  // namespace
}  // namespace rastercheck::cli::waived_test
