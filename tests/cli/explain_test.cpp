#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/approved_file.h"
#include "tests/cli/program.h"

namespace rastercheck::cli::explain_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Outcome explain(const std::vector<std::string>& more, const std::string& input = "") {
  std::vector<std::string> arguments{"explain"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments, input);
}

std::string corpus_case(const std::string& name) { return source_file("cases/corpus/" + name); }

/// The approved explanation of a case of the corpus.
std::string approved_file(const std::string& name) {
  return source_file("tests/cli/approved/explain-" + name + ".txt");
}

/// The output without the commands to try next, which name the file by its path here.
std::string explanation(const Outcome& outcome) {
  return outcome.out.substr(0, outcome.out.find("\nTo try next:"));
}

// The approved files can be checked by hand: the names of the cases say what is drawn.
TEST(Explain, IsAsApproved) {
  for (const auto& [name, pixel] :
       {std::pair("through-samples", "5,3"), std::pair("attribute-zero-in-perspective", "3,2")}) {
    SCOPED_TRACE(name);
    const Outcome outcome =
        explain({corpus_case(std::string(name) + ".json"), "--pixel", pixel, "--triangle", "0"});
    EXPECT_EQ(outcome.code, 0) << outcome;
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(is_approved(explanation(outcome), approved_file(name)));
  }
}

std::string content_of(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Kills: a page of the documentation whose example differs from what is printed.
TEST(Explain, IsAsItsPageShows) {
  const Outcome outcome =
      explain({corpus_case("snapped-8.json"), "--pixel", "3,2", "--attribute", "u"});
  std::string indented;
  std::istringstream lines(explanation(outcome));
  for (std::string line; std::getline(lines, line);) {
    indented += line.empty() ? "\n" : "    " + line + "\n";
  }
  EXPECT_THAT(content_of(source_file("docs/explain.md")), HasSubstr("\n\n" + indented + "\n"));
}

TEST(Explain, PrintsTheInspectionAsJson) {
  const Outcome outcome = explain({"--json", "--pixel", "5,3", "-"}, square_case());
  ASSERT_EQ(outcome.code, 0) << outcome;
  const json document = json::parse(outcome.out);
  EXPECT_EQ(document.at("occasion"), "asked for");
  EXPECT_EQ(document.at("backend"), "cpu");
  EXPECT_EQ(document.at("x"), 5);
  EXPECT_EQ(document.at("y"), 3);
  EXPECT_EQ(document.at("case").at("name"), "square");
  EXPECT_EQ(document.at("samples").size(), 64U);
}

// Kills: explaining a sample that is right although another one is wrong.
TEST(Explain, FindsTheWorstSampleOfAPixelAndOfACase) {
  const Outcome worst =
      run_damaged_program({"explain", "--backend", "damaged", "-"}, square_case());
  EXPECT_EQ(worst.code, 0) << worst;
  EXPECT_THAT(worst.out, HasSubstr("MISSING: not drawn but must be"));
  EXPECT_THAT(explain({"--pixel", "7,6", "-"}, square_case()).out,
              HasSubstr("drawn, as it must be"));
}

TEST(Explain, TakesTheBackendOfACounterexample) {
  const std::string c = square_case(R"("found": {"property": "coverage-obeys-the-contract",
      "backend": "method:rational-linear", "verdict": "missing", "seed": 1, "index": 3}, )");
  EXPECT_THAT(explain({"-"}, c).out, HasSubstr(", on method:rational-linear\n"));
  EXPECT_THAT(explain({"--backend", "cpu", "-"}, c).out, HasSubstr(", on cpu\n"));
}

TEST(Explain, ShowsOneValueIfAsked) {
  const Outcome attribute = explain({"--attribute", "one", "--quiet", "-"}, square_case());
  EXPECT_THAT(attribute.out, AllOf(HasSubstr("\nattribute 1 'one'"), Not(HasSubstr("'x'")),
                                   Not(HasSubstr("\ndepth\n")), Not(HasSubstr("Scale ULP:"))));
  EXPECT_THAT(
      explain({"--attribute", "depth", "-"}, square_case()).out,
      AllOf(HasSubstr("\ndepth\n"), Not(HasSubstr("\nattribute")), HasSubstr("Scale ULP: ")));
}

TEST(Explain, RefusesWhatIsNotThereInOneLine) {
  const auto error = [](const std::vector<std::string>& more, int code = 2) {
    std::vector<std::string> arguments = more;
    arguments.emplace_back("-");
    const Outcome outcome = explain(arguments, square_case());
    EXPECT_TRUE(is_failure(outcome, code)) << outcome;
    return outcome.err;
  };
  EXPECT_THAT(error({"--pixel", "8,3"}),
              StartsWith("rastercheck: -: pixel (8, 3) lies outside the framebuffer of 8 × 8"));
  EXPECT_THAT(error({"--triangle", "2"}),
              HasSubstr("-: triangle 2 does not exist; the case has 2"));
  EXPECT_THAT(error({"--sample", "1"}), HasSubstr("-: sample 1 does not exist; a pixel has 1"));
  EXPECT_THAT(error({"--attribute", "y"}), HasSubstr("-: --attribute: there is no attribute 'y'"));
  for (const char* text : {"8", "-1,2", "1,2,3", "1,", ",1", "1,4294967296", "a"}) {
    EXPECT_THAT(error({fmt::format("--pixel={}", text)}),
                StartsWith(fmt::format("rastercheck: --pixel: {} is not X,Y, two whole", text)));
  }
  EXPECT_THAT(error({"--backend", "gpu"}), HasSubstr("unknown backend"));
  const auto damaged = [](const std::string& backend) {
    return run_damaged_program({"explain", "--backend", backend, "-"}, square_case());
  };
  EXPECT_TRUE(is_failure(damaged("damaged:absent"), 4));
  EXPECT_EQ(damaged("damaged:refuses").err, "rastercheck: -: out of memory\n");
}

// As for `render`: the backend draws clip positions, which have to fit float32.
TEST(Explain, RefusesACameraBeyondFloat32) {
  const std::string camera =
      R"("camera": {"model": ["0x1p+127",0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
                    "view": [4,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}, )";
  const Outcome outcome = explain({"-"}, square_case(camera));
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("-: /vertices/0/position: its clip x overflows float32"));
}

}  // namespace
}  // namespace rastercheck::cli::explain_test
