#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::list_test {
namespace {

using testing::HasSubstr;

// Kills: rows that the terminal has to wrap.
TEST(List, FitsTheTerminal) {
  const Outcome outcome = run_shell(
      R"(script -qec "stty cols 60; '$PROGRAM' list generators" /dev/null </dev/null | tr -d '\r')");
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("\n  summary: "));
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 60U) << line;
}

TEST(List, ShowsEveryKind) {
  const Outcome outcome = run_program({"list"});
  EXPECT_EQ(outcome.code, 0);
  for (const std::string kind : {"backends:", "properties:", "methods:", "rules:", "patterns:"}) {
    EXPECT_THAT(outcome.out, HasSubstr(kind));
  }
}

TEST(List, OfOneKindShowsNoOther) {
  const Outcome outcome = run_program({"list", "rules", "--quiet"});
  EXPECT_EQ(
      outcome.out,
      "opengl  bottom_left  ideal\nvulkan  top_left     ideal\nd3d     top_left     snapped\n");
}

TEST(List, AsJsonIsJson) {
  const auto document = nlohmann::json::parse(run_program({"list", "--json"}).out);
  EXPECT_EQ(document.at("rules").size(), 3U);
  EXPECT_EQ(document.at("patterns").at(1),
            nlohmann::json::parse(R"({"samples": 2, "positions": [[12, 12], [4, 4]]})"));
  EXPECT_TRUE(document.at("backends").is_array());
}

TEST(List, SaysWhichBackendsCanRunHereAndWhyNot) {
  const auto document =
      nlohmann::json::parse(run_damaged_program({"list", "backends", "--json"}).out);
  std::map<std::string, nlohmann::json> rows;
  for (const auto& row : document.at("backends")) rows[row.at("name")] = row;
  EXPECT_EQ(rows.at("cpu").at("available"), true);
  EXPECT_EQ(rows.at("cpu").at("why not"), "");
  EXPECT_EQ(rows.at("damaged:absent").at("available"), false);
  EXPECT_EQ(rows.at("damaged:absent").at("why not"), "needs what no machine has");
  const Outcome table = run_damaged_program({"list", "backends"});
  EXPECT_THAT(table.out, HasSubstr("needs what no machine has"));
}

// Kills: an option that is ignored.
TEST(List, RefusesABackendWithOtherKinds) {
  const Outcome refused = run_program({"list", "rules", "--backend", "cpu"});
  EXPECT_TRUE(is_failure(refused, 2)) << refused;
  EXPECT_THAT(refused.err, HasSubstr("`list backends` only, not with `list rules`"));
  EXPECT_EQ(run_program({"list", "--backend", "cpu", "--quiet"}).code, 0);
}

// Kills: a foreign backend's description that acts as commands to the terminal.
TEST(List, EscapesWhatABackendSaysOfItself) {
  const Outcome table = run_damaged_program({"list", "backends", "--backend", "damaged:speaks"});
  EXPECT_EQ(table.code, 0);
  EXPECT_THAT(table.out, HasSubstr("red \\u001b[31m and \\n two lines"));
}

TEST(List, NamesTheMethodsByTheirSources) {
  const auto document = nlohmann::json::parse(run_program({"list", "methods", "--json"}).out);
  EXPECT_THAT(document.at("methods"), testing::Not(testing::IsEmpty()));
  for (const auto& row : document.at("methods")) EXPECT_NE(row.at("source"), "") << row;
}

// Everything listed as able to run can be asked for by its listed name.
TEST(List, NamesWhatOtherCommandsTake) {
  const auto document = nlohmann::json::parse(run_program({"list", "--json"}).out);
  for (const auto& row : document.at("backends")) {
    if (!row.at("available")) continue;
    const Outcome outcome =
        run_program({"render", "--backend", row.at("name"), "-"}, square_case());
    EXPECT_EQ(outcome.code, 0) << outcome;
  }
  const TemporaryFolder folder;
  folder.put("corpus/square.json", square_case());
  // The square alone does not test every property, so random cases are added. Not every property
  // applies to cpu, so a method and conservative coverage are checked, too; one property is about
  // drivers only.
  for (const auto& row : document.at("properties")) {
    const Outcome outcome =
        run_program({"run", "--backend", "cpu", "--backend", "method:screen-linear", "--backend",
                     "cpu:conservative=outer", "--corpus", folder.path("corpus"), "--cases", "6",
                     "--seed", "1", "--output", folder.path("out"), "--property", row.at("id")});
    const bool is_of_drivers = row.at("id") == "every-way-of-drawing-draws-the-same-bits";
    EXPECT_EQ(outcome.code, is_of_drivers ? 5 : 0) << outcome;
  }
}

}  // namespace
}  // namespace rastercheck::cli::list_test
