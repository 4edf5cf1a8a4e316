// The law catches a trace that is not of what was drawn.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::SampleAddress;
using records::SampleTrace;
using testing::HasSubstr;

constexpr std::string_view kLaw = "the traced value is the drawn value";

/// The first fragment of triangle 0, which the law asks about.
bool is_first(const SampleAddress& at) { return at == SampleAddress{}; }

Check checked(const cases::Case& c, TraceDamage damage) {
  DamagedBackend backend({}, "cpu");
  backend.trace_damage = std::move(damage);
  return check_of(kLaw, c, backend);
}

/// What the law finds where the trace of the square's first fragment is changed so.
records::Violation only_of_first(const std::function<void(SampleTrace&)>& change) {
  const Check check =
      checked(square(), [&change](const SampleAddress& at, std::optional<SampleTrace>& trace) {
        if (is_first(at)) change(*trace);
      });
  EXPECT_EQ(check.violation_count, 1U);
  return check.violations.empty() ? records::Violation{} : check.violations.front();
}

TEST(TracedIsDrawn, HoldsOfCpu) {
  const Check check = checked(square(), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 8U);
  EXPECT_GT(check.judgement.counts.forbidden, 4U);
  EXPECT_THAT(check.labels, testing::IsSupersetOf({"decided in_double", "not drawn"}));
}

TEST(TracedIsDrawn, FindsAnotherDepth) {
  const records::Violation violation =
      only_of_first([](SampleTrace& trace) { trace.depth = std::nextafter(trace.depth, 1.0F); });
  EXPECT_EQ(violation.kind, AttributeKind::depth);
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_THAT(violation.exact, HasSubstr("0.25"));
}

TEST(TracedIsDrawn, FindsAnotherAttributeAndTheOtherZero) {
  const records::Violation violation =
      only_of_first([](SampleTrace& trace) { trace.attributes[2] = -0.0F; });
  EXPECT_EQ(violation.kind, AttributeKind::smooth);
  EXPECT_EQ(violation.attribute, 2U);
  EXPECT_EQ(only_of_first([](SampleTrace& trace) { trace.attributes.pop_back(); }).note,
            "the trace has another number of attributes");
}

TEST(TracedIsDrawn, FindsWeightsOfAnotherPlace) {
  const auto stage = [](SampleTrace& trace, std::string_view name) -> records::StageTrace& {
    return const_cast<records::StageTrace&>(*records::find_stage(trace, name));
  };
  EXPECT_THAT(only_of_first([&](SampleTrace& trace) {
                stage(trace, "weights").handed_on[1].value += 1;
              }).note,
              HasSubstr("weight 1 is "));
  EXPECT_EQ(
      only_of_first([&](SampleTrace& trace) { stage(trace, "weights").received.clear(); }).note,
      "a number of edge 0 lacks");
  EXPECT_EQ(only_of_first([&](SampleTrace& trace) { stage(trace, "edges").stage = "lines"; }).note,
            "the trace has no edges or no weights");
}

TEST(TracedIsDrawn, FindsNoTraceOfWhatWasDrawn) {
  const Check check =
      checked(square(), [](const SampleAddress& at, std::optional<SampleTrace>& trace) {
        if (is_first(at)) trace.reset();
      });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
}

TEST(TracedIsDrawn, FindsATraceOfWhatWasNotDrawn) {
  const Check check =
      checked(square(), [](const SampleAddress& at, std::optional<SampleTrace>& trace) {
        if (!trace && at.triangle == 0) trace.emplace();
      });
  ASSERT_GT(check.violation_count, 0U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::extra);
  EXPECT_EQ(check.violations.front().triangle, 0U);
}

// Kills: a law that compares with what a depth test left.
TEST(TracedIsDrawn, LeavesTheDepthTestOut) {
  cases::Case c = square();
  c.depth_test = cases::DepthTest::less;
  c.triangles = {{0, 1, 2}, {0, 1, 2}};
  const Check check = checked(c, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 8U);
}

TEST(TracedIsDrawn, PassesOnATraceThatFails) {
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

TEST(TracedIsDrawn, SaysNothingOfABackendThatDoesNotTrace) {
  EXPECT_FALSE(check_of(kLaw, square(), {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties
