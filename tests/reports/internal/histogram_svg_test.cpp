#include "reports/internal/histogram_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <string>
#include <vector>

namespace rastercheck::reports {
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

// 1/2 is the upper end of its octave, which it belongs to. Kills: octaves that are off by a bucket.
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

// Heights are (log2(count) + 1) / (log2(most) + 1) of 100. Kills: a linear scale.
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

}  // namespace
}  // namespace rastercheck::reports
