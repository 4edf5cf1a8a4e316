#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::probe_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A time limit that no machine reaches.
constexpr const char* kLong = "86400";

/// Arguments of a quick probe: one case of each generator, and few requests to try.
std::vector<std::string> quick(std::vector<std::string> more) {
  std::vector<std::string> arguments{"probe", "--cases",         "1",
                                     "--ask", "snapped:8",       "--ask-basis",
                                     "ideal", "--ask-fill-rule", "top_left"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// From the probe to a campaign that is judged by the contract that the probe found.
TEST(Probe, WritesAContractThatHolds) {
  const TemporaryFolder folder;
  const std::string contract = folder.path("contract.json");
  const Outcome probe =
      run_program({"probe", "cpu", "--cases", "4", "--contract-out", contract, "--seconds", kLong});
  ASSERT_EQ(probe.code, 0) << probe;
  EXPECT_THAT(probe.out, AllOf(HasSubstr("declared"), HasSubstr("8 bits, nearest_even"),
                               HasSubstr("Contract: " + contract)));
  const Outcome run =
      run_program({"run", "--contract", contract, "--cases", "10", "--seed", "1", "--output",
                   folder.path("out"), "--property", "*bound*", "--jobs", "2"});
  EXPECT_THAT(run.out, HasSubstr("Judged by the contract in " + contract));
  EXPECT_NE(run.code, 1) << run;
}

TEST(Probe, PrintsJson) {
  const Outcome probe = run_program(quick({"cpu", "--json", "--seconds", kLong}));
  ASSERT_EQ(probe.code, 0) << probe;
  const json document = json::parse(probe.out);
  EXPECT_EQ(document.at("format"), "rastercheck-probe");
  EXPECT_EQ(document.at("backend"), "cpu");
  EXPECT_EQ(document.at("failed"), 0);
  EXPECT_EQ(document.at("measured").at(0).at("what"), "subpixel grid");
  EXPECT_EQ(document.at("measured").at(0).at("measured"), "8 bits, nearest_even");
  EXPECT_EQ(document.at("measured").at(0).at("contradicts"), false);
  const json& sureness = document.at("measured").at(0).at("sureness");
  EXPECT_EQ(sureness.at("of"), "samples");
  EXPECT_GT(sureness.at("for"), 10000);
  EXPECT_EQ(sureness.at("against"), 0);
  EXPECT_GT(sureness.at("undecided"), 0);
  EXPECT_TRUE(document.at("faults").empty());
  EXPECT_TRUE(document.at("not_measured").empty());
  EXPECT_EQ(document.at("contract").at("format"), "rastercheck-contract");
  EXPECT_EQ(document.at("contract").at("coverage").at("subpixel_bits"), 8);
}

// Kills: a contract for a backend that draws upside down, and a probe that does not end.
TEST(Probe, EndsWithOneSentenceForAFault) {
  const TemporaryFolder folder;
  const std::string contract = folder.path("contract.json");
  constexpr const char* kSentence = "The picture is upside down: NDC y = -1 belongs to row 0.";
  const Outcome probe = run_damaged_program(
      {"probe", "damaged:flipped", "--seconds", kLong, "--contract-out", contract});
  EXPECT_EQ(probe.code, 1) << probe;
  EXPECT_THAT(probe.out, AllOf(HasSubstr(kSentence), HasSubstr("no contract is written")));
  EXPECT_FALSE(std::filesystem::exists(contract));
  const Outcome quiet = run_damaged_program({"probe", "damaged:flipped", "--seconds", kLong, "-q"});
  EXPECT_EQ(quiet.code, 1) << quiet;
  EXPECT_EQ(quiet.out, std::string(kSentence) + "\n");
  const Outcome as_json =
      run_damaged_program({"probe", "damaged:flipped", "--seconds", kLong, "--json"});
  EXPECT_EQ(as_json.code, 1) << as_json;
  const json document = json::parse(as_json.out);
  ASSERT_EQ(document.at("faults").size(), 1U);
  EXPECT_EQ(document.at("faults")[0].at("id"), "upside-down");
  EXPECT_EQ(document.at("faults")[0].at("sentence"), kSentence);
  EXPECT_EQ(document.at("faults")[0].at("sureness").at("against"), 0);
  EXPECT_TRUE(document.at("measured").empty());
  EXPECT_TRUE(document.at("contract").is_null());
}

TEST(Probe, SaysWhatItHadNoTimeFor) {
  const TemporaryFolder folder;
  const std::string contract = folder.path("contract.json");
  const Outcome probe =
      run_program(quick({"cpu", "--seconds", "0.001", "--contract-out", contract}));
  EXPECT_EQ(probe.code, 5) << probe;
  EXPECT_THAT(probe.out, AllOf(HasSubstr("Not measured within 0.001 s (--seconds): subpixel grid "
                                         "and position error, tie rule, basis"),
                               HasSubstr("errors of values")));
  EXPECT_FALSE(std::filesystem::exists(contract));
  const json document =
      json::parse(run_program(quick({"cpu", "--seconds", "0.001", "--json"})).out);
  ASSERT_GT(document.at("not_measured").size(), 1U);
  for (const json& one : document.at("not_measured")) {
    EXPECT_THAT(probe.out, HasSubstr(one.at("what").get<std::string>()));
  }
  EXPECT_EQ(document.at("not_measured").back().at("what"), "errors of values");
  EXPECT_EQ(document.at("not_measured")[1].at("what"), "tie rule");
  EXPECT_EQ(document.at("not_measured")[1].at("keys"), json::array({"tie_rule"}));
  EXPECT_TRUE(document.at("contract").is_null());
}

TEST(Probe, RefusesATimeThatIsNone) {
  for (const char* seconds : {"0", "-1", "1e9", "long"}) {
    EXPECT_TRUE(is_failure(run_program({"probe", "cpu", "--seconds", seconds}), 2)) << seconds;
  }
}

TEST(Probe, IsTheSameForTheSameSeed) {
  const Outcome first = run_program(quick({"cpu", "-q", "--seconds", kLong}));
  EXPECT_EQ(first.code, 0) << first;
  EXPECT_THAT(first.out,
              testing::ContainsRegex("subpixel grid .*all [0-9]+ samples, [0-9]+ undecided"));
  EXPECT_EQ(first.out, run_program(quick({"cpu", "-q", "--seconds", kLong})).out);
}

TEST(Probe, RefusesWhatItCannotAskFor) {
  for (const char* ask : {"snapped", "snapped:17", "snapped:8:up", "snapped:-1", "rounded"}) {
    EXPECT_TRUE(is_failure(run_program({"probe", "cpu", "--ask", ask}), 2)) << ask;
  }
  EXPECT_TRUE(is_failure(run_program({"probe", "nothing"}), 2));
}

// Kills: overwriting a plugin with the contract that was measured on it.
TEST(Probe, WritesNoContractOverItsPlugin) {
  const TemporaryFolder folder;
  const std::string plugin = folder.put("mine.so", "the plugin");
  const Outcome over = run_program({"probe", "plugin:" + plugin, "--contract-out", plugin});
  EXPECT_TRUE(is_failure(over, 2)) << over;
  EXPECT_THAT(over.err, HasSubstr("mine.so: is the input and would be overwritten"));
  EXPECT_EQ(folder.content("mine.so"), "the plugin");
}

TEST(Probe, SaysThatABackendIsNotThere) {
  const Outcome probe = run_program({"probe", "plugin:/nowhere/at/all.so"});
  EXPECT_NE(probe.code, 0) << probe;
  EXPECT_EQ(probe.out, "");
}

// ---- run --contract

constexpr const char* kTooStrict = R"({"format": "rastercheck-contract", "version": 1,
  "bounds": {"smooth": {"constant": 0.25}}})";

std::vector<std::string> held_run(const TemporaryFolder& folder, const std::string& output,
                                  std::vector<std::string> more) {
  std::vector<std::string> arguments{"run",
                                     "--contract",
                                     folder.path("strict.json"),
                                     "--property",
                                     "values-stay-within*",
                                     "--cases",
                                     "10",
                                     "--seed",
                                     "1",
                                     "--corpus",
                                     folder.path("corpus"),
                                     "--shrink-tries",
                                     "5",
                                     "--output",
                                     folder.path(output)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// Kills: a contract that the worker processes are not told about.
TEST(RunWithContract, HoldsBackendsToIt) {
  const TemporaryFolder folder;
  folder.put("strict.json", kTooStrict);
  folder.put("corpus/square.json", square_case());
  const Outcome alone = run_program(held_run(folder, "alone", {}));
  EXPECT_EQ(alone.code, 1) << alone;
  const Outcome together = run_program(held_run(folder, "together", {"--jobs", "2"}));
  EXPECT_EQ(together.code, 1) << together;
  const std::string found = folder.content("alone/run.json");
  EXPECT_EQ(without_environment(found), without_environment(folder.content("together/run.json")));
  EXPECT_EQ(json::parse(found).at("plan").at("contract").at("file"), folder.path("strict.json"));
  EXPECT_THAT(folder.content("alone/summary.md"), HasSubstr("strict.json"));

  const std::vector<std::string> files = folder.files("alone/counterexamples");
  ASSERT_FALSE(files.empty());
  const std::string file = folder.path("alone/counterexamples/" + files.front());
  EXPECT_EQ(run_program({"replay", file}).code, 0);
  EXPECT_EQ(run_program({"replay", "--contract", folder.path("strict.json"), file}).code, 1);
}

TEST(RunWithContract, RefusesWhatIsNone) {
  const TemporaryFolder folder;
  folder.put("strict.json", R"({"format": "rastercheck-contract", "version": 1, "bound": 1})");
  const Outcome run = run_program(held_run(folder, "out", {}));
  EXPECT_TRUE(is_failure(run, 2)) << run;
  EXPECT_THAT(run.err, HasSubstr("strict.json: /bound: unknown key 'bound'"));
  EXPECT_TRUE(is_failure(run_program({"run", "--contract", folder.path("none.json")}), 2));
}

}  // namespace
}  // namespace rastercheck::cli::probe_test
