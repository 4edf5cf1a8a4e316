#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::replay_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

/// The key `found` of a saved counterexample.
std::string found_key(const std::string& law, const std::string& backend,
                      const std::string& verdict) {
  return R"("found": {"property": ")" + law + R"(", "backend": ")" + backend +
         R"(", "verdict": ")" + verdict + R"(", "seed": 1, "index": 3}, )";
}

std::ptrdiff_t line_count(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(Replay, OfTheCorpusHolds) {
  std::vector<std::string> arguments{"replay"};
  for (const auto& entry : std::filesystem::directory_iterator(source_file("cases/corpus"))) {
    arguments.push_back(entry.path().string());
  }
  ASSERT_GT(arguments.size(), 20U);
  const Outcome outcome = run_program(arguments);
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(outcome.err, "");
  const auto laws = json::parse(run_program({"list", "properties", "--json"}).out);
  const std::size_t law_count = laws.at("properties").size();
  EXPECT_EQ(line_count(outcome.out),
            static_cast<std::ptrdiff_t>((arguments.size() - 1) * law_count));
  EXPECT_THAT(outcome.out,
              HasSubstr("first-triangle.json: coverage-obeys-the-contract, cpu: held\n"));
}

TEST(Replay, ReadsStandardInput) {
  const Outcome outcome = run_program({"replay", "-"}, square_case());
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("-: coverage-obeys-the-contract, cpu: held\n"));
}

// From the run to the verdict on another machine: the file alone tells how the counterexample was
// found.
TEST(Replay, OfACounterexampleFindsItAgain) {
  const TemporaryFolder folder;
  folder.put("corpus/square.json", square_case());
  const Outcome run = run_damaged_program({"run", "--corpus", folder.path("corpus"), "--cases",
                                           "10", "--backend", "damaged", "--shrink-tries", "20",
                                           "--output", folder.path("out"), "--seed", "1"});
  ASSERT_EQ(run.code, 1) << run;
  const std::vector<std::string> files = folder.files("out/counterexamples");
  ASSERT_FALSE(files.empty());
  for (const std::string& name : files) {
    const std::string file = folder.path("out/counterexamples/" + name);
    const Outcome again = run_damaged_program({"replay", file});
    EXPECT_EQ(again.code, 1) << again;
    EXPECT_THAT(again.out, HasSubstr(", damaged: "));
    EXPECT_THAT(again.out, HasSubstr(" (as found)\n"));
    // With a correct rasterizer the law holds, and replay says why the case was kept.
    const Outcome mended = run_program({"replay", "--backend", "cpu", file});
    EXPECT_EQ(mended.code, 0) << mended;
    EXPECT_THAT(mended.out,
                AllOf(HasSubstr(", cpu: held (found as: "), Not(HasSubstr("as it was"))));
    EXPECT_EQ(line_count(mended.out), 1);
  }
}

TEST(Replay, PrintsExactAndActualValue) {
  const std::string text = square_case(found_key(kCoverage, "damaged", "missing"));
  const Outcome outcome = run_damaged_program({"replay", "-"}, text);
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(outcome.out,
              HasSubstr("-: coverage-obeys-the-contract, damaged: missing (as found)\n"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("required: inside"), HasSubstr("not drawn")));
  // The lost corner, the pixels around it, and the case.
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("#  [-]\n"), HasSubstr("- missing\n"),
                    HasSubstr("  8 × 8 pixels, viewport 0 0 8 8, rules vulkan\n"),
                    HasSubstr("  3       1   1"), HasSubstr("  triangles 0 1 2, 2 1 3\n")));
  const Outcome quiet = run_damaged_program({"replay", "-", "--quiet"}, text);
  EXPECT_EQ(quiet.code, 1);
  EXPECT_EQ(line_count(quiet.out), 1);
}

TEST(Replay, PrintsJson) {
  const std::string text = square_case(found_key(kCoverage, "damaged", "missing"));
  const Outcome outcome = run_damaged_program({"replay", "--json", "-"}, text);
  EXPECT_EQ(outcome.code, 1) << outcome;
  const json document = json::parse(outcome.out);
  ASSERT_THAT(document, SizeIs(1));
  const json& row = document.at(0);
  EXPECT_EQ(row.at("file"), "-");
  EXPECT_EQ(row.at("property"), kCoverage);
  EXPECT_EQ(row.at("backend"), "damaged");
  EXPECT_EQ(row.at("verdict"), "missing");
  EXPECT_EQ(row.at("found"), "missing");
  EXPECT_EQ(row.at("violation_count"), 1);
  EXPECT_EQ(row.at("violations").at(0).at("class"), "missing");
  EXPECT_EQ(row.at("violations").at(0).at("x"), 7);
  EXPECT_EQ(row.at("violations").at(0).at("exact"), "required: inside");
}

TEST(Replay, OfADrawingThatFailsSaysWhy) {
  const Outcome outcome = run_damaged_program({"replay", "--backend", "damaged:refuses", "-"},
                                              square_case(found_key(kCoverage, "cpu", "missing")));
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("out of memory"));
}

TEST(Replay, ThatNoLawAppliesToIsNotOk) {
  std::string text = square_case(found_key("constants-stay-constant", "cpu", "beyond bound"));
  // Makes a case with neither a constant attribute nor a constant depth.
  const auto replace = [&text](const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + 1)) {
      text.replace(at, from.size(), to);
    }
  };
  replace("[0, 1]}", "[0, 2]}");
  replace("[-1, -1, 0.25, 1]", "[-1, -1, 0.5, 1]");
  replace("[1, 1, 0.25, 1]", "[1, 1, 0.5, 1]");
  const Outcome outcome = run_program({"replay", "-"}, text);
  EXPECT_EQ(outcome.code, 5) << outcome;
  EXPECT_EQ(outcome.out,
            "-: constants-stay-constant, cpu: not applicable (found as: beyond bound): no triangle "
            "has a constant attribute that is promised to stay constant\n");
}

TEST(Replay, RefusesWhatItCannotReplay) {
  const Outcome law = run_program({"replay", "-"}, square_case(found_key("no law", "cpu", "")));
  EXPECT_TRUE(is_failure(law, 2)) << law;
  EXPECT_EQ(law.err,
            "rastercheck: -: /found/property: no property is called 'no law' (see rastercheck list "
            "properties)\n");
  const Outcome backend =
      run_program({"replay", "-"}, square_case(found_key(kCoverage, "damaged", "")));
  EXPECT_TRUE(is_failure(backend, 2)) << backend;
  EXPECT_THAT(backend.err, HasSubstr("damaged: unknown backend"));
  const std::string camera =
      R"("camera": {"model": ["0x1p+127",0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
                    "view": [4,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}, )";
  const Outcome far = run_program({"replay", "-"}, square_case(camera));
  EXPECT_TRUE(is_failure(far, 2)) << far;
  EXPECT_TRUE(is_failure(run_program({"replay", "-"}, "{"), 2));
  EXPECT_TRUE(is_failure(run_program({"replay", "no/such.json"}), 2));
}

// Kills: an exit code that depends on the order of the files.
TEST(Replay, PutsUnreadableInputFirst) {
  const TemporaryFolder folder;
  const std::string absent =
      folder.put("absent.json", square_case(found_key(kCoverage, "damaged:absent", "")));
  EXPECT_TRUE(is_failure(run_damaged_program({"replay", absent}), 4));
  EXPECT_TRUE(is_failure(run_damaged_program({"replay", absent, "no/such.json"}), 2));
}

}  // namespace
}  // namespace rastercheck::cli::replay_test
