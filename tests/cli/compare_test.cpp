#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::compare_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kLaw = "values-stay-within-the-bound";

/// A method's run, saved as the baseline of "mine", and in the folder "float" the run of the same
/// method in float32.
class Compare : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() = std::make_unique<TemporaryFolder>();
    folder()->put("corpus/square.json", square_case());
    ASSERT_EQ(make_run("method:rational-linear", "double").code, 0);
    ASSERT_EQ(make_run("method:rational-linear-float", "float").code, 0);
    ASSERT_EQ(program({"baseline", "save", path("double"), "--as", "mine", "--output",
                       path("baseline.json"), "--commit", "c0ffee"})
                  .code,
              0);
  }
  static void TearDownTestSuite() { folder().reset(); }

  static std::unique_ptr<TemporaryFolder>& folder() {
    static std::unique_ptr<TemporaryFolder> made;
    return made;
  }
  static std::string path(const std::string& name) { return folder()->path(name); }
  static Outcome program(const std::vector<std::string>& arguments, const std::string& input = "") {
    return run_program(arguments, input);
  }
  static Outcome make_run(const std::string& backend, const std::string& output,
                          const std::string& seed = "1") {
    return program({"run", "--backend", backend, "--property", kLaw, "--cases", "8", "--seed", seed,
                    "--corpus", path("corpus"), "--keep-cases", "--output", path(output),
                    "--quiet"});
  }
  /// A copy of the baseline, which a test may change by approving something.
  static std::string copy(const std::string& name) {
    return folder()->put(name, folder()->content("baseline.json"));
  }
};

TEST_F(Compare, OfTheSameDrawingsFindsNothing) {
  const Outcome outcome =
      program({"compare", path("baseline.json"), path("double"), "--as", "mine"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, AllOf(StartsWith("No regression: "), HasSubstr(" drew the same bits.\n"),
                                 Not(HasSubstr("Worse"))));
  EXPECT_EQ(program({"compare", path("double/run.json"), path("double")}).out.substr(0, 14),
            "No regression:");
}

TEST_F(Compare, OfAWorseOneNamesCasesToReplayAndExplain) {
  const Outcome outcome = program(
      {"compare", path("baseline.json"), path("float"), "--as", "mine", "--output", path("out")});
  EXPECT_EQ(outcome.code, 3) << outcome;
  EXPECT_THAT(outcome.out, AllOf(StartsWith("Regression: "), HasSubstr(": smooth\n    worst 0."),
                                 HasSubstr("\n    misrounded 0% (0 of "), HasSubstr("    exact "),
                                 HasSubstr("Comparison: " + path("out"))));
  const json compare = json::parse(folder()->content("out/compare.json"));
  EXPECT_TRUE(compare["regression"]);
  EXPECT_EQ(compare["comparisons"][0]["before"]["commit"], "c0ffee");
  const json growth = compare["comparisons"][0]["growths"][0];
  const auto size = [](const json& error) {
    return std::max(std::abs(error[0].get<double>()), std::abs(error[1].get<double>()));
  };
  EXPECT_GT(size(growth["after"]["error"]), size(growth["before"]["error"]));
  const std::string file = path("out/" + growth["file"].get<std::string>());
  // The saved file can be replayed: the case still satisfies its law, and `explain` shows the drawn
  // value that the comparison reports.
  const Outcome replayed = program({"replay", file, "--quiet"});
  EXPECT_EQ(replayed.code, 0) << replayed;
  EXPECT_THAT(replayed.out, HasSubstr(std::string(kLaw) + ", method:rational-linear-float: held"));
  const Outcome explained =
      run_shell("cd / && " + std::string("\"$PROGRAM\"") +
                growth["commands"][1].get<std::string>().substr(std::string("rastercheck").size()));
  EXPECT_EQ(explained.code, 0) << explained;
  EXPECT_THAT(explained.out, HasSubstr(growth["after"]["actual"].get<std::string>()));
}

TEST_F(Compare, PrintsJson) {
  const Outcome outcome =
      program({"compare", path("baseline.json"), path("float"), "--as", "mine", "--json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(json::parse(outcome.out)["format"], "rastercheck-comparison");
}

// Kills: answering only "cannot be opened" when the user wanted to compare backends, which `run`
// does.
TEST_F(Compare, SaysHowToCompareBackends) {
  const Outcome both = program({"compare", "gl:llvmpipe", "cpu"});
  EXPECT_EQ(both.code, 2) << both;
  EXPECT_EQ(both.err,
            "rastercheck: gl:llvmpipe: is a backend, and compare takes runs or baselines; to "
            "compare two backends: rastercheck run --backend gl:llvmpipe --backend cpu\n");
  const Outcome one = program({"compare", path("double"), "plugin:./no such.so"});
  EXPECT_EQ(one.code, 2) << one;
  EXPECT_EQ(one.err,
            "rastercheck: plugin:./no such.so: is a backend, and compare takes runs or baselines; "
            "to make a run of it: rastercheck run --backend 'plugin:./no such.so' --keep-cases\n");
  // If a file has the name of a backend, the file is meant.
  folder()->put("cpu", folder()->content("baseline.json"));
  const Outcome file = run_shell("cd " + folder()->path() + "; \"$PROGRAM\" compare cpu cpu");
  EXPECT_EQ(file.code, 0) << file;
  EXPECT_THAT(program({"compare", "nothing", "cpu.json"}).err, Not(HasSubstr("backend")));
}

// Kills: overwriting a baseline with the comparison, or with the run that is compared with it.
TEST_F(Compare, WritesOverNothingItReads) {
  const std::string baseline = copy("own/compare.json");
  const Outcome compared = program({"compare", baseline, path("double"), "--output", path("own")});
  EXPECT_TRUE(is_failure(compared, 2)) << compared;
  EXPECT_THAT(compared.err, HasSubstr("own/compare.json: is the input and would be overwritten"));
  EXPECT_EQ(folder()->content("own/compare.json"), folder()->content("baseline.json"));
  const std::string before = folder()->content("double/run.json");
  const Outcome run = program({"run", "--backend", "method:rational-linear", "--baseline",
                               path("double"), "--output", path("double")});
  EXPECT_TRUE(is_failure(run, 2)) << run;
  EXPECT_THAT(run.err, HasSubstr("double/run.json: is the input and would be overwritten"));
  EXPECT_EQ(folder()->content("double/run.json"), before);
}

TEST_F(Compare, TakesStandardInputForOneSide) {
  EXPECT_EQ(
      program({"compare", "-", path("double"), "--as", "mine"}, folder()->content("baseline.json"))
          .code,
      0);
  EXPECT_TRUE(is_failure(program({"compare", "-", "-"}, "{}"), 2));
}

TEST_F(Compare, RefusesOtherCases) {
  ASSERT_EQ(make_run("method:rational-linear", "other", "2").code, 0);
  const Outcome outcome = program({"compare", path("double"), path("other")});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("the seed is 1 in the baseline and 2 now"));
  EXPECT_TRUE(is_failure(program({"compare", path("double"), path("float")}), 2));
}

TEST_F(Compare, ObeysAPolicyUntilItExpires) {
  const auto with_policy = [](const std::string& until) {
    folder()->put("policy.json", R"({"format": "rastercheck-policy", "version": 1, "allow": [
      {"backend": "mine", "reason": "a faster divide", "until": ")" +
                                     until + "\"}]}");
    return program({"compare", path("baseline.json"), path("float"), "--as", "mine", "--policy",
                    path("policy.json")});
  };
  const Outcome allowed = with_policy("9999-12-31");
  EXPECT_EQ(allowed.code, 0) << allowed;
  EXPECT_THAT(allowed.out, HasSubstr("allowed: a faster divide (until 9999-12-31)"));
  const Outcome expired = with_policy("2001-01-01");
  EXPECT_EQ(expired.code, 3) << expired;
  EXPECT_THAT(expired.out, HasSubstr("\nExpired: "));
}

TEST_F(Compare, TellsGithub) {
  folder()->put("summary", "another step\n");
  const Outcome outcome =
      run_shell("cd " + folder()->path() +
                "; GITHUB_ACTIONS=true GITHUB_STEP_SUMMARY=summary \"$PROGRAM\" "
                "compare baseline.json float --as mine --output gh");
  EXPECT_EQ(outcome.code, 3) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("\n::error file=baseline.json,line=1,title=worse than the "
                                     "baseline of mine on "));
  EXPECT_EQ(folder()->content("summary"), "another step\n" + folder()->content("gh/compare.md"));
}

// --- baseline ------------------------------------------------------------------------------------

TEST_F(Compare, ApprovesWithAReason) {
  const std::string file = copy("approved.json");
  const std::vector<std::string> command{"baseline",    "approve", file,
                                         path("float"), "--as",    "mine"};
  const auto approve = [&command](const std::string& reason) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"--reason", reason});
    return program(words);
  };
  EXPECT_TRUE(is_failure(program(command), 2));
  EXPECT_TRUE(is_failure(approve(" "), 2));
  EXPECT_EQ(folder()->content("approved.json"), folder()->content("baseline.json"));
  const Outcome outcome = approve("half the time");
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr(": smooth: worst 0."));
  EXPECT_EQ(program({"compare", file, path("float"), "--as", "mine"}).code, 0);
  EXPECT_THAT(approve("again").out, HasSubstr("nothing to approve"));
  // Saving again keeps the approvals.
  ASSERT_EQ(program({"baseline", "save", path("double"), "--as", "mine", "--output", file}).code,
            0);
  EXPECT_THAT(folder()->content("approved.json"), HasSubstr("\n{\"reason\":\"half the time\","));
  EXPECT_EQ(program({"compare", file, path("float"), "--as", "mine"}).code, 3);
}

TEST_F(Compare, SavesAsSpecificallyAsAsked) {
  const std::string file = copy("specific.json");
  const Outcome saved = program({"baseline", "save", path("float"), "--as", "mine", "--output",
                                 file, "--instruction-set", "--compiler"});
  EXPECT_EQ(saved.code, 0) << saved;
  // For this machine and compiler the float32 section counts now; the other section is kept.
  EXPECT_EQ(program({"compare", file, path("float"), "--as", "mine"}).code, 0);
  EXPECT_EQ(program({"compare", file, path("double"), "--as", "mine"}).code, 0);
  const json sections = json::parse(folder()->content("specific.json"))["sections"];
  ASSERT_EQ(sections.size(), 2U);
  EXPECT_FALSE(sections[0].contains("compiler"));
  EXPECT_TRUE(sections[1].contains("compiler"));
}

// Kills: overwriting a file that RasterCheck did not write.
TEST_F(Compare, SavesOverNothingButABaseline) {
  folder()->put("notes.json", "{}");
  EXPECT_TRUE(
      is_failure(program({"baseline", "save", path("double"), "--output", path("notes.json")}), 2));
  EXPECT_EQ(folder()->content("notes.json"), "{}");
  ASSERT_EQ(program({"run", "--property", kLaw, "--cases", "1", "--seed", "1", "--corpus",
                     path("corpus"), "--output", path("unkept"), "--quiet"})
                .code,
            0);
  const Outcome outcome =
      program({"baseline", "save", path("unkept"), "--output", path("none.json")});
  EXPECT_TRUE(is_failure(outcome, 2));
  EXPECT_THAT(outcome.err, HasSubstr("--keep-cases"));
}

// Kills: a file whose name is "-"; messages mixed into the baseline.
TEST_F(Compare, PrintsABaselineForADash) {
  const Outcome outcome = run_shell(
      "cd " + folder()->path() +
      " && \"$PROGRAM\" baseline save - --as mine --commit c0ffee --output - <double/run.json");
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.out, folder()->content("baseline.json"));
  EXPECT_FALSE(std::filesystem::exists(path("-")));
}

// --- run --baseline ------------------------------------------------------------------------------

TEST_F(Compare, OfARunTakesItsCasesFromTheBaseline) {
  ASSERT_EQ(program({"baseline", "save", path("double"), "--output", path("own.json")}).code, 0);
  const std::vector<std::string> command{"run",        "--backend",      "method:rational-linear",
                                         "--baseline", path("own.json"), "--output",
                                         path("again")};
  const Outcome outcome = program(command);
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("\nNo regression: "));
  const json run = json::parse(folder()->content("again/run.json"));
  EXPECT_EQ(run["plan"]["seed"], 1);
  EXPECT_EQ(run["plan"]["properties"], json::array({kLaw}));
  EXPECT_FALSE(json::parse(folder()->content("again/compare.json"))["regression"]);
  for (const auto& [option, value] : {std::pair("--seed", "2"), std::pair("--cases", "9"),
                                      std::pair("--property", "*"), std::pair("--contract", "c")}) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {option, value});
    const Outcome refused = program(words);
    EXPECT_TRUE(is_failure(refused, 2)) << refused;
    EXPECT_THAT(refused.err, HasSubstr(std::string(option)));
  }
}

// Kills: another contract under the same name, compared as if it were the same.
TEST_F(Compare, KnowsAContractByWhatItSays) {
  const auto contract = [](const char* name, const char* constant) {
    return folder()->put(name, R"({"format": "rastercheck-contract", "version": 1, "name": ")" +
                                   std::string(name) + R"(", "bounds": {"smooth": {"constant": )" +
                                   constant + "}}}");
  };
  const std::string file = contract("held.json", "3");
  const std::vector<std::string> run{"run", "--backend", "method:rational-linear", "--quiet"};
  const auto with = [&run](std::vector<std::string> more) {
    more.insert(more.begin(), run.begin(), run.end());
    return program(more);
  };
  const auto anew = [&](const std::string& output) {
    return with({"--property", kLaw, "--cases", "2", "--seed", "1", "--corpus", path("corpus"),
                 "--contract", file, "--keep-cases", "--output", path(output)});
  };
  ASSERT_EQ(anew("held").code, 0);
  const std::string baseline = path("held-baseline.json");
  ASSERT_EQ(program({"baseline", "save", path("held"), "--output", baseline}).code, 0);
  const std::vector<std::string> again{"--baseline", baseline, "--output", path("held-again")};
  EXPECT_EQ(with(again).code, 0);
  std::vector<std::string> elsewhere = again;
  elsewhere.insert(elsewhere.end(), {"--contract", contract("moved.json", "3.0")});
  EXPECT_EQ(with(elsewhere).code, 0);

  contract("held.json", "4");
  ASSERT_EQ(anew("held-to-another").code, 0);
  const Outcome compared = program({"compare", baseline, path("held-to-another")});
  EXPECT_TRUE(is_failure(compared, 2)) << compared;
  EXPECT_THAT(compared.err, HasSubstr("the contract is " + file + " in the baseline and " + file +
                                      " now, and its terms differ: "));
  // A run says so before its work begins.
  std::filesystem::remove_all(path("held-again"));
  const Outcome refused = with(again);
  EXPECT_TRUE(is_failure(refused, 2)) << refused;
  EXPECT_THAT(
      refused.err,
      HasSubstr(
          file +
          ": differs from the contract of the baseline's section method:rational-linear on "));
  EXPECT_FALSE(std::filesystem::exists(path("held-again")));
}

// Kills: minutes of work before an unreadable policy is reported; a policy without a baseline,
// accepted and never applied.
TEST_F(Compare, OfARunReadsThePolicyBeforeTheWork) {
  ASSERT_EQ(program({"baseline", "save", path("double"), "--output", path("p.json")}).code, 0);
  const std::string policy = folder()->put("broken-policy.json", "{");
  const std::vector<std::string> run{"run",        "--backend",  "method:rational-linear",
                                     "--policy",   policy,       "--output",
                                     path("none"), "--baseline", path("p.json")};
  const Outcome broken = program(run);
  EXPECT_TRUE(is_failure(broken, 2)) << broken;
  EXPECT_THAT(broken.err, StartsWith("rastercheck: " + policy + ": "));
  EXPECT_FALSE(std::filesystem::exists(path("none")));
  const Outcome alone = program({run.begin(), run.end() - 2});
  EXPECT_TRUE(is_failure(alone, 2)) << alone;
  EXPECT_THAT(alone.err, HasSubstr("--policy requires --baseline"));
  EXPECT_FALSE(std::filesystem::exists(path("none")));
}

TEST_F(Compare, OfAWorseRunObeysAPolicy) {
  const std::string baseline = path("float-policy.json");
  ASSERT_EQ(program({"baseline", "save", path("double"), "--as", "method:rational-linear-float",
                     "--output", baseline})
                .code,
            0);
  const std::string policy = folder()->put("allows.json", R"({"format": "rastercheck-policy",
      "version": 1, "allow": [{"reason": "a faster divide", "until": "9999-12-31"}]})");
  const Outcome outcome = program({"run", "--backend", "method:rational-linear-float", "--baseline",
                                   baseline, "--policy", policy, "--output", path("allowed")});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("allowed: a faster divide (until 9999-12-31)"));
}

TEST_F(Compare, OfAWorseRunEndsWithItsCode) {
  ASSERT_EQ(program({"baseline", "save", path("double"), "--as", "method:rational-linear-float",
                     "--output", path("float.json")})
                .code,
            0);
  const Outcome outcome = program({"run", "--backend", "method:rational-linear-float", "--baseline",
                                   path("float.json"), "--output", path("worse")});
  EXPECT_EQ(outcome.code, 3) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("\nRegression: "));
  EXPECT_THAT(folder()->content("worse/compare.md"), HasSubstr("## Worse"));
}

}  // namespace
}  // namespace rastercheck::cli::compare_test
