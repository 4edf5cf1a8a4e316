// The law catches a trace that does not match what was drawn.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::traced_is_drawn_test {
namespace {

using cases::SamplePlace;
using records::AttributeKind;
using records::FragmentClass;
using records::SampleTrace;
using records::TracedValue;
using testing::HasSubstr;

constexpr std::string_view kLaw = "the-traced-value-is-the-drawn-value";

/// True for the first fragment of triangle 0, which the law asks about.
bool is_first(const cases::SamplePlace& at) { return at == cases::SamplePlace{}; }

Check checked(const cases::Case& c, TraceDamage damage) {
  DamagedBackend backend({}, "cpu");
  backend.trace_damage = std::move(damage);
  return check_of(kLaw, c, backend);
}

/// The violation that the law finds if the trace of the square's first fragment is changed in this
/// way.
records::Violation only_of_first(const std::function<void(SampleTrace&)>& change) {
  const Check check =
      checked(square(), [&change](const cases::SamplePlace& at, std::optional<SampleTrace>& trace) {
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
  const records::Violation violation = only_of_first([](SampleTrace& trace) {
    float& depth = trace.depth.value;
    depth = std::nextafter(depth, 1.0F);
  });
  EXPECT_EQ(violation.kind, AttributeKind::depth);
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_THAT(violation.exact, HasSubstr("0.25"));
}

TEST(TracedIsDrawn, FindsAnotherAttributeAndTheOtherZero) {
  const records::Violation violation =
      only_of_first([](SampleTrace& trace) { trace.attributes[2].value = -0.0F; });
  EXPECT_EQ(violation.kind, AttributeKind::smooth);
  EXPECT_EQ(violation.attribute, 2U);
  EXPECT_EQ(only_of_first([](SampleTrace& trace) { trace.attributes.pop_back(); }).note,
            "the trace has another number of attributes than the case");
}

/// The law's note if the trace of the square's first fragment is changed in this way.
std::string note_of_first(const std::function<void(SampleTrace&)>& change) {
  return only_of_first(change).note;
}

TEST(TracedIsDrawn, FindsWeightsOfAnotherPlace) {
  EXPECT_THAT(note_of_first([](SampleTrace& trace) { (*trace.edges)[1] += 1; }),
              HasSubstr("weight 1 is "));
  EXPECT_THAT(note_of_first([](SampleTrace& trace) { trace.u += 1; }), HasSubstr("weight 0 is "));
  EXPECT_EQ(note_of_first([](SampleTrace& trace) { trace.edges.reset(); }),
            "the trace has lines but no weights");
  EXPECT_EQ(note_of_first([](SampleTrace& trace) { trace.lines.reset(); }),
            "the trace has weights but no lines");
}

TEST(TracedIsDrawn, FindsPlanesThatDoNotGiveTheValue) {
  EXPECT_THAT(note_of_first([](SampleTrace& trace) { *trace.depth.numerator_at += 1; }),
              HasSubstr("a plane is "));
  const auto smooth = [](SampleTrace& trace) -> TracedValue& { return trace.attributes[0]; };
  EXPECT_THAT(note_of_first([&](SampleTrace& trace) { smooth(trace).numerator->b += 1; }),
              HasSubstr("a plane is "));
  EXPECT_EQ(note_of_first([&](SampleTrace& trace) { smooth(trace).numerator_at.reset(); }),
            "a plane, its value or its frame is missing");
  EXPECT_THAT(note_of_first([&](SampleTrace& trace) { *smooth(trace).evaluated += 0.25; }),
              HasSubstr(" is rounded to "));
}

TEST(TracedIsDrawn, FindsWeightsOfAValueThatAreNotThoseOfTheLines) {
  const auto at = [](std::array<double, 3> weights) {
    return [weights](SampleTrace& trace) {
      TracedValue& value = trace.attributes[0];
      value.numerator.reset();
      value.numerator_at.reset();
      value.is_from_lines = true;
      value.weights = *trace.edges;
      for (std::size_t i = 0; i < 3; ++i) (*value.weights)[i] += weights[i];
    };
  };
  EXPECT_THAT(note_of_first(at({0, 0, 1})), HasSubstr("weight 2 is "));
  const Check good = checked(square(), [&](const cases::SamplePlace& address, auto& trace) {
    if (is_first(address)) at({0, 0, 0})(*trace);
  });
  EXPECT_EQ(good.violation_count, 0U);
}

TEST(TracedIsDrawn, FindsNoTraceOfWhatWasDrawn) {
  const Check check =
      checked(square(), [](const cases::SamplePlace& at, std::optional<SampleTrace>& trace) {
        if (is_first(at)) trace.reset();
      });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
}

TEST(TracedIsDrawn, FindsATraceOfWhatWasNotDrawn) {
  const Check check =
      checked(square(), [](const cases::SamplePlace& at, std::optional<SampleTrace>& trace) {
        if (trace && at.triangle == 0) trace->is_drawn = true;
      });
  ASSERT_GT(check.violation_count, 0U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::extra);
  EXPECT_EQ(check.violations.front().place.triangle, 0U);
}

TEST(TracedIsDrawn, FindsADrawnSampleWhoseTraceSaysThatItIsNot) {
  const records::Violation violation =
      only_of_first([](SampleTrace& trace) { trace.is_drawn = false; });
  EXPECT_EQ(violation.fragment_class, FragmentClass::missing);
}

TEST(TracedIsDrawn, FindsWeightsOfAnotherPlaceWhereNothingWasDrawn) {
  const Check check =
      checked(square(), [](const cases::SamplePlace&, std::optional<SampleTrace>& trace) {
        if (trace && !trace->is_drawn) (*trace->edges)[0] += 1;
      });
  EXPECT_GT(check.violation_count, 0U);
}

// Kills: a law that compares with the picture that the depth test left.
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

TEST(TracedIsDrawn, SaysNothingOfABackendThatDoesNotTrace) {
  class DrawsOnly : public DamagedBackend {
   public:
    backends::Tracer* tracer() override { return nullptr; }
  };
  DrawsOnly backend;
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  EXPECT_FALSE(check_of(kLaw, square(), backend).is_applicable);
}

TEST(TracedIsDrawn, HoldsOfMethods) {
  const Check check = check_of(kLaw, square(), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 8U);
}

}  // namespace
}  // namespace rastercheck::properties::traced_is_drawn_test
