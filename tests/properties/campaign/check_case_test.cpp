#include "properties/campaign/check_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "backends/factory.h"
#include "properties/choices.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::check_case_test {
namespace {

using records::Counterexample;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

Findings check_square(backends::Backend& backend, cases::Case c = square()) {
  c.name = "square";
  Findings findings;
  check_case(*find_law(kCoverage), "damaged", backend, 7, {std::move(c), "here", 4}, findings);
  return findings;
}

TEST(CheckCase, CountsAndSaysWhereItIsFrom) {
  DamagedBackend backend([](const cases::Case&, cases::Fragments& d) { drop(d, 0, 1, 1); });
  const Findings findings = check_square(backend);
  const auto record =
      findings.records.find({kCoverage, "damaged", records::AttributeKind::coverage, "here"});
  ASSERT_NE(record, findings.records.end());
  EXPECT_EQ(record->second.cases, (records::CaseCounts{1, 0, 1}));
  EXPECT_GE(record->second.counts.required, 56U);  // the diagonal may be open
  EXPECT_EQ(record->second.labels.at("drawn"), 1U);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].source.found,
            (cases::Found{kCoverage, "damaged", "missing", 7, 4, "coverage", "ordinary"}));
}

records::CaseRecord case_record_of(backends::Backend& backend, const cases::Case& c = square()) {
  Findings findings;
  findings.cases.emplace();
  check_case(*find_law(kCoverage), "damaged", backend, 7, {c, "here", 4}, findings);
  EXPECT_THAT(*findings.cases, SizeIs(1));
  return findings.cases->at({kCoverage, "damaged", records::Origin::random, 4});
}

TEST(CheckCase, KeepsWhatTheCaseGaveWhereThatIsKept) {
  DamagedBackend right([](const cases::Case&, cases::Fragments&) {});
  EXPECT_EQ(check_square(right).cases, std::nullopt);
  const records::CaseRecord held = case_record_of(right);
  EXPECT_EQ(held.outcome, records::CaseOutcome::held);
  EXPECT_EQ(held.stratum, "here");
  EXPECT_EQ(held.mismatches, 0U);
  EXPECT_EQ(held, case_record_of(right));

  DamagedBackend wrong([](const cases::Case&, cases::Fragments& d) { drop(d, 0, 1, 1); });
  const records::CaseRecord violated = case_record_of(wrong);
  EXPECT_EQ(violated.outcome, records::CaseOutcome::violated);
  EXPECT_EQ(violated.mismatches, 1U);
  EXPECT_EQ(violated.source_digest, held.source_digest);
  EXPECT_NE(violated.found_digest, held.found_digest);
}

// Kills: a digest of how much is wrong that ignores where.
TEST(CheckCase, DigestsTellOneBitAndOnePlaceFromAnother) {
  DamagedBackend here([](const cases::Case&, cases::Fragments& d) { drop(d, 0, 1, 1); });
  DamagedBackend right([](const cases::Case&, cases::Fragments&) {});
  cases::Case other = square();
  other.attribute_values[0] = 0x1p-149F;
  EXPECT_NE(case_record_of(right, other).source_digest, case_record_of(right).source_digest);

  const auto of_values = [](int x, float change) {
    DamagedBackend backend([x, change](const cases::Case&, cases::Fragments& drawn) {
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        if (drawn.x[i] == x && drawn.y[i] == 1) drawn.attributes[i * 3] += change;
      }
    });
    Findings findings;
    findings.cases.emplace();
    check_case(*find_law(kValuesLaw), "damaged", backend, 7, {square(), "here", 4}, findings);
    return findings.cases->begin()->second;
  };
  EXPECT_NE(of_values(1, 1).found_digest, of_values(2, 1).found_digest);
  EXPECT_NE(of_values(1, 0x1p-22F).found_digest, of_values(1, 0).found_digest);
}

// Kills: the first triangle kept instead of the guilty one; values left at their old vertices.
TEST(CheckCase, KeepsTheOneTriangleThatSuffices) {
  cases::Case c = square();
  c.clip_distance_count = 1;
  c.clip_distances = {10, 11, 12, 13};
  DamagedBackend backend(&lose_last_corner);
  const Findings findings = check_square(backend, c);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  const Counterexample& found = findings.counterexamples[0];
  EXPECT_THAT(found.source.triangles, ElementsAre(cases::Triangle{0, 1, 2}));
  EXPECT_THAT(found.source.positions, ElementsAre(c.positions[2], c.positions[1], c.positions[3]));
  EXPECT_THAT(found.source.attribute_values, ElementsAre(0, 1, 0, 8, 1, 0, 8, 1, 0));
  EXPECT_THAT(found.source.clip_distances, ElementsAre(12, 11, 13));
  ASSERT_THAT(found.violations, SizeIs(1));
  EXPECT_EQ(found.violations[0].place.triangle, 0U);
  EXPECT_EQ(found.violations[0].place.x, 7U);
}

// Kills: a counterexample that does not fail when it is replayed.
TEST(CheckCase, KeepsTheWholeCaseWhereNoTriangleSuffices) {
  DamagedBackend backend([](const cases::Case& c, cases::Fragments& drawn) {
    if (c.triangles.size() > 1) lose_last_corner(c, drawn);
  });
  const Findings findings = check_square(backend);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_THAT(findings.counterexamples[0].source.triangles, SizeIs(2));
  EXPECT_EQ(findings.counterexamples[0].violations[0].place.triangle, 1U);
}

/// Violated at triangle 1, or at the only triangle of a case, for one choice in 64.
Result<Check> check_by_choice(const cases::ClipCase& c, backends::Backend& /*backend*/,
                              std::uint64_t /*index*/) {
  Check check;
  if (choices_of(c) % 64 != choices_of(square()) % 64) return check;
  check.violation_count = 1;
  check.violations.resize(1);
  check.violations[0].fragment_class = records::FragmentClass::missing;
  check.violations[0].place.triangle = c.triangles.size() > 1 ? 1 : 0;
  return check;
}

// Kills: a triangle kept alone, for which the law makes a different choice.
TEST(CheckCase, WhatIsKeptIsCheckedAsItWas) {
  Law law;
  law.id = "chooses";
  law.check = &check_by_choice;
  DamagedBackend backend([](const cases::Case&, cases::Fragments&) {});
  Findings findings;
  check_case(law, "damaged", backend, 7, {square(), "here", 4}, findings);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  const cases::Case& kept = findings.counterexamples[0].source;
  EXPECT_THAT(kept.triangles, SizeIs(1));
  EXPECT_EQ(kept.choices, choices_of(square()));
}

// Kills: a wrong depth that hides wrong attributes; one condition that hides another.
TEST(CheckCase, KeepsOneOfEachKindAndCondition) {
  DamagedBackend backend([](const cases::Case& c, cases::Fragments& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      drawn.depth[i] += 0.25F;
      drawn.attributes[i * drawn.attribute_count] += 100;
      if (c.framebuffer.samples > 1) drawn.attributes[i * drawn.attribute_count] += 100;
    }
  });
  Findings findings;
  const Law& law = *find_law("values-stay-within-the-bound");
  cases::Case c = square();
  check_case(law, "damaged", backend, 1, {c, "here", 0}, findings);
  c.framebuffer.samples = 4;
  check_case(law, "damaged", backend, 1, {c, "here", 1}, findings);
  std::vector<std::string> found;
  for (const Counterexample& one : findings.counterexamples) {
    found.push_back(one.source.found->kind + ", " + one.source.found->condition);
    EXPECT_EQ(to_string(one.violations.front().kind), one.source.found->kind);
  }
  EXPECT_THAT(found, ElementsAre("depth, ordinary", "depth, several samples", "smooth, ordinary",
                                 "smooth, several samples"));
}

TEST(CheckCase, KeepsTheLowestIndex) {
  DamagedBackend backend(&lose_last_corner);
  Findings findings;
  for (std::uint64_t left = 8; left > 0; --left) {
    check_case(*find_law(kCoverage), "damaged", backend, 1, {square(), "here", left - 1}, findings);
  }
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].source.found->index, 0U);
  EXPECT_EQ(findings.records.begin()->second.cases.violations, 8U);
}

TEST(CheckCase, HoldsADrawingThatFailsAgainstTheBackend) {
  const auto backend = backends::make_backend("damaged:refuses").value();
  const Findings findings = check_square(*backend);
  EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{1, 0, 1}));
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  ASSERT_THAT(findings.counterexamples[0].violations, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].violations[0].note, "out of memory");
  EXPECT_EQ(findings.counterexamples[0].source.found->verdict, "failed");
}

/// Fails every drawing in one way, and is lost after this many drawings.
class FailingBackend : public backends::Backend {
 public:
  FailingBackend(Failure failure, int drawings) : failure_(failure), left_(drawings) {}
  cases::Contract promise(const cases::Case& c) const override { return cases::contract_of(c); }
  std::optional<Error> is_lost() const override {
    return left_ > 0 ? std::nullopt : std::optional(failure());
  }
  int left() const { return left_; }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& /*c*/) override {
    --left_;
    return tl::unexpected(failure());
  }
  Error failure() const { return {"", "", "no", failure_}; }

  Failure failure_;
  int left_;
};

TEST(CheckCase, TellsFailuresApart) {
  for (const auto& [failure, verdict] :
       {std::pair(Failure::refused, "failed"), std::pair(Failure::unavailable, "failed"),
        std::pair(Failure::crash, "crash"), std::pair(Failure::hang, "hang")}) {
    FailingBackend backend(failure, 100);
    const Findings findings = check_square(backend);
    EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{1, 0, 1})) << verdict;
    ASSERT_THAT(findings.counterexamples, SizeIs(1)) << verdict;
    EXPECT_EQ(findings.counterexamples[0].source.found->verdict, verdict);
  }
}

// Kills: minutes of time-outs for a case that hangs only because it is large.
TEST(ShrinkCounterexample, LeavesALargeCaseThatHangsAsItWasFound) {
  FailingBackend backend(Failure::hang, 100);
  records::Counterexample large;
  large.source = square();
  large.source.found = cases::Found{std::string(kCoverageLaw), "failing", "hang", 1, 2};
  large.violation_count = 1;
  large.violations.emplace_back().fragment_class = records::FragmentClass::hang;
  Findings findings;
  shrink_counterexample(*find_law(kCoverageLaw), backend, large, {1000, {}}, findings);
  EXPECT_EQ(backend.left(), 100);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].source, large.source);
  EXPECT_FALSE(findings.counterexamples[0].is_shrunk());

  large.source = with_triangles(large.source, std::vector<std::size_t>{0});
  shrink_counterexample(*find_law(kCoverageLaw), backend, large, {2, {}}, findings);
  EXPECT_LT(backend.left(), 100);
}

TEST(CheckCase, SaysNothingOfWhatABackendDoesNotSupport) {
  FailingBackend backend(Failure::unsupported, 100);
  const Findings findings = check_square(backend);
  EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{0, 1, 0}));
  EXPECT_THAT(findings.counterexamples, IsEmpty());
}

// Kills: drawing with a lost backend again and again, which uses up a campaign's time; cases that
// count as held although they were not drawn.
TEST(CheckCase, DoesNotAskABackendThatIsLost) {
  FailingBackend backend(Failure::hang, 0);
  const Findings findings = check_square(backend);
  EXPECT_EQ(backend.left(), 0);
  EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{1, 0, 1}));
  EXPECT_THAT(findings.counterexamples, IsEmpty());
}

// Kills: a set of cases that depends on when a backend was lost.
TEST(CheckCase, KeepsCasesThatNobodyDrawsAnyMore) {
  FailingBackend backend(Failure::hang, 0);
  DamagedBackend right([](const cases::Case&, cases::Fragments&) {});
  const records::CaseRecord record = case_record_of(backend);
  EXPECT_EQ(record.outcome, records::CaseOutcome::violated);
  EXPECT_EQ(record.source_digest, case_record_of(right).source_digest);
}

// Kills: blaming a backend for a case that it never received.
TEST(CheckCase, SaysNothingOfPositionsBeyondFloat32) {
  cases::Case c = square();
  c.camera.emplace();
  c.camera->model[0] = 0x1p127F;
  c.camera->view[0] = 4;
  const auto backend = backends::make_backend("cpu").value();
  const Findings findings = check_square(*backend, c);
  EXPECT_EQ(findings.records.begin()->second.cases, (records::CaseCounts{0, 1, 0}));
  EXPECT_THAT(findings.counterexamples, IsEmpty());
}

}  // namespace
}  // namespace rastercheck::properties::check_case_test
