#include "reports/error_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

namespace rastercheck::reports::error_scale_test {
namespace {

using testing::HasSubstr;

// The first and the last label are at the ends, and each step between labels is the same part of
// the ramp. Kills: labels of another scale.
TEST(ErrorScale, HasItsLabelsWhereItsColoursAre) {
  struct Labelled {
    const ErrorScale* scale;
    float least;
  };
  for (const Labelled& at :
       {Labelled{&ulp_scale(), 0x1p-6F}, {&texel_scale(), 0x1p-4F}, {&level_scale(), 0x1p-4F}}) {
    float error = at.least;
    const std::size_t last = at.scale->labels.size() - 1;
    for (std::size_t i = 0; i <= last; ++i, error *= 4) {
      const double share = static_cast<double>(i) / static_cast<double>(last);
      EXPECT_EQ(error_color(*at.scale, error), ramp_color(*at.scale, share)) << at.scale->labels[i];
    }
    EXPECT_EQ(error_color(*at.scale, error), at.scale->ramp.back());
    EXPECT_EQ(error_color(*at.scale, 0), at.scale->ramp.front());
    EXPECT_EQ(error_color(*at.scale, std::numeric_limits<float>::quiet_NaN()), at.scale->violated);
  }
}

// Kills: maps of rounding errors and of texels that look alike.
TEST(ErrorScale, OfTexelsHasOtherColoursThanOfRoundings) {
  std::set<Color> seen(ulp_scale().ramp.begin(), ulp_scale().ramp.end());
  seen.insert(ulp_scale().violated);
  for (const Color& color : texel_scale().ramp) EXPECT_FALSE(seen.contains(color));
  EXPECT_FALSE(seen.contains(texel_scale().violated));
}

TEST(LegendSvg, NamesUnitAndEnds) {
  const std::string svg = legend_svg(texel_scale());
  EXPECT_THAT(svg, HasSubstr(">error in texels, logarithmic<"));
  EXPECT_THAT(svg, HasSubstr(">1/16<"));
  EXPECT_THAT(svg, HasSubstr(">256<"));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"Colours from 1/16 to 256 texels\""));
}

}  // namespace
}  // namespace rastercheck::reports::error_scale_test
