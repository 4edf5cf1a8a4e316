#include "reports/finding_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::finding_text_test {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::Violation;

/// A triangle with one attribute of values 0, 1 and 2, and one sample per pixel.
cases::Case simple_case() {
  cases::Case c;
  c.framebuffer = {8, 8, 1};
  c.viewport.width = 8;
  c.viewport.height = 8;
  c.attributes.resize(1);
  c.attributes[0].name = "u";
  c.positions.resize(3);
  c.attribute_values = {0, 1, 2};
  c.triangles = {{0, 1, 2}};
  return c;
}

Violation wrong_value(const std::string& exact, const std::string& drawn) {
  Violation v;
  v.fragment_class = FragmentClass::beyond_bound;
  v.kind = AttributeKind::smooth;
  v.place = {0, 5, 3, 0};
  v.attribute = 0;
  v.exact = exact;
  v.actual = drawn;
  v.error = {3, 3};
  v.bound = {0.5, 0.5};
  return v;
}

std::string text_of(const Violation& v) { return finding_text(v, simple_case()); }

// Kills: numbers that look the same; a range of which one end is shown.
TEST(FindingText, HasTheDigitsThatTellNumbersApart) {
  EXPECT_EQ(text_of(wrong_value("1/3", "0.333333343 (0x1.555556p-2)")),
            "pixel (3, 5) of triangle 0: attribute 'u' was drawn as 0.33333334 and must be "
            "0.33333333; off by 3 scale ULP, 0.5 allowed");
  EXPECT_EQ(
      finding_fault(wrong_value("[16/100, 17/100]", "0.143000007 (0x1.24dd3p-3)"), simple_case()),
      "attribute 'u' was drawn as 0.143 and must be 0.16 to 0.17");
  EXPECT_EQ(
      finding_fault(wrong_value("[100001/100000, 100002/100000]", "0 (0x0p+0)"), simple_case()),
      "attribute 'u' was drawn as 0 and must be 1.00001 to 1.00002");
}

// Kills: a share of the largest value; the distance to the far end of a range.
TEST(FindingText, MeasuresInTheRangeOfTheAttribute) {
  const auto severity = [](const Violation& v) { return finding_severity(v, simple_case()); };
  // The values span 2; 1/9 is 1/18 of that.
  EXPECT_EQ(severity(wrong_value("[1/9, 1]", "0 (0x0p+0)")),
            "off by 1/18 of the attribute's range (3 scale ULP, 0.5 allowed)");
  EXPECT_EQ(severity(wrong_value("1", "2.5 (0x1.4p+1)")),
            "off by 0.75 of the attribute's range (3 scale ULP, 0.5 allowed)");
  EXPECT_EQ(severity(wrong_value("0", "8 (0x1p+3)")),
            "off by 4 times the attribute's range (3 scale ULP, 0.5 allowed)");
  Violation many = wrong_value("0", "2 (0x1p+1)");
  many.error = {8388608, 8388608};
  EXPECT_EQ(severity(many),
            "off by all of the attribute's range (8.4 million scale ULP, 0.5 allowed)");
  many.error = {3e15, 3e15};
  many.bound.reset();
  EXPECT_EQ(severity(many), "off by all of the attribute's range (3e+15 scale ULP)");
}

// Kills: "off by -3".
TEST(FindingText, SaysHowFarOffWithoutASign) {
  Violation v = wrong_value("1/3", "0.333333343 (0x1.555556p-2)");
  v.error = {-3, -3};
  EXPECT_EQ(finding_severity(v, simple_case()), "off by 3 scale ULP, 0.5 allowed");
}

TEST(FindingText, MeasuresDepthInTheDepthRange) {
  Violation v = wrong_value("0", "-0.5 (-0x1p-1)");
  v.kind = AttributeKind::depth;
  v.attribute.reset();
  EXPECT_EQ(text_of(v),
            "pixel (3, 5) of triangle 0: depth was drawn as -0.5 and must be 0; off by 1/2 of the "
            "depth range (0 to 1) (3 ULP, 0.5 allowed)");
}

TEST(FindingText, NamesWhatIsNoNumber) {
  Violation v = wrong_value("1/4", "nan");
  v.fragment_class = FragmentClass::not_a_number;
  v.error.reset();
  EXPECT_EQ(text_of(v),
            "pixel (3, 5) of triangle 0: attribute 'u' was drawn as NaN and must be 0.25");
  v.fragment_class = FragmentClass::wrong_sign_of_zero;
  EXPECT_EQ(finding_fault(v, simple_case()),
            "attribute 'u' was drawn as the zero of the other sign");
  // A law that compares with another drawing may expect NaN.
  EXPECT_EQ(finding_fault(wrong_value("nan", "1 (0x1p+0)"), simple_case()),
            "attribute 'u' was drawn as 1 and must be nan");
}

TEST(FindingText, SaysWhatIsCalledOccluded) {
  Violation v;
  v.fragment_class = FragmentClass::missing;
  v.place = {1, 5, 3, 0};
  v.exact = "required: its depth is at most 0.5, that of occluders at least 1";
  v.actual = "called occluded";
  EXPECT_EQ(
      finding_text(v, simple_case()),
      "pixel (3, 5) of triangle 1: the triangle is called occluded, but the sample is visible "
      "(its depth is at most 0.5, that of occluders at least 1)");
}

TEST(FindingText, SaysWhetherASampleMustBeDrawn) {
  Violation v;
  v.fragment_class = FragmentClass::missing;
  v.place = {0, 5, 3, 2};
  v.exact = "required: inside";
  v.actual = "not drawn";
  v.distance = {0.25, 0.25};
  cases::Case several = simple_case();
  several.framebuffer.samples = 4;
  EXPECT_EQ(finding_text(v, several),
            "pixel (3, 5), sample 2, of triangle 0: the sample is not drawn and must be (inside); "
            "0.25 pixels from the boundary");
  v.fragment_class = FragmentClass::extra;
  v.exact = "forbidden: outside";
  v.actual = "drawn";
  EXPECT_EQ(finding_fault(v, several), "the sample is drawn and must not be (outside)");
  v.exact = "required: inside";
  EXPECT_EQ(finding_fault(v, several), "the sample is drawn more than once");
  v.distance = {0, 0};
  v.exact = "forbidden: outside";
  EXPECT_EQ(
      finding_text(v, simple_case()),
      "pixel (3, 5) of triangle 0: the sample is drawn and must not be: it lies exactly on an "
      "edge, and the fill rule gives it to the other side");
  v.fragment_class = FragmentClass::missing;
  v.exact = "required: tie";
  EXPECT_EQ(finding_fault(v, several),
            "the sample is not drawn and must be: it lies exactly on an edge, and the fill rule "
            "gives it to this triangle");
  v.fragment_class = FragmentClass::wrong_triangle;
  EXPECT_EQ(finding_fault(v, several),
            "the triangle is visible and must not be: another one is nearest here");
}

TEST(FindingText, SaysWhyNothingWasDrawn) {
  Violation v;
  v.fragment_class = FragmentClass::crash;
  v.note = "its process ended";
  EXPECT_EQ(text_of(v), "its process ended");
  EXPECT_EQ(finding_severity(v, simple_case()), "");
}

// Kills: reading beyond the case, which a file from elsewhere may lead to.
TEST(FindingText, StaysWithinTheCase) {
  Violation v = wrong_value("0", "1 (0x1p+0)");
  v.attribute = 7;
  EXPECT_EQ(text_of(v),
            "pixel (3, 5) of triangle 0: attribute 7 was drawn as 1 and must be 0; off "
            "by 3 scale ULP, 0.5 allowed");
  v.attribute = 0;
  v.place.triangle = 9;
  EXPECT_EQ(finding_severity(v, simple_case()), "off by 3 scale ULP, 0.5 allowed");
}

}  // namespace
}  // namespace rastercheck::reports::finding_text_test
