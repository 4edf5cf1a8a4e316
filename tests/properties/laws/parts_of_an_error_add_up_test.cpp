// The law catches splits that do not add up to the error that was made.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>

#include "cases/case_reader.h"
#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::parts_of_an_error_add_up_test {
namespace {

using cases::SamplePlace;
using records::AttributeKind;
using records::SampleTrace;
using records::Stage;
using records::Stratum;

constexpr std::string_view kLaw = "the-parts-of-an-error-add-up-to-the-whole";

/// Checks the square with traces that `change` has changed.
Check with_traces(const std::function<void(SampleTrace&)>& change) {
  DamagedBackend backend({}, "cpu");
  backend.trace_damage = [&change](const cases::SamplePlace&, std::optional<SampleTrace>& trace) {
    if (trace) change(*trace);
  };
  return check_of(kLaw, square(), backend);
}

TEST(PartsAddUp, HoldsOfCpuAndSumsItsParts) {
  const Check check = with_traces([](SampleTrace&) {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 8U);
  // x = u and the constants are exact, so that no stage has a part of their errors; the constant 1
  // is copied and needs no set-up.
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
  // An ulp of the scale, 8, is 2^-20. A quarter ulp too much before rounding is compensated by a
  // quarter ulp too little in rounding.
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
  EXPECT_EQ(check.violations.front().exact, "a trace of the clip positions that were passed on");
}

TEST(PartsAddUp, PartsWhatIsOpenFromTheExcessWithoutATrace) {
  class Silent : public DamagedBackend {
   public:
    backends::Tracer* tracer() override { return nullptr; }
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
  const Check check = check_of(kLaw, square(), [](const cases::Case&, cases::Fragments& drawn) {
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
    Result<std::optional<SampleTrace>> trace(const cases::Case&,
                                             const cases::SamplePlace&) override {
      return tl::unexpected(Error{"", "", "no traces today"});
    }
  };
  Fails backend;
  const auto check = check_law(*find_law(kLaw), square(), backend, 0);
  ASSERT_FALSE(check.has_value());
  EXPECT_EQ(check.error().reason, "no traces today");
}

// Snapping makes the triangle cover a sample where the unsnapped positions have 1/w <= 0, and so no
// value. The split that any backend gives there has no part `transform`, which is not a fault.
TEST(PartsAddUp, HoldsBeyondTheHorizonOfASnappedTriangle) {
  const Result<cases::Case> source = cases::parse_case(
      R"({"format": "rastercheck-case", "version": 1, "name": "snapped beyond the horizon",
"framebuffer": {"width": 6, "height": 1, "samples": 1},
"viewport": {"x": "-0x1.8ee688p+4", "y": "-0x1.082bfcp+3", "width": "0x1.463b52p+5",
"height": "0x1.ec2d12p+4", "min_depth": "0x0p+0", "max_depth": "0x1p+0"},
"rules": "vulkan", "coverage": {"subpixel_bits": 4, "rounding": "nearest_even"},
"cull": "none", "front_face": "ccw", "attributes": [{"name": "a0",
"interpolation": "smooth", "location": "sample"}], "camera": {"model": ["0x1p+0",
"0x0p+0", "0x0p+0", "-0x1.ap-1", "0x0p+0", "0x1p+0", "0x0p+0", "0x1.2p+0", "0x0p+0",
"0x0p+0", "0x1p+0", "0x1.e8p+2", "0x0p+0", "0x0p+0", "0x0p+0", "0x1p+0"],
"view": ["0x1.ep-4", "0x1.e8p-1", "0x1.3p-2", "0x0p+0", "-0x1.606p-4", "0x1.3f5p-2",
"-0x1.e47ap-1", "0x0p+0", "-0x1.fa8p-1", "0x1.605816p-4", "0x1.e4791ep-4", "0x0p+0",
"0x0p+0", "0x0p+0", "0x0p+0", "0x1p+0"], "projection": ["0x1.08p-1", "0x0p+0",
"0x0p+0", "0x0p+0", "0x0p+0", "0x1.6096p-1", "0x0p+0", "0x0p+0", "0x0p+0", "0x0p+0",
"-0x1p+1", "-0x1p+1", "0x0p+0", "0x0p+0", "-0x1p+0", "0x0p+0"]},
"vertices": [{"position": ["0x1.0cp+2", "0x1.4p+0", "-0x1.5cp+2", "0x1p+0"],
"attributes": ["0x0p+0"]}, {"position": ["0x1.6p+1", "0x1.9p+0", "-0x1.9cp+2",
"0x1p+0"], "attributes": ["0x0p+0"]}, {"position": ["-0x1.f8p+2", "-0x1.11fffep+3",
"-0x1.a6p+3", "0x1p+0"], "attributes": ["0x1p+0"]}], "triangles": [[0, 1, 2]]})",
      "case");
  ASSERT_TRUE(source.has_value()) << to_string(source.error());
  DamagedBackend backend({}, "cpu");
  const Check check = check_of(kLaw, *source, backend);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::parts_of_an_error_add_up_test
