#include "reports/inspection_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace rastercheck::reports::inspection_text_test {
namespace {

using records::Enclosure;
using records::Inspection;
using records::Stage;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Enclosure exactly(double value) { return {value, value}; }

/// A triangle with corners (0, 0), (4, 0), (0, 4) in 4 × 4 pixels, inspected in pixel (1, 0).
Inspection small_inspection() {
  Inspection one;
  one.backend = "cpu";
  one.source.name = "small";
  one.source.framebuffer = {4, 4, 1};
  one.source.viewport = {0, 0, 4, 4, 0, 1};
  one.source.attributes = {{"u"}};
  one.source.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
  one.source.attribute_values = {0, 1, 0};
  one.source.triangles = {{0, 1, 2}};
  one.pattern = {{0.5, 0.5}};
  one.place.x = 1;
  one.attribute = 0;
  one.q_matrix = {{{"-1/4", "-1/4", "1"}, {"1/4", "0", "0"}, {"0", "1/4", "0"}}};
  records::InspectedSample sample;
  sample.place.x = 1;
  sample.verdict = records::Verdict::required;
  sample.reason = records::Reason::inside;
  sample.is_drawn = true;
  sample.distance = exactly(0.5);
  sample.edges = {exactly(0.5), exactly(0.375), exactly(0.125)};
  records::InspectedValue depth;
  depth.exact = "0";
  depth.nearest = 0;
  depth.actual = 0.0F;
  depth.scale_error = exactly(0);
  records::InspectedValue u;
  u.attribute = 0;
  u.exact = "3/8";
  u.nearest = 0.375;
  u.actual = 0.375F + 0x1p-24F;
  u.scale_error = exactly(0.5);
  u.local_error = exactly(2);
  u.excess = exactly(0);
  u.kappa = exactly(1);
  u.kappa_d = exactly(1.5);
  sample.values = {depth, u};
  one.samples = {sample};
  one.width = one.height = 1;
  one.left = 1;
  return one;
}

/// −1 from snapping, +1.75 from the set-up, −0.25 from rounding: +0.5 in total.
records::ErrorSplit small_split() {
  return {0,
          {{Stage::snap, exactly(-1)},
           {Stage::set_up, exactly(1.75)},
           {Stage::rounding, exactly(-0.25)}},
          exactly(0.5),
          true};
}

TEST(InspectionText, SaysWhatIsExactWhatWasDrawnAndHowFarOff) {
  EXPECT_EQ(inspection_text(small_inspection()),
            "drawn, as it must be (required, inside)\n"
            "  pixel (1, 0), sample 0, of triangle 0, on cpu\n"
            "  The sample is at (1.5, 0.5), 0.5 pixels from the boundary that decides\n"
            "  (positive: inside).\n"
            "\n"
            "depth\n"
            "  exact   0\n"
            "  drawn   0 = 0x0p+0\n"
            "  error   0 scale ULP\n"
            "\n"
            "attribute 0 'u', smooth; at the vertices 0, 1, 0\n"
            "  exact   3/8\n"
            "          about 0.375\n"
            "  drawn   0.37500006 = 0x1.800004p-2\n"
            "  error   0.5 scale ULP, 2 local ULP; 0 after allowances\n"
            "  κ       1, κ_D 1.5\n"
            "\n"
            "  y     0   [#]\n"
            "  x          1\n"
            "  # drawn   . correctly not drawn   - MISSING   + EXTRA\n"
            "\n"
            "triangle 0 of 1\n"
            "  of “small”\n"
            "  4 × 4 pixels, viewport 0 0 4 4, rules vulkan\n"
            "  vertex  x   y   z  w  window x  window y\n"
            "  0       -1  -1  0  1  0         0\n"
            "  1       1   -1  0  1  4         0\n"
            "  2       -1  1   0  1  0         4\n"
            "\n"
            "q-matrix, of e_i = A_i u + B_i v + C_i\n"
            "  i  A     B     C\n"
            "  0  -1/4  -1/4  1\n"
            "  1  1/4   0     0\n"
            "  2  0     1/4   0\n"
            "  Here e = (0.5, 0.375, 0.125), and 1/w = D = Σ e_i = 1.\n");
}

// 24 of 80 columns and the axis are taken, so 27 remain on either side, which stand for 1.75.
// Kills: a bar on the wrong side; a total that is not shown.
TEST(InspectionText, SplitsAnErrorByStage) {
  Inspection one = small_inspection();
  one.splits = {small_split()};
  EXPECT_THAT(
      inspection_text(one, 1),
      HasSubstr("\nerror of attribute 0 by stage, in scale ULP, as the backend traced it:\n"
                "    snap      -1.00000              ###############|\n"
                "    set-up    +1.75000                             |###########################\n"
                "    rounding  -0.25000                         ####|\n"
                "    ------------------\n"
                "    total     +0.50000                             |########\n\ntriangle 0"));
  one.splits[0].is_traced = false;
  EXPECT_THAT(inspection_text(one), HasSubstr("in scale ULP, without the backend's own stages:\n"));
  one.splits[0].parts[2].error = exactly(-0x1p-40);
  EXPECT_THAT(inspection_text(one),
              HasSubstr("    rounding  -9.1e-13                            .|\n"));
  one.splits[0].parts = {{Stage::rounding, exactly(0)}};
  one.splits[0].total = exactly(0);
  EXPECT_THAT(inspection_text(one), HasSubstr("\nerror of attribute 0: no stage is off\n"));
}

TEST(InspectionText, ShowsOneValueIfAsked) {
  EXPECT_THAT(inspection_text(small_inspection(), 0),
              AllOf(HasSubstr("\ndepth\n"), Not(HasSubstr("\nattribute"))));
  EXPECT_THAT(inspection_text(small_inspection(), 1),
              AllOf(Not(HasSubstr("\ndepth\n")), HasSubstr("\nattribute 0 'u'")));
}

TEST(InspectionText, SaysHowCoverageIsWrong) {
  Inspection one = small_inspection();
  records::InspectedSample& sample = one.samples[0];
  sample.is_drawn = false;
  sample.values[1].actual.reset();
  sample.values[1].scale_error.reset();
  one.coverage_stage = Stage::snap;
  EXPECT_THAT(inspection_text(one),
              AllOf(StartsWith("MISSING: not drawn but must be (required, inside)\n"),
                    HasSubstr("Up to the stage `snap` its coverage is right"),
                    HasSubstr("  drawn   nothing\n")));
  sample.verdict = records::Verdict::forbidden;
  sample.reason = records::Reason::outside;
  EXPECT_THAT(inspection_text(one), StartsWith("not drawn, correctly (forbidden, outside)"));
  sample.is_drawn = true;
  EXPECT_THAT(inspection_text(one), StartsWith("EXTRA: drawn but must not be (forbidden, "));
  sample.verdict = records::Verdict::permitted;
  EXPECT_THAT(inspection_text(one), StartsWith("drawn, as it may be (permitted, "));
  sample.is_drawn = false;
  EXPECT_THAT(inspection_text(one), StartsWith("not drawn, as it may be (permitted, "));
}

// Kills: "drawn, as it must be" and no more, above a value that is NaN.
TEST(InspectionText, BeginsWithValuesThatAreNoNumbers) {
  Inspection one = small_inspection();
  one.samples[0].values[1].actual = -std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(
      inspection_text(one),
      StartsWith("drawn, as it must be (required, inside); WRONG: attribute 0 'u' is NaN\n"));
  one.samples[0].values[0].actual = std::numeric_limits<float>::infinity();
  EXPECT_THAT(inspection_text(one), HasSubstr("WRONG: depth is inf, attribute 0 'u' is\nNaN\n"));
}

TEST(InspectionText, SaysWhatIsNotThere) {
  Inspection one = small_inspection();
  one.q_matrix.reset();
  one.samples[0].edges.reset();
  one.source.positions[2].w = -1;
  one.samples[0].values[1].exact = "";
  one.samples[0].values[1].nearest.reset();
  one.samples[0].values[1].actual = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(inspection_text(one),
              AllOf(HasSubstr("seen edge-on"), Not(HasSubstr("q-matrix")),
                    HasSubstr("1 of its vertices is not in front of the eye"),
                    HasSubstr("  exact   undefined\n  drawn   NaN\n"), Not(HasSubstr("WRONG"))));
  one.samples.clear();
  EXPECT_EQ(inspection_text(one), "");
}

/// The length of the longest line, in UTF-8 characters.
std::size_t longest_line(const std::string& text) {
  std::size_t longest = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto characters =
        std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
    longest = std::max(longest, static_cast<std::size_t>(characters));
  }
  return longest;
}

// Kills: leaving it to the terminal to break a fraction, or the bars of a split.
TEST(InspectionText, FitsATerminal) {
  Inspection one = small_inspection();
  const std::string fraction = std::string(90, '1') + "…" + std::string(90, '2');
  for (auto& row : *one.q_matrix) row = {fraction, "-1/4", fraction};
  one.samples[0].values[1].exact = "[" + fraction + ", " + fraction + "]";
  one.samples[0].values[1].scale_error = Enclosure{-1.2345678901234567e300, 1e300};
  one.samples[0].values[1].excess = Enclosure{-1.2345678901234567e300, 1e300};
  one.splits = {small_split()};
  one.splits[0].parts[0].error = exactly(-1e300);
  one.source.name =
      "A name of more than eighty characters, which is wrapped at spaces as it would be "
      "in a book";
  const std::string text = inspection_text(one);
  EXPECT_EQ(longest_line(text), 80U) << text;
  // With its lines joined, the text contains the whole fraction.
  std::string joined;
  std::istringstream words(text);
  for (std::string word; words >> word;) joined += word;
  EXPECT_THAT(joined, HasSubstr("A_0" + fraction + "B_0-1/4"));
  EXPECT_LE(longest_line(inspection_legend()), 80U);
}

}  // namespace
}  // namespace rastercheck::reports::inspection_text_test
