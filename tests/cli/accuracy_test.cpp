// `rastercheck accuracy`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::accuracy_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<std::string> command(const TemporaryFolder& folder,
                                 const std::vector<std::string>& more) {
  std::vector<std::string> all{"accuracy", "--cases", "12", "--output", folder.path("out")};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(Accuracy, IsOfTheSameCasesForAll) {
  const TemporaryFolder folder;
  const Outcome measured = run_program(command(
      folder, {"--backend", "cpu", "--backend", "cpu:precision=float32", "--alone", "--json"}));
  EXPECT_EQ(measured.code, 0) << measured;
  const json table = json::parse(measured.out);
  EXPECT_EQ(table.at("format"), "rastercheck-accuracy");
  ASSERT_EQ(table.at("rows").size(), 2U);
  const json& cpu = table.at("rows")[0];
  EXPECT_EQ(cpu.at("asked"), 12);
  EXPECT_EQ(cpu.at("drawn"), 12);
  EXPECT_EQ(cpu.at("wrong_samples"), 0);
  EXPECT_GT(cpu.at("samples"), 1000);
  // It covers the same samples.
  for (const char* key : {"asked", "samples"}) EXPECT_EQ(table.at("rows")[1].at(key), cpu.at(key));
  // Its bound, of 0.51, counts from what the contract leaves open: here nothing.
  for (const json& figure : cpu.at("figures")) EXPECT_LE(figure.at("worst"), 0.51);
  const std::string worst = cpu.at("worst_case");
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/cases/" + worst + ".json")));
}

// Kills: a promise that counts as kept because known defects are left out, and exit code 0 for one
// that is broken.
TEST(Accuracy, SaysWhetherPromisesAreKept) {
  const TemporaryFolder folder;
  const Outcome measured =
      run_damaged_program(command(folder, {"--backend", "damaged", "--alone"}));
  EXPECT_EQ(measured.code, 1) << measured;
  EXPECT_THAT(measured.out, AllOf(HasSubstr("broken"), HasSubstr("is farthest off in")));
}

TEST(Accuracy, HasTheRowsOfAnotherTable) {
  const TemporaryFolder folder;
  const std::string table = folder.path("table.json");
  std::ofstream(table) << R"({"format": "rastercheck-accuracy", "version": 1, "program": "0",
    "seed": 1, "rows": [{"backend": "theirs", "drawn_by": "it 2", "date": "d", "asked": 1,
    "drawn": 1, "violated": 0, "samples": 1, "wrong_samples": 0, "values": 1, "not_judged": 0,
    "wrong_values": 0, "not_numbers": 0, "figures": []}]})";
  const Outcome measured = run_program(command(folder, {"--against", table}));
  EXPECT_EQ(measured.code, 0) << measured;
  EXPECT_THAT(measured.out, AllOf(HasSubstr("theirs"), HasSubstr("cpu")));
  EXPECT_TRUE(is_failure(run_program(command(folder, {"--against", folder.path("none")})), 2));
}

TEST(Accuracy, LeavesOtherFilesAlone) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("out/cases"));
  std::ofstream(folder.path("out/cases/mine.json")) << "{}";
  const Outcome measured = run_program(command(folder, {"--alone"}));
  EXPECT_TRUE(is_failure(measured, 2)) << measured;
  EXPECT_THAT(measured.err, HasSubstr("was not written by `rastercheck accuracy`"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/cases/mine.json")));
}

}  // namespace
}  // namespace rastercheck::cli::accuracy_test
