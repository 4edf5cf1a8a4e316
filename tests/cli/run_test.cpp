#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "tests/approved_file.h"
#include "tests/cli/program.h"
#include "tests/reports/report_files.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::run_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

/// Runs with a corpus of one case, the square, into the folder "out".
class Run : public testing::Test {
 protected:
  Run() { folder_.put("corpus/square.json", square_case()); }

  std::vector<std::string> with_folders(const std::vector<std::string>& more,
                                        const std::string& output = "out") const {
    // A damaged backend breaks most laws; other tests check how small their counterexamples get.
    std::vector<std::string> arguments{"run",      "--corpus",           folder_.path("corpus"),
                                       "--output", folder_.path(output), "--shrink-tries",
                                       "20"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Outcome run(const std::vector<std::string>& more) const {
    return run_program(with_folders(more));
  }
  Outcome run_damaged(const std::vector<std::string>& more) const {
    return run_damaged_program(with_folders(more));
  }
  json run_json() const { return json::parse(folder_.content("out/run.json")); }

  TemporaryFolder folder_;
};

// --- Outcomes ------------------------------------------------------------------------------------

TEST_F(Run, ThatHoldsSaysSoAndWritesItsFolder) {
  const Outcome outcome = run({"--cases", "6", "--seed", "1"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr(" held"), Not(HasSubstr("violated")),
                                 HasSubstr("0 undecided"), HasSubstr("\nSeed 1, "),
                                 HasSubstr(" Report: " + folder_.path("out") + "/report.html\n")));
  EXPECT_EQ(folder_.files("out"), reports::with_reports({}));
}

TEST_F(Run, ThatIsViolatedKeepsCounterexamples) {
  const Outcome outcome = run_damaged({"--backend", "damaged", "--cases", "3", "--seed", "1"});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("violated"));
  const std::vector<std::string> files = folder_.files("out/counterexamples");
  EXPECT_THAT(files, testing::Contains("coverage-obeys-the-contract-damaged-missing.json"));
  // One counterexample of each cause is shown, and the last lines say how many there are.
  const std::string first = "rastercheck replay " + folder_.path("out/counterexamples/") +
                            "coverage-obeys-the-contract-damaged-missing.json\n";
  EXPECT_THAT(outcome.out, HasSubstr("Again: " + first));
  EXPECT_THAT(outcome.out, HasSubstr("\n     " + first));
  const json causes = run_json().at("causes");
  EXPECT_THAT(outcome.out, HasSubstr("\n" + std::to_string(files.size()) + " counterexamples, "));
  std::size_t named = 0;
  for (const json& cause : causes) named += cause.at("counterexamples").size();
  EXPECT_EQ(named, files.size());
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("on damaged: missing. It is case 0 of the corpus, “square”; "
                              "shrunk in "),
                    HasSubstr("the sample is not drawn and must be (inside)"), HasSubstr("[-]"),
                    HasSubstr("  vertex  x")));
  EXPECT_THAT(run_json().at("counterexamples"), SizeIs(files.size()));
}

TEST_F(Run, ThatCannotDrawIsViolatedNotBroken) {
  const Outcome outcome = run_damaged({"--backend", "damaged:refuses", "--cases", "0"});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("\n  out of memory\n"));
  EXPECT_THAT(folder_.content("out/run.json"), HasSubstr("out of memory"));
}

TEST_F(Run, ThatCheckedNothingIsNotOk) {
  const Outcome outcome = run_program(
      {"run", "--corpus", folder_.path("out"), "--cases", "0", "--output", folder_.path("out")});
  EXPECT_EQ(outcome.code, 2) << outcome;  // no such folder
  folder_.put("empty/note.txt", "");
  const Outcome empty = run_program(
      {"run", "--corpus", folder_.path("empty"), "--cases", "0", "--output", folder_.path("out")});
  EXPECT_EQ(empty.code, 5) << empty;
  EXPECT_THAT(empty.out, HasSubstr("not checked"));
  EXPECT_THAT(folder_.content("out/summary.md"), HasSubstr("Nothing was checked"));
}

// Kills: a law that applies to none of the cases, and passes.
TEST_F(Run, ThatNoLawAppliesToIsNotOk) {
  const std::string camera =
      R"("camera": {"model": ["0x1p+127",0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
                    "view": [4,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}, )";
  folder_.put("corpus/square.json", square_case(camera));  // beyond float32
  const Outcome outcome = run({"--cases", "0", "--json"});
  EXPECT_EQ(outcome.code, 5) << outcome;
  EXPECT_EQ(json::parse(outcome.out).at("properties").at(0).at("not_applicable"), 1);
}

// Kills: exit code 5 because of laws about things that the backend does not promise.
TEST_F(Run, NeedNotCheckWhatIsNotPromised) {
  const Outcome outcome =
      run({"--backend", "method:rational-linear", "--cases", "6", "--seed", "2"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("held"), HasSubstr("not checked")));
  EXPECT_EQ(run({"--backend", "method:rational-linear", "--cases", "3", "--seed", "1", "--property",
                 "strips-and-fans*"})
                .code,
            5);
  EXPECT_EQ(run({"--cases", "0", "--property", "values-at-vertices*"}).code, 5);  // cpu promises it
}

// Kills: a law that checked nothing, hiding a violation of another law.
TEST_F(Run, ThatIsViolatedAndCheckedNothingIsViolated) {
  EXPECT_EQ(run_damaged({"--backend", "damaged", "--cases", "0", "--property", "co*"}).code, 1);
}

// --- The same again ------------------------------------------------------------------------------

// Kills: records that depend on the split over processes, on their order, or on time.
TEST_F(Run, IsTheSameWhateverTheJobs) {
  const auto run_with_jobs = [this](const std::string& jobs) {
    const std::string out = "out" + jobs;
    const Outcome outcome = run_damaged_program(with_folders(
        {"--cases", "21", "--seed", "5", "--backend", "damaged", "--backend", "cpu", "--scene",
         source_file("cases/corpus/nearest.json"), "--keep-cases", "--jobs", jobs},
        out));
    EXPECT_EQ(outcome.code, 1) << outcome;
    EXPECT_THAT(folder_.files(out + "/counterexamples"), Not(IsEmpty()));
    return without_environment(folder_.content(out + "/run.json"));
  };
  const std::string one = run_with_jobs("1");
  EXPECT_THAT(one, HasSubstr("\"specimens\": ["));
  EXPECT_GT(one.size(), 1000U);
  EXPECT_TRUE(one == run_with_jobs("2"));
  EXPECT_TRUE(one == run_with_jobs("3"));
  EXPECT_EQ(folder_.files("out1/counterexamples"), folder_.files("out2/counterexamples"));
}

/// FNV-1a (Fowler, Noll and Vo), 64 bits.
std::uint64_t digest_of(std::string_view text) {
  std::uint64_t digest = 0xcbf29ce484222325U;
  for (const char byte : text)
    digest = (digest ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return digest;
}

/// One line for each law and attribute kind: the sums over its strata, and a digest of all that the
/// run says about them; then a digest of the whole run.json. If a digest changes but the sums do
/// not, run both programs with --keep-cases: `rastercheck compare` then shows the change.
std::string campaign_summary(const std::string& run_json) {
  struct Sums {
    std::uint64_t checked = 0, required = 0, forbidden = 0, permitted = 0, violations = 0;
    std::string text;
  };
  std::map<std::pair<std::string, std::string>, Sums> all;
  const json run = json::parse(run_json);
  for (const json& record : run.at("records")) {
    Sums& sums = all[{record.at("property"), record.at("attribute_kind")}];
    const json& counts = record.at("counts");
    sums.checked += record.at("cases").at("checked").get<std::uint64_t>();
    sums.violations += record.at("cases").at("violations").get<std::uint64_t>();
    sums.required += counts.at("required").get<std::uint64_t>();
    sums.forbidden += counts.at("forbidden").get<std::uint64_t>();
    sums.permitted += counts.at("permitted").get<std::uint64_t>();
    sums.text += record.dump();
  }
  std::string summary = "law: kind  checked  required  forbidden  permitted  violations  digest\n";
  for (const auto& [key, sums] : all) {
    summary += fmt::format("{}: {}  {}  {}  {}  {}  {}  {:016x}\n", key.first, key.second,
                           sums.checked, sums.required, sums.forbidden, sums.permitted,
                           sums.violations, digest_of(sums.text));
  }
  return summary + fmt::format("the whole: {:016x}\n", digest_of(without_environment(run_json)));
}

// A campaign of the project's own corpus and a few random cases. Its records have to match the
// approved ones to the byte. CI runs it in an optimised build of g++ and in a build of clang++ with
// sanitizers, which proves that records depend neither on the compiler nor on its flags. Changes to
// laws, generators, corpus or rasterizer may rightly change the records: look at the difference,
// then approve the new records by running this program with UPDATE_APPROVED=1.
TEST_F(Run, OfASmallCampaignGivesTheApprovedRecords) {
  const Outcome outcome = run_program({"run", "--seed", "1", "--cases", "20", "--format", "json",
                                       "--output", folder_.path("out"), "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome;
  const std::string run_json = folder_.content("out/run.json");
  EXPECT_THAT(run_json, HasSubstr("\"occasion\":\"worst\""));
  EXPECT_TRUE(is_approved(campaign_summary(run_json),
                          source_file("tests/cli/approved/small_campaign.txt")));
}

TEST_F(Run, WithoutASeedNamesTheOneItTook) {
  const Outcome first = run({"--cases", "2"});
  const json seed = run_json().at("plan").at("seed");
  EXPECT_THAT(first.out, HasSubstr("\nSeed " + seed.dump() + ", "));
  const std::string records = without_environment(folder_.content("out/run.json"));
  run({"--cases", "2", "--seed", seed.dump()});
  EXPECT_EQ(without_environment(folder_.content("out/run.json")), records);
}

TEST_F(Run, TakesABackendOnceHoweverOftenItIsNamed) {
  const Outcome outcome = run_damaged({"--backend", "damaged", "--backend", "cpu", "--backend",
                                       "damaged", "--cases", "3", "--property", kCoverage});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_EQ(run_json().at("plan").at("backends"), (json{"damaged", "cpu"}));
  run_damaged(
      {"--backend", "damaged", "--backend", "damaged", "--cases", "0", "--property", kCoverage});
  EXPECT_EQ(run_json().at("plan").at("backends"), json{"damaged"});
  // The case of the corpus is checked once.
  EXPECT_EQ(run_json().at("records").at(0).at("cases").at("checked"), 1);
}

TEST_F(Run, TakesSeveralPropertiesAndRefusesOneThatIsNone) {
  const Outcome outcome = run(
      {"--cases", "3", "--property", kCoverage, "--property", "whole*", "--property", "coverage*"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(run_json().at("plan").at("properties"),
            (json{kCoverage, "whole-pixels-move-the-picture"}));
  const Outcome refused = run({"--property", kCoverage, "--property", "none"});
  EXPECT_TRUE(is_failure(refused, 2)) << refused;
  EXPECT_THAT(refused.err, HasSubstr("--property: none: "));
}

// Kills: a first failure that hides how much was not checked; an early end from which a run cannot
// be resumed.
TEST_F(Run, EndsWithTheFirstViolationIfAsked) {
  const Outcome outcome = run_damaged({"--backend", "damaged", "--cases", "200", "--seed", "1",
                                       "--property", kCoverage, "--fail-fast"});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("The run ended early: 200 of its cases were not checked."),
                    HasSubstr("shrunk in ")));
  EXPECT_EQ(run_json().at("cases_left"), 200);
  const Outcome resumed = run_damaged_program({"run", "--resume", "--output", folder_.path("out")});
  EXPECT_EQ(resumed.code, 1) << resumed;
  EXPECT_FALSE(run_json().contains("cases_left"));
}

// Kills: a run without an end; laws at the end of the list that are never checked.
TEST_F(Run, EndsWhenItsTimeIsUpWithAllLawsCheckedAlike) {
  std::map<std::string, std::uint64_t> checked;
  // A busy machine may need more time to get through the corpus and to reach all three laws.
  for (const char* const seconds : {"1", "8", "64"}) {
    if (checked.size() == 3) break;
    checked.clear();
    const Outcome outcome =
        run({"--cases", "1e9", "--seed", "1", "--max-time", seconds, "--property", kCoverage,
             "--property", "whole*", "--property", "values-stay-w*"});
    EXPECT_EQ(outcome.code, 0) << outcome;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("The run ended early: "), HasSubstr("--resume")));
    const json document = run_json();
    for (const json& record : document.at("records")) {
      if (record.at("stratum") == "corpus" || record.at("attribute_kind") != "coverage") continue;
      const json& cases = record.at("cases");
      checked[record.at("property")] += cases.at("checked").get<std::uint64_t>() +
                                        cases.at("not_applicable").get<std::uint64_t>();
    }
  }
  ASSERT_THAT(checked, SizeIs(3));
  const auto by_cases = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [least, most] = std::minmax_element(checked.begin(), checked.end(), by_cases);
  EXPECT_GT(least->second, 0U);
  EXPECT_LE(most->second - least->second, 10 + most->second / 16);  // a task has 10 cases
  const Outcome at_once = run({"--cases", "3", "--seed", "1", "--max-time", "0.001"});
  EXPECT_EQ(at_once.code, 5) << at_once;  // nothing was checked
}

// Kills: checking a failure again in another way than the one that found it, or not at all.
TEST_F(Run, ChecksWhatFailedOnceMore) {
  const Outcome first =
      run_damaged({"--backend", "damaged", "--backend", "cpu", "--cases", "6", "--seed", "7",
                   "--property", kCoverage, "--property", "whole*", "--keep-cases"});
  EXPECT_EQ(first.code, 1) << first;
  const json before = run_json();
  const Outcome again = run_damaged_program(
      {"run", "--rerun-failed", folder_.path("out"), "--output", folder_.path("again")});
  EXPECT_EQ(again.code, 1) << again;
  const json after = json::parse(folder_.content("again/run.json"));
  EXPECT_EQ(after.at("plan").at("backends"), json{"damaged"});
  EXPECT_EQ(after.at("plan").at("properties"), json{kCoverage});
  EXPECT_EQ(after.at("plan").at("seed"), 7);
  EXPECT_EQ(after.at("plan").at("cases_per_property"), 6);
  // Counterexamples of random cases are shrunk again, from the saved file.
  const auto ways = [](const json& run) {
    std::vector<std::string> all;
    for (const json& one : run.at("counterexamples")) {
      const json& found = one.at("case").at("found");
      all.push_back(found.at("verdict").get<std::string>() + found.at("kind").get<std::string>() +
                    found.at("condition").get<std::string>());
    }
    return all;
  };
  EXPECT_EQ(ways(after), ways(before));
  EXPECT_EQ(run({"--cases", "3", "--seed", "1"}).code, 0);
  const Outcome nothing = run_program({"run", "--rerun-failed", folder_.path("out")});
  EXPECT_TRUE(is_failure(nothing, 2)) << nothing;
  EXPECT_THAT(nothing.err, HasSubstr("has no violated property"));
}

// Kills: a saved counterexample that the next run does not check.
TEST_F(Run, ChecksSavedCounterexamplesAgain) {
  const auto run_cpu = [this] {
    return run({"--cases", "6", "--seed", "1", "--property", kCoverage});
  };
  const std::string name = "counterexamples/coverage-obeys-the-contract-cpu-missing.json";
  folder_.put("out/" + name, square_case(R"("found": {"property": "coverage-obeys-the-contract",
      "backend": "cpu", "verdict": "missing", "seed": 5, "index": 77}, )"));
  const Outcome held = run_cpu();
  EXPECT_EQ(held.code, 0) << held;
  const json records = run_json().at("records");
  EXPECT_TRUE(std::any_of(records.begin(), records.end(), [](const json& record) {
    return record.at("stratum") == "saved" && record.at("cases").at("checked") == 1;
  })) << records;
  // The law holds now, and the file is moved to a folder where it does not count as a failure.
  EXPECT_THAT(folder_.files("out/counterexamples"),
              ElementsAre("earlier/coverage-obeys-the-contract-cpu-missing.json"));

  const auto run_it_damaged = [this](const std::string& seed) {
    return run_damaged_program({"run", "--backend", "damaged", "--cases", "6", "--seed", seed,
                                "--corpus", folder_.path("none"), "--property", kCoverage,
                                "--output", folder_.path("out")});
  };
  folder_.put("none/note.txt", "");
  const Outcome first = run_it_damaged("1");
  EXPECT_EQ(first.code, 1) << first;
  const Outcome second = run_it_damaged("2");
  EXPECT_THAT(second.out, HasSubstr("saved before: case 0 of seed 1"));
}

// Kills: counterexamples of one backend, lost when another is checked, or counted as the other's.
TEST_F(Run, PutsTheCounterexamplesOfOtherBackendsAside) {
  EXPECT_EQ(run_damaged({"--backend", "damaged", "--cases", "3"}).code, 1);
  std::vector<std::string> files = folder_.files("out/counterexamples");
  folder_.put("out/counterexamples/mine.json", square_case());
  EXPECT_EQ(run({"--cases", "6", "--seed", "1"}).code, 0);
  for (std::string& file : files) file = "earlier/" + file;
  files.emplace_back("mine.json");
  EXPECT_EQ(folder_.files("out/counterexamples"), files);
}

// --- What is printed and written -----------------------------------------------------------------

TEST_F(Run, PrintsTheTableAsJson) {
  const Outcome outcome =
      run_damaged({"--backend", "damaged", "--cases", "4", "--seed", "9", "--json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "");
  const json document = json::parse(outcome.out);
  EXPECT_EQ(document.at("seed"), 9);
  EXPECT_EQ(document.at("properties").size(), run_json().at("plan").at("properties").size());
  const auto row =
      std::find_if(document.at("properties").begin(), document.at("properties").end(),
                   [](const json& candidate) { return candidate.at("property") == kCoverage; });
  ASSERT_NE(row, document.at("properties").end());
  EXPECT_EQ(row->at("backend"), "damaged");
  EXPECT_EQ(row->at("checked"), 5);
  EXPECT_GT(row->at("violations"), 0);
  EXPECT_EQ(row->at("undecided"), 0);
  EXPECT_EQ(row->at("verdict"), "violated");
}

// Kills: precision of kinds or of strata that is missing from the JSON.
TEST_F(Run, PrintsPrecisionAndLevelsAsJson) {
  const Outcome outcome =
      run({"--cases", "4", "--seed", "9", "--property", "values-stay-within*", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  const json row = json::parse(outcome.out).at("properties").at(0);
  for (const char* what : {"samples_decided", "values_decided"}) {
    for (const char* level : {"filter", "interval", "exact"}) {
      EXPECT_TRUE(row.at(what).at(level).is_number_unsigned()) << what << level;
    }
  }
  ASSERT_FALSE(row.at("precision").empty());
  const json& all = row.at("precision").at(0);
  EXPECT_EQ(all.at("stratum"), nullptr);
  EXPECT_GT(all.at("values"), 0);
  EXPECT_LE(all.at("min").at(0), 0);
  EXPECT_GE(all.at("max").at(1), 0);
  EXPECT_LE(all.at("mean").at(0), all.at("mean").at(1));
  for (const char* quantile : {"p50", "p99", "p99.9"}) EXPECT_THAT(all.at(quantile), SizeIs(2));
  EXPECT_LE(all.at("misrounded"), all.at("values"));
}

TEST_F(Run, QuietlyPrintsRowsOnly) {
  const Outcome outcome = run_damaged({"--backend", "damaged", "--cases", "1", "--quiet"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'),
            static_cast<std::ptrdiff_t>(run_json().at("plan").at("properties").size()));
  EXPECT_THAT(outcome.out, Not(HasSubstr("Seed")));
}

TEST_F(Run, ChecksThePropertiesThatMatch) {
  const Outcome outcome = run({"--cases", "2", "--property", "*-obeys-the-contract"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(run_json().at("plan").at("properties"), json{kCoverage});
  json expected = json::array();
  const json listed = json::parse(run_program({"list", "properties", "--json"}).out);
  for (const json& row : listed.at("properties")) {
    if (row.at("id").get<std::string>().starts_with("co")) expected.push_back(row.at("id"));
  }
  ASSERT_GT(expected.size(), 1U);
  run({"--cases", "2", "--property", "co*"});
  EXPECT_EQ(run_json().at("plan").at("properties"), expected);
  run({"--cases", "2", "--property", kCoverage});
  EXPECT_EQ(run_json().at("plan").at("properties"), json{kCoverage});
}

TEST_F(Run, WritesTheFormatsAskedFor) {
  const Outcome outcome = run({"--cases", "5", "--seed", "1", "--format", "markdown"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(folder_.files("out"), ElementsAre("summary.md"));
  EXPECT_THAT(outcome.out, HasSubstr(" Report: " + folder_.path("out") + "\n"));
  run({"--cases", "1", "--format", "markdown,json"});
  EXPECT_THAT(folder_.files("out"), ElementsAre("run.json", "summary.md"));
}

TEST_F(Run, JudgesAScene) {
  const std::string mesh = folder_.put("roof.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 1\nf 1 2 3\n");
  const Outcome outcome =
      run({"--cases", "0", "--scene", mesh, "--scene-size", "16", "--property", "cover*"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  const json run = run_json();
  EXPECT_EQ(run.at("plan").at("scene"), mesh);
  EXPECT_EQ(run.at("records").at(0).at("stratum"), "corpus");
  EXPECT_EQ(run.at("records").at(1).at("stratum"), "scene roof.obj");
  ASSERT_THAT(run.at("pictures"), SizeIs(2));
  EXPECT_EQ(run.at("pictures").at(0).at("name"), "roof-cpu");
  EXPECT_EQ(run.at("pictures").at(0).at("width"), 16);
  EXPECT_EQ(run.at("pictures").at(1).at("name"), "roof-cpu-errors");
  const json& scene = run.at("scenes").at(0);
  EXPECT_EQ(scene.at("triangles"), 1);
  EXPECT_GT(scene.at("judged"), 0);
  EXPECT_EQ(scene.at("wrong"), 0);
  EXPECT_THAT(outcome.out, HasSubstr("\nScene roof.obj on cpu: 1 triangle, "));
}

// Kills: a requested scene that is dropped without a message and with an empty picture.
TEST_F(Run, SaysThatNothingWasJudgedOfAScene) {
  const std::string mesh = folder_.put("far.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 1\nf 1 2 3\n");
  const std::string contract = folder_.put(
      "near.json", R"({"format": "rastercheck-contract", "version": 1, "numbers": {"least": 8}})");
  const std::vector<std::string> asked{"--cases",    "0",      "--scene",    mesh,
                                       "--contract", contract, "--property", "cover*"};
  folder_.put("corpus/far.json", square_case(R"("coverage": "exact", )"));
  const Outcome outcome = run(asked);
  EXPECT_EQ(outcome.code, 5) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("Scene far.obj on cpu: its 1 triangle could not be "
                                     "judged: depth range outside the range the backend promises"));
  EXPECT_THAT(run_json().at("pictures"), IsEmpty());
  EXPECT_EQ(run_json().at("scenes").at(0).at("judged"), 0);
  EXPECT_THAT(folder_.content("out/summary.md"), HasSubstr("Scene far.obj on cpu"));
  EXPECT_THAT(folder_.content("out/report.html"), HasSubstr("Scene far.obj on cpu"));
  EXPECT_THAT(folder_.content("out/junit.xml"), HasSubstr("name=\"scene far.obj\""));
}

// Kills: two counterexamples with the same name, which make a run of minutes end without a report.
TEST_F(Run, JudgesACaseOfTheCorpusAsAScene) {
  folder_.put("corpus/square.json", square_case());
  const Outcome outcome = run_damaged({"--backend", "damaged", "--cases", "0", "--scene",
                                       folder_.path("corpus/square.json"), "--property", "cov*"});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(folder_.files("out/counterexamples"),
              ElementsAre("coverage-obeys-the-contract-damaged-missing.json"));
}

TEST_F(Run, ReadsASceneFromStandardInput) {
  std::string nameless = square_case();
  nameless.replace(nameless.find("\"square\""), 8, "\"\"");
  const Outcome outcome =
      run_program(with_folders({"--cases", "0", "--scene", "-", "--property", "cov*"}), nameless);
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(run_json().at("records").at(1).at("stratum"), "scene standard input");
}

// --- What cannot be run --------------------------------------------------------------------------

TEST_F(Run, RefusesWrongUsageInOneLine) {
  const std::string broken = folder_.put("broken/x.json", "{");
  const std::string file = folder_.put("file", "");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--backend", "gpu"},
                                                    {"--backend", "method:none"},
                                                    {"--backend", "cpu", "--backend", "gpu"},
                                                    {"--property", "no-such*"},
                                                    {"--format", "jsn"},
                                                    {"--format", "json,htlm"},
                                                    {"--corpus", folder_.path("none")},
                                                    {"--corpus", folder_.path("broken")},
                                                    {"--corpus", file},
                                                    {"--scene", folder_.path("none.json")},
                                                    {"--scene", folder_.path("none.obj")},
                                                    {"--scene", broken},
                                                    {"--output", file},
                                                    {"--cases", "-1"},
                                                    {"--cases", "many"},
                                                    {"--cases", "1.5"},
                                                    {"--cases", "18446744073709551616"},
                                                    {"--seed", "-1"},
                                                    {"--seed", "18446744073709551616"},
                                                    {"--seed", ""},
                                                    {"--jobs", "0"},
                                                    {"--scene-size", "0"},
                                                    {"--scene-size", "16385"}}) {
    std::vector<std::string> all{"run"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto give = [&](const std::string& option, const std::string& value) {
      if (arguments[0] != option) all.insert(all.end(), {option, value});
    };
    give("--corpus", folder_.path("corpus"));
    give("--output", folder_.path("out"));
    give("--cases", "1");
    const Outcome outcome = run_program(all);
    EXPECT_TRUE(is_failure(outcome, 2)) << arguments[0] << " " << arguments[1] << "\n" << outcome;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out/run.json")));
  }
}

TEST_F(Run, NamesWhatItCannotRead) {
  const std::string broken = folder_.put("broken/x.json", "{");
  EXPECT_THAT(run({"--scene", broken}).err, StartsWith("rastercheck: " + broken + ": 1:"));
  EXPECT_EQ(
      run({"--scene", folder_.path("no.obj")}).err,
      "rastercheck: " + folder_.path("no.obj") + ": cannot be read: No such file or directory\n");
  EXPECT_THAT(run({"--format", "jsn"}).err, HasSubstr("--format: jsn not in {bencher,"));
}

TEST_F(Run, TellsABackendThatCannotRunHereFromNone) {
  const Outcome absent = run_damaged({"--backend", "damaged:absent", "--cases", "1"});
  EXPECT_TRUE(is_failure(absent, 4)) << absent;
  EXPECT_EQ(absent.err, "rastercheck: damaged:absent: needs what no machine has\n");
  EXPECT_EQ(run_damaged({"--backend", "cpu", "--backend", "damaged:absent"}).code, 4);
}

TEST_F(Run, HasNoVectorsThatNobodyCompiledFor) {
  const json listed = json::parse(run_program({"list", "backends", "--json"}).out);
  for (const json& row : listed.at("backends")) {
    const std::string name = row.at("name");
    if (!name.starts_with("cpu:simd=") || row.at("available").get<bool>()) continue;
    const Outcome outcome = run({"--backend", name + ",precision=float32", "--cases", "1"});
    EXPECT_TRUE(is_failure(outcome, 4)) << outcome;
    EXPECT_THAT(outcome.err, HasSubstr("rastercheck: " + name + ": "));
    EXPECT_THAT(outcome.err, HasSubstr("; available: "));
  }
  EXPECT_TRUE(is_failure(run({"--backend", "cpu:simd=mmx"}), 2));
}

// Kills: exit code 4 where 2 applies as well.
TEST_F(Run, PutsWrongUsageBeforeWhatCannotRun) {
  EXPECT_TRUE(is_failure(run_damaged({"--backend", "damaged:absent", "--backend", "gpu"}), 2));
  EXPECT_TRUE(is_failure(
      run_damaged({"--backend", "damaged:absent", "--scene", folder_.path("none.json")}), 2));
}

TEST_F(Run, RefusesASceneBeyondFloat32) {
  const std::string camera =
      R"("camera": {"model": ["0x1p+127",0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
                    "view": [4,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}, )";
  const std::string scene = folder_.put("far.json", square_case(camera));
  const Outcome outcome = run({"--cases", "0", "--scene", scene});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_EQ(outcome.err,
            "rastercheck: " + scene + ": /vertices/0/position: its clip x overflows float32\n");
}

TEST(WorkerCommand, RefusesWhatIsNoTask) {
  const std::string plan = R"({"seed": 1, "cases_per_property": 1})";
  const Outcome outcome = run_program({"task-worker", "--plan", plan}, "rubbish\n");
  EXPECT_TRUE(is_failure(outcome, 70)) << outcome;
  EXPECT_EQ(run_program({"task-worker", "--plan", plan}).code, 0);
  EXPECT_TRUE(is_failure(run_program({"task-worker", "--plan", plan, "--corpus", "no/such"}), 2));
  EXPECT_TRUE(is_failure(run_program({"task-worker", "--plan", "{}"}), 2));
}

}  // namespace
}  // namespace rastercheck::cli::run_test
