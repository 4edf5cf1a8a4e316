#include "reports/internal/histogram_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace rastercheck::reports::histogram_svg_test {
namespace {

using records::Histogram;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Bar {
  double height;
  std::string title;
};

std::vector<Bar> bars_of(const std::string& svg) {
  std::vector<Bar> bars;
  const std::regex rect(R"re(<rect [^>]*height="([0-9.]+)"><title>([^<]*)</title></rect>)re");
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), rect); at != std::sregex_iterator();
       ++at) {
    bars.push_back({std::stod((*at)[1]), (*at)[2]});
  }
  return bars;
}

std::vector<std::string> titles_of(const Histogram& histogram) {
  std::vector<std::string> titles;
  for (const Bar& bar : bars_of(histogram_svg(histogram, "t"))) titles.push_back(bar.title);
  return titles;
}

TEST(HistogramSvg, IsEmptyWithoutFiniteValues) {
  Histogram histogram;
  EXPECT_EQ(histogram_svg(histogram, "t"), "");
  histogram.add_non_finite(3);
  EXPECT_EQ(histogram_svg(histogram, "t"), "");
}

// 1/2 is the upper end of its octave and belongs to that octave. Kills: octaves that are off by a
// bucket.
TEST(HistogramSvg, HasABarForEachOctaveBetweenTheEnds) {
  Histogram histogram;
  for (const double magnitude : {0.5, 0.26, 0.0626}) histogram.add(magnitude);
  EXPECT_THAT(titles_of(histogram),
              ElementsAre("2^-4 &lt; error ≤ 2^-3: 1 value", "2^-3 &lt; error ≤ 2^-2: 0 values",
                          "2^-2 &lt; error ≤ 2^-1: 2 values"));
}

TEST(HistogramSvg, HasBarsForZeroAndForTheEnds) {
  Histogram histogram;
  histogram.add(0);
  histogram.add(std::numeric_limits<double>::denorm_min());
  histogram.add(0x1p40);
  histogram.add(0x1.8p40);
  const std::vector<std::string> titles = titles_of(histogram);
  ASSERT_EQ(titles.size(), 63U);
  EXPECT_EQ(titles[0], "error 0: 1 value");
  EXPECT_EQ(titles[1], "0 &lt; error ≤ 2^-20: 1 value");
  EXPECT_EQ(titles[2], "2^-20 &lt; error ≤ 2^-19: 0 values");
  EXPECT_EQ(titles[61], "2^39 &lt; error ≤ 2^40: 1 value");
  EXPECT_EQ(titles[62], "error &gt; 2^40: 1 value");
}

// Heights are 100 (log2(count) + 1) / (log2(most) + 1). Kills: a linear scale.
TEST(HistogramSvg, HeightsAreLogarithmic) {
  Histogram histogram;
  histogram.add_to_bucket(0, 1);
  histogram.add_to_bucket(Histogram::bucket_of(1), 8);
  const std::vector<Bar> bars = bars_of(histogram_svg(histogram, "t"));
  ASSERT_EQ(bars.size(), 2U);
  EXPECT_EQ(bars[0].height, 25);
  EXPECT_EQ(bars[1].height, 100);
}

TEST(HistogramSvg, EscapesItsTitle) {
  Histogram histogram;
  histogram.add(1);
  EXPECT_THAT(histogram_svg(histogram, "a \"<b>\""),
              HasSubstr("aria-label=\"a &quot;&lt;b&gt;&quot;\""));
}

/// The position of the line at a limit; empty if there is no line.
std::optional<double> line_at(const Histogram& histogram, double limit) {
  const std::string svg = histogram_svg(histogram, "t", Limit{limit, "bound"});
  const std::regex line(R"re(<line class="limit" x1="([0-9.]+)")re");
  std::smatch match;
  if (!std::regex_search(svg, match, line)) return std::nullopt;
  return std::stod(match[1]);
}

// Three bars, (1/4, 1/2], (1/2, 1] and (1, 2], each 34 units wide, starting at 6.
TEST(HistogramSvg, HasALineAtTheLimit) {
  Histogram histogram;
  for (const double magnitude : {0.3, 0.6, 2.0}) histogram.add(magnitude);
  EXPECT_EQ(line_at(histogram, 0.5), 6 + 34);
  EXPECT_EQ(line_at(histogram, 0.75), 6 + 51);
  EXPECT_EQ(line_at(histogram, 2), 6 + 102);
  EXPECT_EQ(line_at(histogram, 4), std::nullopt);
  EXPECT_EQ(line_at(histogram, 0.25), std::nullopt);
  EXPECT_THAT(histogram_svg(histogram, "t", Limit{0.5, "a < b"}),
              HasSubstr(">a &lt; b 0.5</text>"));
}

TEST(HistogramSvg, TheLimitIsNoneOfZeros) {
  Histogram histogram;
  histogram.add(0);
  EXPECT_EQ(line_at(histogram, 0.5), std::nullopt);
  histogram.add(0.5);
  EXPECT_EQ(line_at(histogram, 0.5), 6 + 68);
}

TEST(HistogramData, CountsByOctave) {
  Histogram histogram;
  EXPECT_EQ(histogram_data(histogram, {}), R"({"zero":0,"octaves":[],"beyond":0})");
  for (const double magnitude : {0.0, 0.0, 0.5, 0.26, 2.0, 0x1p60}) histogram.add(magnitude);
  EXPECT_EQ(histogram_data(histogram, Limit{0.5, "a \"bound\""}),
            R"({"zero":2,"octaves":[[-1,2],[1,1]],"beyond":1,"limit":0.5,)"
            R"("limitName":"a \"bound\""})");
}

// --- Two histograms ------------------------------------------------------------------------------

Histogram histogram_of(const std::vector<double>& magnitudes) {
  Histogram histogram;
  for (const double magnitude : magnitudes) histogram.add(magnitude);
  return histogram;
}

/// The classes and heights of the bars of each octave, with their text.
std::vector<std::string> pairs_of(const std::string& svg) {
  std::vector<std::string> pairs;
  const std::regex group("<g><title>([^<]*)</title>(.*)</g>");
  const std::regex rect(R"re(<rect class="(\w+)" [^>]*height="([0-9.]+)"/>)re");
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), group); at != std::sregex_iterator();
       ++at) {
    std::string pair = (*at)[1];
    const std::string bars = (*at)[2];
    for (auto bar = std::sregex_iterator(bars.begin(), bars.end(), rect);
         bar != std::sregex_iterator(); ++bar) {
      pair += "; " + (*bar)[1].str() + " " + (*bar)[2].str();
    }
    pairs.push_back(pair);
  }
  return pairs;
}

// The greatest count, 4, has a height of 100 units. On the scale log2 + 1 it is 3, so a count of 1
// has a third of the height, and 2 has two thirds. Kills: exchanging the sides; a scale or octaves
// of its own for each side.
TEST(OverlaySvg, HasBothOnOneScale) {
  const std::string svg =
      overlay_svg(histogram_of({0, 0.5, 0.5, 0.5, 0.5}), histogram_of({0.5, 2, 2}), "old & new");
  EXPECT_THAT(pairs_of(svg),
              ElementsAre("error 0: 1 → 0 values; before 33.3",
                          "2^-2 &lt; error ≤ 2^-1: 4 → 1 value; after 33.3; before 100.0",
                          "2^-1 &lt; error ≤ 2^0: 0 → 0 values",
                          "2^0 &lt; error ≤ 2^1: 0 → 2 values; after 66.7"));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"old &amp; new\""));
  EXPECT_THAT(svg, HasSubstr("4 values in the highest bar"));
}

TEST(OverlaySvg, IsEmptyOnlyWhereNeitherHasValues) {
  EXPECT_EQ(overlay_svg({}, {}, "t"), "");
  EXPECT_THAT(pairs_of(overlay_svg({}, histogram_of({1}), "t")),
              ElementsAre("2^-1 &lt; error ≤ 2^0: 0 → 1 value; after 100.0"));
  EXPECT_THAT(pairs_of(overlay_svg(histogram_of({1}), {}, "t")),
              ElementsAre("2^-1 &lt; error ≤ 2^0: 1 → 0 values; before 100.0"));
}

TEST(OverlayTable, HasTheNumbers) {
  Histogram after = histogram_of({4, 4});
  after.add_non_finite(3);
  const std::string table = overlay_table(histogram_of({1}), after);
  const auto row = [](const std::string& of, const std::string& before, const std::string& now) {
    return "<tr><td>" + of + "</td><td class=\"number\" data-name=\"baseline\">" + before +
           "</td><td class=\"number\" data-name=\"now\">" + now + "</td></tr>";
  };
  EXPECT_THAT(table, HasSubstr(row("2^-1 &lt; error ≤ 2^0", "1", "0")));
  EXPECT_THAT(table, HasSubstr(row("2^1 &lt; error ≤ 2^2", "0", "2")));
  EXPECT_THAT(table, HasSubstr(row("not finite", "0", "3")));
  EXPECT_THAT(table, ::testing::Not(HasSubstr("2^0 &lt; error"))) << "empty ones are left out";
}

}  // namespace
}  // namespace rastercheck::reports::histogram_svg_test
