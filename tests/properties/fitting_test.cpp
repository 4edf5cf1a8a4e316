#include "properties/fitting.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "cases/capabilities.h"
#include "cases/contract_terms.h"
#include "properties/law.h"

namespace rastercheck::properties::fitting_test {
namespace {

using cases::Capabilities;
using cases::Feature;

/// The capabilities of an OpenGL-only rasterizer with one sample and a fixed viewport.
Capabilities of_plain_opengl() {
  Capabilities has;
  has.rules = {cases::Rules::opengl};
  has.sample_counts = {1};
  has.lacks = {Feature::clip_distances, Feature::depth_clamp, Feature::depth_range,
               Feature::viewport,       Feature::scissor,     Feature::culling};
  return has;
}

Capabilities of_a_driver() {
  Capabilities has;
  has.rules = {cases::Rules::opengl, cases::Rules::vulkan};
  has.sample_counts = {1, 4};
  has.max_viewport = 8192;
  has.max_size = 8192;
  has.numbers = {0x1p-30F, 0x1p24F};
  return has;
}

/// Capabilities that are as small as possible.
Capabilities of_little() {
  Capabilities has = of_plain_opengl();
  has.rules = {cases::Rules::d3d};
  has.lacks = {Feature::nonpositive_w, Feature::depth_clipping,
               Feature::side_clipping, Feature::clip_distances,
               Feature::depth_clamp,   Feature::depth_range,
               Feature::depth_test,    Feature::depth_clear,
               Feature::depth_bias,    Feature::unorm_depth,
               Feature::viewport,      Feature::viewport_fractions,
               Feature::scissor,       Feature::culling,
               Feature::noperspective, Feature::flat};
  has.max_size = 32;
  has.max_attributes = 1;
  has.numbers = {0x1p-16F, 0x1p16F};
  return has;
}

// Kills: a law or generator whose cases the judged backend cannot draw.
TEST(RandomCases, AskForNothingThatIsLacking) {
  for (const Capabilities& has : {of_plain_opengl(), of_a_driver(), of_little()}) {
    for (const Law& law : laws()) {
      for (std::uint64_t index = 0; index < 60; ++index) {
        const cases::Case c = random_case(law, 3, index, has).source;
        // Backends that draw only triangles are not asked to draw others (Law::is_promised).
        if (c.primitive != cases::Primitive::triangles) continue;
        ASSERT_EQ(lacked_by(has, c), "") << law.id << ", case " << index;
      }
    }
  }
}

TEST(RandomCases, UseOnlyNumbersThatTheBackendPromises) {
  const Capabilities has = of_a_driver();
  for (const Law& law : laws()) {
    for (std::uint64_t index = 0; index < 60; ++index) {
      const cases::Case c = random_case(law, 3, index, has).source;
      for (const float value : c.attribute_values) ASSERT_TRUE(has.numbers.has(value)) << law.id;
      const cases::DepthBias& bias = c.depth_bias;
      ASSERT_TRUE(has.numbers.has(bias.constant) && has.numbers.has(bias.slope) &&
                  has.numbers.has(bias.clamp))
          << law.id;
      if (c.camera) continue;
      for (const cases::ClipVertex& p : c.positions) {
        ASSERT_TRUE(has.numbers.has(p.x) && has.numbers.has(p.y) && has.numbers.has(p.z) &&
                    has.numbers.has(p.w))
            << law.id << ", case " << index;
      }
    }
  }
}

// The digests of these cases are approved (generators/digests_test.cpp).
TEST(RandomCases, AreUnchangedForBackendsWithoutLimits) {
  for (const Law& law : laws()) {
    for (std::uint64_t index = 0; index < 20; ++index) {
      Draw draw = draw_of(law, 3, index);
      ASSERT_EQ(random_case(law, 3, index, {}).source, law.generate(draw).source) << law.id;
    }
  }
}

// Kills: a contract file with which the plan or the cases cannot be read back.
TEST(RandomCases, AreNotMadeForNumbersThatNoCaseHas) {
  const auto backend = backends::make_backend("cpu").value();
  cases::ContractTerms terms;
  terms.numbers = cases::MagnitudeRange{2, 4};
  backend->hold_to(terms);
  EXPECT_TRUE(capabilities_of(*backend).is_everything());
  terms.numbers = cases::MagnitudeRange{0.5F, 4};
  backend->hold_to(terms);
  EXPECT_EQ(capabilities_of(*backend).numbers, *terms.numbers);
}

TEST(FittedCases, StoreAndBiasDepthsOnlyWhereTheBackendDoes) {
  cases::Case biased;
  biased.depth_bias = {1, 2, 0.5F};
  biased.depth_format = cases::DepthFormat::unorm16;
  cases::Case c = biased;
  EXPECT_TRUE(leave_out(c, Feature::depth_bias, {}));
  EXPECT_EQ(c.depth_bias, cases::DepthBias());
  EXPECT_EQ(c.depth_format, cases::DepthFormat::unorm16);
  EXPECT_FALSE(needs(c, Feature::depth_bias));
  c = biased;
  EXPECT_TRUE(leave_out(c, Feature::unorm_depth, {}));
  EXPECT_EQ(c.depth_bias, biased.depth_bias);
  EXPECT_EQ(c.depth_format, cases::DepthFormat::float32);
  EXPECT_FALSE(needs(c, Feature::unorm_depth));
}

/// The number of 2,000 generated cases for which `has` is true.
template <typename Has>
int count_states(const Capabilities& capabilities, const Has& has) {
  int count = 0;
  for (std::uint64_t index = 0; index < 2000; ++index) {
    Draw draw(1, "states", index, capabilities);
    const Generated made = generate_any(draw);
    count += has(made.source) ? 1 : 0;
  }
  return count;
}

// Kills: fitting that always replaces a feature in the same way. A supported feature keeps its
// frequency: of 2,000 states, 1/6 have culling, 6/16 have several samples, and 3/16 have 4 samples.
TEST(RandomCases, KeepTheFrequencyOfWhatIsThere) {
  const auto is_culled = [](const cases::Case& c) { return c.cull != cases::Cull::none; };
  const auto has_four = [](const cases::Case& c) { return c.framebuffer.samples == 4; };
  const Capabilities driver = of_a_driver();
  EXPECT_NEAR(count_states(driver, is_culled), count_states({}, is_culled), 80);
  EXPECT_GT(count_states(driver, has_four), count_states({}, has_four));
  const auto has_fraction = [](const cases::Case& c) {
    return needs(c, Feature::viewport_fractions);
  };
  EXPECT_NEAR(count_states(driver, has_fraction), count_states({}, has_fraction), 120);
}

}  // namespace
}  // namespace rastercheck::properties::fitting_test
