// The law catches splits that are not of the error that was made.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::SampleAddress;
using records::SampleTrace;
using records::Stage;
using records::Stratum;

constexpr std::string_view kLaw = "the parts of an error add up to the whole";

/// What the law finds where the traces of the square are changed so.
Check with_traces(const std::function<void(SampleTrace&)>& change) {
  DamagedBackend backend({}, "cpu");
  backend.trace_damage = [&change](const SampleAddress&, std::optional<SampleTrace>& trace) {
    if (trace) change(*trace);
  };
  return check_of(kLaw, square(), backend);
}

TEST(PartsAddUp, HoldsOfCpuAndSumsItsParts) {
  const Check check = with_traces([](SampleTrace&) {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 8U);
  // x = u and the constants are exact, so that no stage has a part of them; the constant 1 is
  // copied, from nothing that is set up.
  const auto& stages = check.judgement.errors.at(AttributeKind::smooth).stages;
  ASSERT_EQ(stages.size(), 1U);
  const std::map<Stage, records::SignedSum>& ordinary = stages.at(Stratum::ordinary);
  const records::SignedSum all(0, 0, 24, 0);
  const records::SignedSum computed(0, 0, 16, 0);
  EXPECT_EQ(ordinary, (std::map<Stage, records::SignedSum>{{Stage::transform, all},
                                                           {Stage::set_up, computed},
                                                           {Stage::coverage, all},
                                                           {Stage::weights, computed},
                                                           {Stage::evaluation, all},
                                                           {Stage::rounding, all}}));
}

TEST(PartsAddUp, SumsMagnitudesByStage) {
  // An ulp of the scale, 8, is 2^-20: a quarter of one is too much before the rounding and too
  // little in it.
  const Check check =
      with_traces([](SampleTrace& trace) { *trace.attributes[0].evaluated += 0x1p-22; });
  EXPECT_EQ(check.violation_count, 0U);
  const auto& ordinary =
      check.judgement.errors.at(AttributeKind::smooth).stages.at(Stratum::ordinary);
  const records::SignedSum::Units quarter = records::SignedSum::Units{1} << 30;
  EXPECT_EQ(ordinary.at(Stage::evaluation), records::SignedSum(8 * quarter, 8 * quarter, 24, 0));
  EXPECT_EQ(ordinary.at(Stage::rounding), records::SignedSum(8 * quarter, 8 * quarter, 24, 0));
  EXPECT_THAT(check.labels, testing::IsSupersetOf({"evaluation", "rounding"}));
}

TEST(PartsAddUp, FindsATraceOfAnotherValue) {
  const Check check = with_traces([](SampleTrace& trace) { trace.attributes[1].value += 1; });
  EXPECT_EQ(check.violation_count, 8U);
  EXPECT_EQ(check.violations.front().attribute, 1U);
  EXPECT_EQ(check.violations.front().exact, "a trace of the drawn value");
}

TEST(PartsAddUp, FindsPositionsThatWereNotHandedOn) {
  const Check check = with_traces([](SampleTrace& trace) { trace.positions[1][0] = 2; });
  EXPECT_EQ(check.violation_count, 8U);
  EXPECT_EQ(check.violations.front().exact, "a trace of the clip positions that were handed on");
}

TEST(PartsAddUp, PartsWhatIsOpenFromTheExcessWithoutATrace) {
  class Silent : public DamagedBackend {
   public:
    bool traces() const override { return false; }
  };
  Silent backend;
  const Check check = check_of(kLaw, square(), backend);
  EXPECT_EQ(check.violation_count, 0U);
  std::set<Stage> stages;
  for (const auto& [stage, sum] :
       check.judgement.errors.at(AttributeKind::smooth).stages.at(Stratum::ordinary)) {
    stages.insert(stage);
  }
  EXPECT_EQ(stages, (std::set{Stage::transform, Stage::left_open, Stage::excess}));
}

TEST(PartsAddUp, LeavesOutWhatIsNoNumber) {
  const Check check = check_of(kLaw, square(), [](const cases::Case&, cases::Framebuffer& drawn) {
    for (float& value : drawn.attributes) value = std::numeric_limits<float>::quiet_NaN();
  });
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_FALSE(check.judgement.errors.contains(AttributeKind::smooth));
  EXPECT_TRUE(check.judgement.errors.contains(AttributeKind::depth));
}

TEST(PartsAddUp, PassesOnATraceThatFails) {
  class Fails : public DamagedBackend {
   public:
    Fails() : DamagedBackend({}, "cpu") {}
    Result<std::optional<SampleTrace>> trace(const cases::Case&, const SampleAddress&) override {
      return tl::unexpected(Error{"", "", "no traces today"});
    }
  };
  Fails backend;
  const auto check = find_law(kLaw)->check(square(), backend, {});
  ASSERT_FALSE(check.has_value());
  EXPECT_EQ(check.error().reason, "no traces today");
}

}  // namespace
}  // namespace rastercheck::properties
