// `rastercheck deqp`: a second opinion on dEQP's tests.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cases/files.h"
#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::deqp_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Six tests: two with the right verdict, one that fails though no pixel is wrong, one that passes
/// though a pixel is wrong, and two that cannot be judged. `cpu` drew the pictures.
std::string small_log() {
  return cases::read_text(source_file("tests/cases/deqp/small.qpa")).value();
}

/// Returns the log of the first test whose path goes on with `path` after "…rasterization.".
std::string one_test(const std::string& path) {
  const std::string log = small_log();
  const std::size_t begin =
      log.find("#beginTestCaseResult dEQP-GLES3.functional.rasterization." + path);
  return log.substr(begin, log.find("#endTestCaseResult", begin) - begin) + "#endTestCaseResult\n";
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), by);
}

TEST(Deqp, SaysWhichVerdictsAreRight) {
  const Outcome outcome = run_program({"deqp", "-", "--json"}, small_log());
  EXPECT_EQ(outcome.code, 1) << outcome;
  const json said = json::parse(outcome.out);
  std::string opinions;
  for (const json& test : said.at("tests")) {
    opinions += test.at("opinion").get<std::string>() + ", ";
  }
  EXPECT_EQ(opinions, "agrees, disagrees, disagrees, agrees, not judged, not judged, ");
  const Outcome text = run_program({"deqp", "-"}, small_log());
  EXPECT_THAT(text.out, HasSubstr("agrees with dEQP on 2, disagrees on 2, no opinion on 2"));
  EXPECT_THAT(text.out, HasSubstr("1 of 256 pixels are wrong"));
}

TEST(Deqp, ExitCodesSayWhetherItAgrees) {
  EXPECT_EQ(run_program({"deqp", "-"}, one_test("primitives")).code, 0);
  EXPECT_EQ(run_program({"deqp", "-"}, one_test("fbo.texture_2d")).code, 1);
  EXPECT_EQ(run_program({"deqp", "-"}, one_test("fill_rules")).code, 5);
}

TEST(Deqp, BrokenInputIsOneLine) {
  const std::string log = one_test("primitives");
  EXPECT_TRUE(is_failure(run_program({"deqp", "-"}, "no log"), 2));
  const Outcome broken = run_program({"deqp", "-"}, replaced(log, "iVBORw0KGgo", "iVBORw0KGga"));
  EXPECT_TRUE(is_failure(broken, 2)) << broken;
  EXPECT_THAT(broken.err, HasSubstr("primitives.triangles: "));
  const Outcome larger = run_program({"deqp", "-"}, replaced(log, "Width=\"16\"", "Width=\"17\""));
  EXPECT_TRUE(is_failure(larger, 2)) << larger;
  EXPECT_THAT(larger.err, HasSubstr("size"));
}

TEST(Deqp, SavedDrawingsCanBeJudgedAgain) {
  const TemporaryFolder folder;
  const std::string log = replaced(one_test("primitives"), "dEQP-GLES3", "../dEQP-GLES3");
  const Outcome outcome = run_program({"deqp", "-", "--save", folder.path("judged")}, log);
  EXPECT_EQ(outcome.code, 0) << outcome;
  const std::string name =
      folder.path("judged/.._dEQP-GLES3.functional.rasterization.primitives.triangles-1");
  const Outcome again = run_program({"judge", name + ".json", name + ".png"});
  EXPECT_EQ(again.code, 0) << again;
}

}  // namespace
}  // namespace rastercheck::cli::deqp_test
