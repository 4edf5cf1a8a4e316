// Checks every law under the contract of OpenGL and Vulkan (backends/api_promise.h): drawings that
// this contract permits keep all laws, and larger deviations are noticed.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include "backends/api_promise.h"
#include "backends/factory.h"
#include "cases/case_writer.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/findings.h"
#include "properties/law.h"

namespace rastercheck::properties::api_laws_test {
namespace {

/// A way to draw that the APIs permit.
struct Way {
  std::string name;
  cases::Coverage coverage;
  cases::Basis basis = cases::Basis::ideal;
  cases::TieRule tie_rule = cases::TieRule::top_left;
  std::string backend = "cpu";
  float shift = 0;  ///< shift of the viewport, in pixels
};

std::ostream& operator<<(std::ostream& out, const Way& way) { return out << way.name; }

/// Draws with `cpu` in the given way, and promises no more than the APIs do.
class Driver : public backends::Backend {
 public:
  explicit Driver(Way way)
      : way_(std::move(way)), cpu_(backends::make_backend(way_.backend).value()) {}

  backends::About about() const override { return {.has_limits = true}; }
  cases::Contract promise(const cases::Case& c) const override {
    return backends::api_promise(c, {way_.coverage ? way_.coverage->subpixel_bits : 8},
                                 cases::DriverPromise::spec);
  }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    if (c.rules == cases::Rules::d3d) {
      return tl::unexpected(Error{"driver", "", "no D3D", Failure::unsupported});
    }
    cases::Case mine = c;
    mine.coverage = way_.coverage;
    mine.basis = way_.basis;
    mine.fill_rule = way_.tie_rule;
    mine.viewport.x += way_.shift;
    return backends::fragments_of(cpu_->draw(mine));
  }

  Way way_;
  std::unique_ptr<backends::Backend> cpu_;
};

cases::Snapping grid(int bits) { return {bits, cases::Rounding::nearest_even, 0}; }

class ApiLawsTest : public testing::TestWithParam<Way> {};

TEST_P(ApiLawsTest, HoldOfWhatTheApisLeaveOpen) {
  constexpr std::uint64_t kCases = 40;
  Driver driver(GetParam());
  std::uint64_t checked = 0;
  for (const Law& law : laws()) {
    if (!is_promised(law, driver)) continue;
    for (std::uint64_t index = 0; index < kCases; ++index) {
      Draw draw = draw_of(law, 0, index);
      const Generated made = law.generate(draw);
      const Check check = check_or_note(law, made.source, driver, index);
      checked += check.is_applicable ? 1 : 0;
      ASSERT_FALSE(check.fault.has_value()) << *check.fault;
      EXPECT_EQ(check.violation_count, 0U)
          << law.id << ": " << verdict_of(check) << ", " << check.violations.front().note
          << "\ncase " << index << ", " << made.stratum << ":\n"
          << cases::to_json(made.source);
    }
  }
  EXPECT_GT(checked, 5 * kCases);
}

INSTANTIATE_TEST_SUITE_P(
    All, ApiLawsTest,
    testing::Values(Way{"exact", std::nullopt},
                    Way{"other_edges", std::nullopt, cases::Basis::ideal,
                        cases::TieRule::bottom_left},
                    Way{"float32", std::nullopt, cases::Basis::ideal, cases::TieRule::top_left,
                        "cpu:precision=float32"},
                    Way{"eight_bits", grid(8)},
                    Way{"eight_bits_throughout", grid(8), cases::Basis::snapped},
                    Way{"four_bits", grid(4), cases::Basis::snapped, cases::TieRule::bottom_left}),
    [](const testing::TestParamInfo<Way>& test) { return test.param.name; });

// Kills: laws about equal bits, applied to a backend that does not promise equal bits.
TEST(ApiLaws, ThatRestOnInvarianceAreNotAsked) {
  Driver driver(Way{"exact", std::nullopt});
  const auto cpu = backends::make_backend("cpu").value();
  for (const char* const name :
       {"a-power-of-two-changes-no-bit", "a-scaled-and-moved-attribute-is-scaled-and-moved",
        "culled-and-unculled-partition", "distinct-depths-are-drawn-in-any-order",
        "the-nearest-fragment-wins"}) {
    const Law* const law = find_law(name);
    ASSERT_NE(law, nullptr) << name;
    EXPECT_FALSE(is_promised(*law, driver)) << name;
    EXPECT_TRUE(is_promised(*law, *cpu)) << name;
  }
}

// Kills: a contract that permits everything.
TEST(ApiLaws, NoticeASixteenthOfAPixel) {
  Driver driver(
      Way{"shifted", grid(8), cases::Basis::snapped, cases::TieRule::top_left, "cpu", 1.0F / 16});
  const Law& law = *find_law(kCoverageLaw);
  std::uint64_t violated = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    Draw draw = draw_of(law, 0, index);
    violated += check_or_note(law, law.generate(draw).source, driver, index).violation_count > 0;
  }
  EXPECT_GT(violated, 2U);
}

}  // namespace
}  // namespace rastercheck::properties::api_laws_test
