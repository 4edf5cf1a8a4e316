#include "reports/write.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/json.h"
#include "reports/format.h"
#include "reports/run_reader.h"
#include "tests/reports/report_files.h"
#include "tests/reports/sample_run.h"
#include "tests/temporary_folder.h"

namespace rastercheck::reports::write_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A run's folder that does not exist yet.
class WriteReports : public ::testing::Test {
 protected:
  std::string directory() const { return folder_.path("out"); }

  std::vector<std::string> files() const { return folder_.files("out"); }

  void put(const std::string& name, const std::string& content) const {
    folder_.put("out/" + name, content);
  }

  TemporaryFolder folder_;
};

constexpr const char* kThird =
    "counterexamples/values-are-within-bounds-method-float32-beyond-bound.json";
constexpr const char* kOther =
    "counterexamples/values-are-within-bounds-method-float32-missing.json";
constexpr const char* kDifference =
    "differences/values-are-within-bounds-method-float32-wrong-cpu-right.json";
constexpr const char* kEarlierDifference =
    "differences/earlier/values-are-within-bounds-method-float32-wrong-cpu-right.json";
constexpr const char* kEarlierOther =
    "counterexamples/earlier/values-are-within-bounds-method-float32-missing.json";
constexpr const char* kEarlierThird =
    "counterexamples/earlier/values-are-within-bounds-method-float32-beyond-bound.json";

TEST_F(WriteReports, WritesWhatTheContractLists) {
  ASSERT_TRUE(write_reports(sample_run(), directory(), default_format_names()).has_value());
  EXPECT_EQ(files(), with_reports({kThird, kOther, kDifference}));
  EXPECT_EQ(read_run(directory() + "/run.json").value(), sample_run());
  EXPECT_EQ(cases::read_case(directory() + "/" + kThird).value(),
            sample_run().counterexamples[0].source);
}

// Kills: a report that names a case of an earlier run.
TEST_F(WriteReports, PutsEarlierDifferencesAside) {
  records::Run run = sample_run();
  ASSERT_TRUE(write_reports(run, directory(), {}));
  EXPECT_EQ(cases::read_case(directory() + "/" + kDifference).value(), run.differences[0].source);
  put("differences/mine.json", "{}");
  run.differences.clear();
  ASSERT_TRUE(write_reports(run, directory(), {}));
  EXPECT_THAT(files(), ElementsAre(kThird, kOther, kEarlierDifference, "differences/mine.json"));
}

TEST_F(WriteReports, WritesTheFormatsAskedFor) {
  ASSERT_TRUE(write_reports(sample_run(), directory(), std::vector<std::string>{"markdown"}));
  EXPECT_THAT(files(), ElementsAre(kThird, kOther, kDifference, "summary.md"));
}

TEST_F(WriteReports, AMisspeltFormatStopsItBeforeAnythingIsWritten) {
  const Result<void> done =
      write_reports(sample_run(), directory(), std::vector<std::string>{"markdown", "htlm"});
  ASSERT_FALSE(done.has_value());
  EXPECT_THAT(to_string(done.error()), HasSubstr("htlm: unknown report format"));
  EXPECT_FALSE(fs::exists(directory()));
}

// Kills: counterexamples of an earlier run that look like those of this run, or are lost.
TEST_F(WriteReports, PutsTheCounterexamplesOfEarlierRunsAside) {
  ASSERT_TRUE(write_reports(sample_run(), directory(), default_format_names()).has_value());
  records::Run later = sample_run();
  later.plan.laws = {"values are within bounds"};
  later.plan.backends = {"method:float32"};
  later.counterexamples.erase(later.counterexamples.begin());
  records::Run interrupted = later;
  interrupted.cases_left = 1;  // these cases may not have been checked
  ASSERT_TRUE(write_reports(interrupted, directory(), {}).has_value());
  EXPECT_EQ(files(), with_reports({kThird, kOther, kDifference}));
  records::Run shard = later;
  shard.plan.shard = {2, 7};  // the first shard checks these cases
  ASSERT_TRUE(write_reports(shard, directory(), {}).has_value());
  EXPECT_EQ(files(), with_reports({kThird, kOther, kDifference}));
  ASSERT_TRUE(write_reports(later, directory(), default_format_names()).has_value());
  EXPECT_EQ(files(), with_reports({kEarlierThird, kOther, kDifference}));
}

// Kills: old counterexamples that `replay counterexamples/*.json` takes for those of this run.
TEST_F(WriteReports, PutsThoseOfOtherLawsAndBackendsAside) {
  ASSERT_TRUE(write_reports(sample_run(), directory(), {}).has_value());
  records::Run other;
  other.plan.laws = {"values are within bounds"};
  other.plan.backends = {"cpu"};
  ASSERT_TRUE(write_reports(other, directory(), {}).has_value());
  EXPECT_THAT(files(), ElementsAre(kEarlierThird, kEarlierOther, kEarlierDifference));
}

// Kills: moving files only because of the ending of their name; moving every case file.
TEST_F(WriteReports, LeavesWhatItDidNotWrite) {
  cases::Case without_found = sample_case("law", "cpu", 1);
  without_found.found.reset();
  put("counterexamples/law-cpu-extra.json", cases::to_json(without_found));
  put("counterexamples/--.json", cases::to_json(without_found));  // named by an empty `found`
  put("counterexamples/mine.json", cases::to_json(sample_case("law", "cpu", 2)));
  put("counterexamples/law-cpu-infinite.json", "no case");
  put("counterexamples/notes.txt", "");
  put("law-cpu-missing.json", cases::to_json(sample_case("law", "cpu", 4)));
  put("counterexamples/law-cpu-missing.json", cases::to_json(sample_case("law", "cpu", 5)));
  records::Run run;
  run.plan.laws = {"law"};
  run.plan.backends = {"cpu"};
  ASSERT_TRUE(write_reports(run, directory(), {}).has_value());
  EXPECT_THAT(files(),
              ElementsAre("counterexamples/--.json", "counterexamples/earlier/law-cpu-missing.json",
                          "counterexamples/law-cpu-extra.json",
                          "counterexamples/law-cpu-infinite.json", "counterexamples/mine.json",
                          "counterexamples/notes.txt", "law-cpu-missing.json"));
}

TEST_F(WriteReports, NamesTheFileThatCannotBeWritten) {
  put("summary.md/in-the-way", "");
  const Result<void> done = write_reports(sample_run(), directory(), default_format_names());
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(to_string(done.error()),
            directory() + "/summary.md: cannot be written: Is a directory");
  // No unfinished file stays behind.
  for (const std::string& file : files()) EXPECT_FALSE(file.ends_with(".partial")) << file;
}

TEST_F(WriteReports, NamesAFolderThatCannotBeMade) {
  folder_.put("out", "a file");
  const Result<void> done = write_reports(sample_run(), directory(), default_format_names());
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(to_string(done.error()), directory() + ": cannot be made: Not a directory");
}

// Kills: one counterexample silently replacing another.
TEST_F(WriteReports, RefusesTwoCounterexamplesOfOneName) {
  records::Run run;
  run.counterexamples = {sample_counterexample(3), sample_counterexample(3)};
  const Result<void> done = write_reports(run, directory(), {});
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(to_string(done.error()),
            directory() + "/" + kThird + ": two cases would have this name");
}

}  // namespace
}  // namespace rastercheck::reports::write_test
