// The oracle leaves the processor's floating-point control as it found it: rounding mode, flushing,
// masks. Otherwise a backend that runs afterwards would compute something else.

#include <gtest/gtest.h>

#include <bit>
#include <cfenv>
#include <cstdint>
#include <vector>

#include "oracle/fragments.h"
#include "oracle/judged_transform.h"
#include "oracle/referee.h"
#include "oracle/texture_truth.h"
#include "oracle/transform.h"
#include "oracle/ulp.h"
#include "tests/floating_point_control.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::floating_point_state_test {
namespace {

unsigned control_bits() { return floating_point_control() & ~kSticky; }

void use_everything() {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                             {{{-1, -1, 0, 1}, {1.25F, -1, 0.5F, 1.5F}, {-1, 1, 0.25F, 0.75F}}},
                             {{{0.5F}, {1}, {3}}});
  c.attributes[0].location = cases::Location::centroid;
  c.coverage = cases::Snapping{4, cases::Rounding::unspecified, 0.5F};
  c.basis = cases::Basis::unspecified;
  cases::Texturing texturing;
  texturing.texture = {8, 8, std::vector<std::uint8_t>(256)};
  const TextureTruth texture(texturing);
  for (const auto& coverage : {c.coverage, cases::Coverage{}}) {
    c.coverage = coverage;
    const SceneTruth scene(c, cases::contract_of(c));
    for_each_fragment(scene, [&texture](const Fragment& f, const TriangleTruth& truth) {
      const auto x = static_cast<int>(f.place.x);
      const auto y = static_cast<int>(f.place.y);
      const auto sample = static_cast<int>(f.place.sample);
      truth.distance(x, y, sample);
      truth.derivatives(0, x, y, sample);
      if (const auto slopes = truth.scaled_derivatives(0, x, y, sample)) {
        texture.level_of_detail(*slopes, *slopes, {});
      }
      truth.conditioning(0, x, y, sample);
      if (f.depth) local_ulp_error(0.5F, f.depth->lo);
      return true;
    });
  }
  referee(c, 0, 1, 1, 0);
  to_clip_case(c, "");
  judge_transform(c, c.positions, 8);
}

TEST(FloatingPointState, OracleCallsLeaveTheControlBitsAlone) {
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    ASSERT_EQ(std::fesetround(mode), 0);
    const unsigned before = control_bits();
    use_everything();
    EXPECT_EQ(control_bits(), before);
    EXPECT_EQ(std::fegetround(), mode);
  }
  std::fesetround(FE_TONEAREST);
}

TEST(FloatingPointState, SubnormalsCountWhenTheProcessorFlushesThem) {
  // A triangle over all of the 4 × 4 framebuffer, with coordinates that are all subnormal.
  const float s = 0x1p-130F;
  const cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                                   {{{-s, -s, 0, s}, {3 * s, -s, 0, s}, {-s, 3 * s, 0, s}}},
                                   {{{0x1p-149F}, {0x1p-149F}, {0x1p-149F}}});
  // The left side lies in front of the near plane by a subnormal number.
  const cases::Case cut =
      small_case(cases::Rules::vulkan, 4, 4,
                 {{{-1, -1, -0x1p-140F, 1}, {3, -1, 0x1p-140F, 1}, {-1, 3, -0x1p-140F, 1}}});
  const unsigned before = floating_point_control();
  for (const unsigned flush : kFlushes)
    set_floating_point_control(floating_point_control() | flush);
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  const records::SampleVerdict decision = truth.judge(3, 3, 0);
  const Rational value = truth.attribute(0, 3, 3, 0)->lo;
  const auto nearest = std::bit_cast<std::uint32_t>(value.nearest_float());
  const bool referee_covers = referee(c, 0, 3, 3, 0).has_value();
  const SceneTruth cut_scene(cut, cases::contract_of(cut));
  const records::Verdict before_near = TriangleTruth(cut_scene, 0).judge(0, 1, 0).verdict;
  set_floating_point_control(before);
  EXPECT_EQ(before_near, records::Verdict::forbidden);
  EXPECT_EQ(decision.verdict, records::Verdict::required);
  EXPECT_EQ(value, Rational(0x1p-149));
  EXPECT_EQ(nearest, 1U);
  EXPECT_TRUE(referee_covers);
}

TEST(FloatingPointState, AnswersDoNotDependOnTheRoundingMode) {
  const cases::Case c = small_case(
      cases::Rules::vulkan, 4, 4,
      {{{-1, -1, 0, 1}, {1.25F, -1, 0.5F, 1.5F}, {-1, 1, 0.25F, 0.75F}}}, {{{0.5F}, {1}, {3}}});
  const auto answer = [&c] {
    const SceneTruth scene(c, cases::contract_of(c));
    const TriangleTruth truth(scene, 0);
    const records::Enclosure distance = *truth.distance(1, 0, 0);
    return std::tuple(truth.attribute(0, 1, 0, 0)->lo.to_string(), distance.lo, distance.hi);
  };
  const auto expected = answer();
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    EXPECT_EQ(answer(), expected);
  }
  std::fesetround(FE_TONEAREST);
}

}  // namespace
}  // namespace rastercheck::oracle::floating_point_state_test
