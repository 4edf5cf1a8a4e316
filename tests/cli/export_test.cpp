#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::export_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const kCase = "cases/corpus/behind-the-eye.json";

// The damaged backend leaves samples out, so that there is something to report.
TEST(Export, WritesTheFirstFaultAsABugReport) {
  const Outcome bug = run_damaged_program(
      {"export", source_file(kCase), "--format", "bug", "--backend", "damaged:slow"});
  EXPECT_EQ(bug.code, 0) << bug;
  EXPECT_TRUE(bug.out.starts_with("# damaged:slow: the sample is not drawn and must be")) << bug;
  EXPECT_THAT(bug.out, AllOf(HasSubstr("## The case"), HasSubstr("\"rastercheck-case\""),
                             HasSubstr("replay case.json --backend damaged:slow --no-known")));
}

TEST(Export, WritesAFigureOfAnyCase) {
  const TemporaryFolder folder;
  const std::string file = folder.path("case.svg");
  const Outcome svg =
      run_program({"export", source_file(kCase), "--format", "svg", "--output", file});
  EXPECT_EQ(svg.code, 0) << svg;
  EXPECT_EQ(svg.out, "");
  EXPECT_THAT(folder.content("case.svg"), AllOf(HasSubstr("<svg xmlns="), HasSubstr("</svg>\n")));
  const std::string input = folder.put("in.json", "{}");
  EXPECT_TRUE(is_failure(run_program({"export", input, "--format", "svg"}), 2));
}

TEST(Export, RefusesWhatItCannotSay) {
  const Outcome held = run_program({"export", source_file(kCase), "--format", "bug"});
  EXPECT_TRUE(is_failure(held, 2)) << held;
  EXPECT_THAT(held.err, HasSubstr("nothing is wrong with it"));
  EXPECT_TRUE(is_failure(run_program({"export", source_file(kCase), "--format", "none"}), 2));
  EXPECT_TRUE(is_failure(run_program({"export", source_file(kCase)}), 2));
  EXPECT_TRUE(is_failure(
      run_program({"export", source_file(kCase), "--format", "svg", "--backend", "none"}), 2));
}

}  // namespace
}  // namespace rastercheck::cli::export_test
