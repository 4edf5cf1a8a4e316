// `rastercheck cases --out` and `judge --drawn`: one machine draws, another judges.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::drawn_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Cases of one property, drawn by `render --json` of a backend.
class DrawnCases {
 public:
  explicit DrawnCases(const std::string& backend = "cpu") {
    folder_.put("empty/README", "");
    const Outcome made =
        run_program({"cases", "--out", path("cases"), "--property", "values-stay-within-the-bound",
                     "--cases", "6", "--seed", "1", "--corpus", path("empty")});
    EXPECT_EQ(made.code, 0) << made;
    EXPECT_THAT(made.out, HasSubstr("6 cases are in " + path("cases")));
    const Outcome drawn = run_shell("cd '" + path("cases") +
                                    "' && while read -r name; do \"$PROGRAM\" render "
                                    "cases/$name.json --json --backend " +
                                    backend + " >drawn/$name.json || exit 1; done <list.txt");
    EXPECT_EQ(drawn.code, 0) << drawn;
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  Outcome judge(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"judge",    "--drawn",   path("cases"),
                                   "--output", path("out"), "--all"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }

  /// The path of the first drawing, by file name.
  std::string first_drawing() const {
    return "cases/drawn/" + folder_.files("cases/drawn").front();
  }
  TemporaryFolder& folder() { return folder_; }

 private:
  TemporaryFolder folder_;
};

TEST(Drawn, IsJudgedAsIfItHadBeenDrawnHere) {
  const DrawnCases drawn;
  const Outcome judged = drawn.judge();
  EXPECT_EQ(judged.code, 0) << judged;
  EXPECT_EQ(judged.err, "");
  const Outcome here = run_program({"run", "--property", "values-stay-within-the-bound", "--cases",
                                    "6", "--seed", "1", "--corpus", drawn.path("empty"), "--power",
                                    "0", "--output", drawn.path("here"), "--all"});
  const auto records = [&drawn](const std::string& folder) {
    std::ifstream file(drawn.path(folder + "/run.json"));
    json found = json::parse(file)["records"];
    for (json& record : found) record.erase("backend");
    return found;
  };
  EXPECT_FALSE(records("out").empty());
  EXPECT_EQ(records("out"), records("here"));
}

TEST(Drawn, FindsWhatIsWrong) {
  DrawnCases drawn("method:screen-linear");
  const Outcome judged = drawn.judge();
  EXPECT_EQ(judged.code, 1) << judged;
  EXPECT_THAT(judged.out, HasSubstr("violated"));
  EXPECT_TRUE(std::filesystem::exists(drawn.path("out/report.html")));
}

TEST(Drawn, SaysHowManyDrawingsAreMissing) {
  DrawnCases drawn;
  std::filesystem::remove(drawn.path(drawn.first_drawing()));
  const Outcome judged = drawn.judge();
  EXPECT_EQ(judged.code, 0) << judged;
  EXPECT_THAT(judged.err, HasSubstr("1 of 6 cases have no drawing and are not judged"));
  EXPECT_THAT(judged.out, HasSubstr("the folder has no drawing of the case"));
  std::filesystem::remove_all(drawn.path("cases/drawn"));
  EXPECT_EQ(drawn.judge().code, 5);
}

TEST(Drawn, TakesABrokenDrawingForAFailedOne) {
  DrawnCases drawn;
  drawn.folder().put(drawn.first_drawing(), "[");
  const Outcome judged = drawn.judge();
  EXPECT_EQ(judged.code, 1) << judged;
  EXPECT_THAT(judged.out, HasSubstr(std::filesystem::path(drawn.first_drawing()).filename()));
}

TEST(Drawn, IsHeldAgainstABaseline) {
  const DrawnCases drawn;
  ASSERT_EQ(drawn.judge({"--keep-cases"}).code, 0);
  const std::string baseline = drawn.path("baseline.json");
  const Outcome saved =
      run_program({"baseline", "save", drawn.path("out/run.json"), "--output", baseline});
  ASSERT_EQ(saved.code, 0) << saved;
  const Outcome same = drawn.judge({"--baseline", baseline});
  EXPECT_EQ(same.code, 0) << same;
  EXPECT_THAT(same.out, HasSubstr("same"));
}

TEST(Drawn, RefusesFoldersThatHoldNoCampaign) {
  const TemporaryFolder folder;
  EXPECT_TRUE(is_failure(run_program({"judge", "--drawn", folder.path()}), 2));
  folder.put("file", "");
  EXPECT_TRUE(is_failure(run_program({"cases", "--out", folder.path()}), 2));
  EXPECT_EQ(run_program({"judge", "--drawn", folder.path(), "case.json", "picture.png"}).code, 2);
  EXPECT_EQ(run_program({"judge", "case.json"}).code, 2);
  folder.put("campaign.json",
             R"({"format": "rastercheck-campaign", "version": 1, "program": "0",
                 "plan": {"seed": 1, "cases_per_property": 1, "backends": ["drawn:x"]}})");
  folder.put("list.txt", "");
  const Outcome nested =
      run_program({"judge", "--drawn", folder.path(), "--output", folder.path("out")});
  EXPECT_NE(nested.code, 0) << nested;
  EXPECT_THAT(nested.err, HasSubstr("must draw, and not read drawings"));
}

}  // namespace
}  // namespace rastercheck::cli::drawn_test
