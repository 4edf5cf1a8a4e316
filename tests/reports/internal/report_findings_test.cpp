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

std::string both(const records::Run& run) {
  const Findings findings = findings_of(run);
  return findings.counterexamples + findings.worst;
}

TEST(Findings, AnInspectionStandsWithItsCounterexample) {
  const std::string page = both(sample_run());
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
  EXPECT_THAT(page, HasSubstr("<p><small>Shrunk from the case “"));
}

TEST(Findings, AWorstCaseSaysWhatItIsTheWorstOf) {
  const std::string page = both(sample_run());
  EXPECT_THAT(page, HasSubstr("<span class=\"title\">smooth, near horizon: 0.5"));
  EXPECT_THAT(page, HasSubstr("<h2>Largest errors</h2>"));
}

TEST(Findings, WithoutInspectionsThereIsNoViewer) {
  records::Run run = sample_run();
  run.inspections.clear();
  EXPECT_THAT(both(run), Not(HasSubstr("viewer-place")));
  EXPECT_THAT(both(run), Not(HasSubstr("Largest errors")));
  run.counterexamples.clear();
  run.causes.clear();
  EXPECT_EQ(both(run), "");
}

TEST(Findings, SayWhatWasNotDrawn) {
  records::Run run = sample_run();
  records::Inspection& inspection = run.inspections[0];
  inspection.place.x = 2;
  inspection.place.y = 5;
  EXPECT_THAT(both(run), HasSubstr("and was not drawn"));
  inspection.samples.clear();
  EXPECT_THAT(both(run), Not(HasSubstr("and was not drawn")));
}

// Kills: a heading that names a place but no fault; a cause that does not list its other
// counterexamples.
TEST(Findings, SayTheFaultInTheirHeading) {
  const std::string page = both(sample_run());
  EXPECT_THAT(page, HasSubstr("<h3>1. values are wrong where a pixel has several samples"));
  EXPECT_THAT(page,
              HasSubstr("attribute &#39;u &amp; v&#39; was drawn as 16.800001 and must be 16.8;"));
  EXPECT_THAT(page, HasSubstr("<summary>1 more counterexample</summary>"));
  EXPECT_THAT(page, HasSubstr("<summary>Experiments on its smallest counterexample</summary>"));
}

// Kills: a sample that must not be drawn, shown by a depth that is right.
TEST(Findings, ShowTheCoverageOfAWrongSample) {
  records::Run run = sample_run();
  ASSERT_EQ(run.inspections.at(0).counterexample, 0U);
  EXPECT_THAT(findings_of(run).counterexamples, HasSubstr(" by stage"));
  run.counterexamples.at(0).violations.at(0).kind = records::AttributeKind::coverage;
  EXPECT_THAT(findings_of(run).counterexamples, Not(HasSubstr(" by stage")));
}

}  // namespace
}  // namespace rastercheck::reports::report_findings_test
