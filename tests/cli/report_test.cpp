#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::report_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The folder "out" of a run with a violation and a scene.
class Report : public testing::Test {
 protected:
  void SetUp() override {
    const std::string file = folder_.put("corpus/square.json", square_case());
    const Outcome outcome =
        run_damaged_program({"run", "--corpus", folder_.path("corpus"), "--cases", "10",
                             "--backend", "damaged", "--shrink-tries", "20", "--property", "co*",
                             "--scene", file, "--output", out(), "--seed", "1"});
    ASSERT_EQ(outcome.code, 1) << outcome;
  }
  std::string out() const { return folder_.path("out"); }
  TemporaryFolder folder_;
};

// Kills: a report that needs something that run.json does not hold.
TEST_F(Report, IsMadeAgainFromRunJsonAlone) {
  const std::vector<std::string> files = folder_.files("out");
  ASSERT_GE(files.size(), 4U);
  std::vector<std::string> before;
  for (const std::string& file : files) before.push_back(folder_.content("out/" + file));
  for (const std::string& file : files) {
    if (file != "run.json") std::filesystem::remove(folder_.path("out/" + file));
  }
  // This program does not know the backend, just like another machine that gets the file.
  const Outcome outcome = run_program({"report", out()});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.out, "Report: " + out() + "/report.html\n");
  EXPECT_EQ(folder_.files("out"), files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_TRUE(folder_.content("out/" + files[i]) == before[i]) << files[i];
  }
}

TEST_F(Report, OfSomeFormatsLeavesTheRest) {
  std::filesystem::remove(folder_.path("out/summary.md"));
  std::filesystem::remove(folder_.path("out/report.html"));
  const Outcome outcome = run_program({"report", out(), "--format", "markdown"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.out, "Report: " + out() + "\n");
  EXPECT_TRUE(std::filesystem::exists(folder_.path("out/summary.md")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out/report.html")));
}

TEST_F(Report, QuietlyPrintsNothing) {
  const Outcome outcome = run_program({"report", out(), "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(Report, RefusesAFormatThatThereIsNot) {
  const Outcome outcome = run_program({"report", out(), "--format", "pdf"});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("--format: pdf not in {bencher,"));
}

TEST(ReportCommand, NamesARunThatCannotBeRead) {
  const TemporaryFolder folder;
  const Outcome none = run_program({"report", folder.path()});
  EXPECT_TRUE(is_failure(none, 2)) << none;
  EXPECT_EQ(none.err, "rastercheck: " + folder.path("run.json") +
                          ": cannot be read: No such file or directory\n");
  folder.put("run.json", R"({"format": "rastercheck-run", "version": 1})");
  EXPECT_THAT(run_program({"report", folder.path()}).err,
              HasSubstr("run.json: /version: version must be 3"));
  folder.put("run.json", "{");
  EXPECT_TRUE(is_failure(run_program({"report", folder.path()}), 2));
  // Nothing is written if the file cannot be read.
  EXPECT_THAT(folder.files(), ElementsAre("run.json"));
}

}  // namespace
}  // namespace rastercheck::cli::report_test
