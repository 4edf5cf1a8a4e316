#include "reports/internal/report_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::report_findings_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count_of(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Findings, AnInspectionStandsWithItsCounterexample) {
  const std::string page = findings_of(sample_run());
  EXPECT_EQ(count_of(page, "<details class=\"finding\""), 3U);
  EXPECT_EQ(count_of(page, "viewer-place"), 2U);
  // The first counterexample is open and has the first viewer. The second has no viewer and shows
  // its text.
  EXPECT_THAT(page, HasSubstr("<details class=\"finding\" id=\"inspection=0\" "
                              "data-inspection=\"0\" open>"));
  EXPECT_THAT(page, HasSubstr("<details class=\"finding\">"));
  EXPECT_EQ(count_of(page, "<pre class=\"unscripted\">"), 1U);
  // Each finding has its case.
  EXPECT_EQ(count_of(page, "<summary>The case: state, vertices, triangles</summary>\n<pre>"), 3U);
  EXPECT_EQ(count_of(page, "<pre>"), 1U + 3U);
  EXPECT_THAT(page, HasSubstr("<p>Made smaller from “"));
}

TEST(Findings, AWorstCaseSaysWhatItIsTheWorstOf) {
  const std::string page = findings_of(sample_run());
  EXPECT_THAT(page, HasSubstr("<span class=\"title\">smooth, near horizon: 0.5"));
  EXPECT_THAT(page, HasSubstr("<h2>Worst cases</h2>"));
}

TEST(Findings, WithoutInspectionsThereIsNoViewer) {
  records::Run run = sample_run();
  run.inspections.clear();
  EXPECT_THAT(findings_of(run), Not(HasSubstr("viewer-place")));
  EXPECT_THAT(findings_of(run), Not(HasSubstr("Worst cases")));
  run.counterexamples.clear();
  EXPECT_EQ(findings_of(run), "");
}

TEST(Findings, SayWhatWasNotDrawn) {
  records::Run run = sample_run();
  records::Inspection& inspection = run.inspections[0];
  inspection.place.x = 2;
  inspection.place.y = 5;
  EXPECT_THAT(findings_of(run), HasSubstr("and was not drawn"));
  inspection.samples.clear();
  EXPECT_THAT(findings_of(run), Not(HasSubstr("and was not drawn")));
}

}  // namespace
}  // namespace rastercheck::reports::report_findings_test
