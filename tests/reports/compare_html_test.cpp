#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "reports/compare_format.h"
#include "reports/internal/viewer.h"
#include "tests/approved_file.h"
#include "tests/records/sample_look.h"
#include "tests/reports/sample_gate.h"

namespace rastercheck::reports::compare_html_test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string page(const Gate& gate) { return find_compare_format("html")->write(gate); }

/// The sample with a look at the case that grew, and with the pixels that the baseline kept of it.
Gate gate_with_pixels() {
  Gate gate = sample_gate();
  gate.looks = {records::sample_look()};
  gate.looks[0].before = records::sample_specimen();
  return gate;
}

/// The page without the style that it shares with report.html, as changes of that style do not
/// count as changes of this page.
std::string without_style(std::string text) {
  const std::size_t at = text.find(kViewerStyle);
  return at == std::string::npos ? text : text.erase(at, kViewerStyle.size());
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(CompareHtml, IsWhatWasApproved) {
  EXPECT_TRUE(is_approved(without_style(page(gate_with_pixels())),
                          RASTERCHECK_SOURCE_DIR "/tests/reports/approved/compare.html"));
}

TEST(CompareHtml, BeginsWithTheVerdictAndTheLargestGrowth) {
  const std::string text = page(gate_with_pixels());
  EXPECT_THAT(text, HasSubstr("<h1 class=\"violated\">Regression: 2 of 3 entries worse"));
  EXPECT_THAT(text, HasSubstr("Largest growth: <a href=\"#case-0-0\">values are &lt;within&gt; "
                              "bounds, random case 12</a>: smooth, sliver, triangle 0, pixel (3, "
                              "5), sample 0, attribute 0: <strong>0.625 → 0.75 scale "
                              "ULP</strong>; the stage to look at is <strong>set-up</strong>"));
  EXPECT_THAT(text, HasSubstr("<details class=\"finding\" id=\"case-0-0\" open>"));
  EXPECT_THAT(text, HasSubstr("set-up <strong>← grew most</strong>"));
  EXPECT_THAT(text, HasSubstr("cpu on x86_64"));
  EXPECT_THAT(text, HasSubstr("<code>c0ffee</code>"));
}

// Kills: pictures of other pixels, or of the wrong side.
TEST(CompareHtml, ShowsOldNewAndDifference) {
  const std::string text = page(gate_with_pixels());
  EXPECT_EQ(count_of(text, "<svg class=\"crop\""), 3U);
  EXPECT_THAT(text, HasSubstr("aria-label=\"Old errors, up to 1 ULP\""));
  EXPECT_THAT(text, HasSubstr("aria-label=\"New errors, up to 3 ULP\""));
  EXPECT_THAT(text, HasSubstr("2 of 2 drawn pixels changed; 1 drawn in only one of them"));
  EXPECT_THAT(text, HasSubstr("d=\"M0 0h1v1h-1z\"><title>(3, 5): 1 ULP off</title>"));
  EXPECT_THAT(text, HasSubstr("d=\"M0 0h1v1h-1z\"><title>(3, 5): 3 ULP off</title>"));
  EXPECT_THAT(text, HasSubstr("d=\"M0 0h1v1h-1z\"><title>(3, 5): 4 ULP apart</title>"));
  EXPECT_THAT(text, HasSubstr("d=\"M1 0h1v1h-1z\"><title>(4, 5): drawn only now</title>"));
  EXPECT_THAT(text, HasSubstr("0x1.00000cp-1")) << "1/2 + 3 · 2^-23";
  EXPECT_THAT(text, HasSubstr("0x1.fffff8p-2")) << "1/2 − 2^-23";
}

// No value of the case was off by more than 5/8. So a value that is off by 3 ULP now has changed by
// at least 19/8, and a value that is exact now need not have changed.
TEST(CompareHtml, SaysWhatIsCertainWithoutOldPixels) {
  Gate gate = sample_gate();
  gate.looks = {records::sample_look()};
  const std::string text = page(gate);
  EXPECT_EQ(count_of(text, "<svg class=\"crop\""), 2U);
  EXPECT_THAT(text, HasSubstr("the baseline kept no pixels of this triangle"));
  EXPECT_THAT(text, HasSubstr("no value of this case was more than 0.625 ULP off"));
  EXPECT_THAT(text, HasSubstr("<title>(3, 5): 2.38 ULP at least</title>"));
  EXPECT_THAT(text, HasSubstr("<path class=\"same\" d=\"M1 0h1v1h-1z\"><title>(4, 5): perhaps "
                              "unchanged</title>"));
}

// Kills: treating values that were not judged before as exact.
TEST(CompareHtml, ClaimsNothingOfErrorsThatNobodyKnows) {
  records::BaselineSection before = records::sample_section();
  before.laws[records::kSampleLaw].cases[records::kSampleCase].worst.clear();
  Gate gate = gate_of(before, sample_grown_section());
  gate.looks = {records::sample_look()};
  const std::string text = page(gate);
  EXPECT_EQ(count_of(text, "<svg class=\"crop\""), 1U);
  EXPECT_THAT(text, HasSubstr("attribute 0: <strong>none → 0.75 scale ULP</strong>"));
  EXPECT_THAT(text, HasSubstr("<small>none → 0.75 scale ULP</small>"));
  EXPECT_THAT(text, HasSubstr("no value had an error, or none was judged"));
}

TEST(CompareHtml, SaysWhereNothingCouldBeDrawn) {
  const std::string text = page(sample_gate());
  EXPECT_EQ(count_of(text, "<svg class=\"crop\""), 0U);
  EXPECT_THAT(text, HasSubstr("No picture: "));
}

// In OpenGL, window y points up, so the upper one of two rows has the greater y.
TEST(CompareHtml, TurnsPicturesAsTheWindowIs) {
  Gate gate = sample_gate();
  gate.looks = {records::sample_look()};
  records::Inspection& inspection = gate.looks[0].inspection;
  inspection.height = 2;
  inspection.source.rules = cases::Rules::opengl;
  const std::string text = page(gate);
  EXPECT_THAT(text, HasSubstr("d=\"M0 1h1v1h-1z\"><title>(3, 5): 3 ULP off</title>"));
  EXPECT_THAT(text, HasSubstr("<polygon points=\"-2.000,6.000 4.000,5.000 -1.000,0.000 \"/>"));
}

TEST(CompareHtml, ShowsPartsThatChangedThoughNoErrorGrew) {
  Gate gate = gate_with_pixels();
  gate.looks[0].kind.reset();
  gate.looks[0].case_name = "a <name>";
  gate.looks[0].key.origin = records::Origin::corpus;
  const std::string text = page(gate);
  EXPECT_THAT(text, HasSubstr("<h2>Changed pixels</h2>"));
  EXPECT_THAT(text, HasSubstr("case 12 of the corpus, “a &lt;name&gt;”"));
  EXPECT_EQ(count_of(text, "<svg class=\"crop\""), 3U);
}

TEST(CompareHtml, SaysWhatThePolicyAllows) {
  Gate gate = sample_gate();
  for (records::EntryChange& entry : gate.comparisons[0].entries) {
    if (entry.change == records::Change::worse) entry.allowed_because = "until <the> fix";
  }
  gate.policy.expired = {"an <old> one"};
  const std::string text = page(gate);
  EXPECT_THAT(text, HasSubstr("<h1 class=\"held\">"));
  EXPECT_THAT(text, HasSubstr("allowed by the policy: until &lt;the&gt; fix"));
  EXPECT_THAT(text, HasSubstr("an &lt;old&gt; one"));
}

TEST(CompareHtml, IsShortWhereNothingChanged) {
  const std::string text = page(gate_of(records::sample_section(), records::sample_section()));
  EXPECT_THAT(text, HasSubstr("No entry is worse than the baseline."));
  EXPECT_THAT(text, Not(HasSubstr("<h2>What is worse</h2>")));
  EXPECT_THAT(text, Not(HasSubstr("<h2>Cases that grew most</h2>")));
}

TEST(CompareHtml, HoldsSeveralBackends) {
  Gate gate = sample_gate();
  gate.comparisons.push_back(
      gate_of(records::sample_section(), records::sample_section()).comparisons[0]);
  const std::string text = page(gate);
  EXPECT_THAT(text, HasSubstr("Regression on 1 of 2 backends."));
  EXPECT_THAT(text, HasSubstr("<h2 id=\"backend-1\" class=\"held\">"));
}

// Kills: text from files that is not escaped.
TEST(CompareHtml, IsNoPageOfWhatNamesSay) {
  const std::string hostile = "\"><script>alert(1)</script><img src=//x>";
  Gate gate = gate_with_pixels();
  records::Comparison& comparison = gate.comparisons[0];
  comparison.key.backend = comparison.key.compiler = hostile;
  comparison.before.version = comparison.before.commit = comparison.after.compiler = hostile;
  comparison.plan.properties = {hostile};
  comparison.new_laws = comparison.gone_laws = {hostile};
  comparison.growths[0].law = comparison.growths[0].name = hostile;
  comparison.growths[0].after->exact = hostile;
  for (records::EntryChange& entry : comparison.entries) entry.key.law = hostile;
  gate.baseline_file = gate.current_file = gate.folder = hostile;
  gate.policy.unused = {hostile};
  gate.looks.push_back(gate.looks[0]);
  gate.looks[0].key.law = gate.looks[1].key.law = gate.looks[1].case_name = hostile;
  gate.looks[1].kind.reset();
  gate.looks[1].key.origin = records::Origin::corpus;
  gate.looks[1].inspection.source.attributes[0].name = hostile;
  const std::string text = page(gate);
  EXPECT_THAT(text, HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(text, Not(HasSubstr("<script")));
  EXPECT_THAT(text, Not(HasSubstr("<img")));
}

// Kills: links that lead nowhere; ids that occur twice.
TEST(CompareHtml, HasOnePlaceForEachLink) {
  const std::string text = page(gate_with_pixels());
  const std::regex link("href=\"#([^\"]*)\"");
  int links = 0;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), link); at != std::sregex_iterator();
       ++at) {
    ++links;
    EXPECT_EQ(count_of(text, " id=\"" + (*at)[1].str() + "\""), 1U) << (*at)[1];
  }
  EXPECT_GE(links, 3);
}

}  // namespace
}  // namespace rastercheck::reports::compare_html_test
