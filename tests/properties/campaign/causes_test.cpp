#include "properties/campaign/causes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "records/counterexample.h"

namespace rastercheck::properties::causes_test {
namespace {

using records::Counterexample;
using records::DrawnPart;
using records::FragmentClass;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr DrawnPart kCoverage = DrawnPart::coverage;
constexpr DrawnPart kValues = DrawnPart::values;

/// A counterexample of a law, with the explanation that was found for it.
Counterexample one(const std::string& law, FragmentClass verdict,
                   std::optional<records::Explanation> explanation = std::nullopt) {
  Counterexample found;
  found.source.found = {law, "cpu", std::string(to_string(verdict)), 1, 0};
  records::Violation violation;
  violation.fragment_class = verdict;
  found.violations = {violation};
  found.explanation = std::move(explanation);
  return found;
}

records::Explanation explained(const std::vector<DrawnPart>& parts,
                               const std::vector<std::string>& needs,
                               const std::vector<std::string>& indifferent = {}) {
  return {parts, {}, {}, needs, {}, indifferent};
}

std::vector<std::vector<std::uint64_t>> places_of(const std::vector<Counterexample>& all) {
  std::vector<std::vector<std::uint64_t>> places;
  for (const records::Cause& cause : causes_of(all)) places.push_back(cause.counterexamples);
  return places;
}

TEST(CausesOf, NothingIsNoCause) { EXPECT_THAT(causes_of({}), IsEmpty()); }

// Kills: a separate cause for each law.
TEST(CausesOf, FaultsInTheSamePartShareOneCause) {
  const std::vector<records::Cause> causes =
      causes_of({one("a", FragmentClass::missing, explained({kCoverage}, {})),
                 one("b", FragmentClass::extra, explained({kCoverage}, {})),
                 one("c", FragmentClass::beyond_bound, explained({kCoverage}, {}))});
  ASSERT_EQ(causes.size(), 1U);
  EXPECT_THAT(causes[0].counterexamples, UnorderedElementsAre(0, 1, 2));
  EXPECT_EQ(causes[0].backend, "cpu");
  EXPECT_EQ(causes[0].sentence, "samples are missing and extra samples are drawn");
}

TEST(CausesOf, OtherPartsAreOtherCausesTheLargestFirst) {
  const std::vector<records::Cause> causes =
      causes_of({one("a", FragmentClass::missing, explained({kCoverage}, {})),
                 one("b", FragmentClass::not_a_number, explained({kValues}, {})),
                 one("c", FragmentClass::not_a_number, explained({kValues}, {}))});
  ASSERT_EQ(causes.size(), 2U);
  EXPECT_EQ(causes[0].sentence, "values are NaN");
  EXPECT_EQ(causes[1].sentence, "samples are missing");
}

// Kills: a sentence about NaN above a counterexample whose value is a number.
TEST(CausesOf, ACauseWithNaNBeginsWithIt) {
  const std::vector<records::Cause> causes =
      causes_of({one("a", FragmentClass::beyond_bound, explained({kValues}, {})),
                 one("b", FragmentClass::infinite, explained({kValues}, {})),
                 one("c", FragmentClass::not_a_number, explained({kValues}, {}))});
  ASSERT_EQ(causes.size(), 1U);
  EXPECT_EQ(causes[0].sentence, "values are wrong, sometimes NaN");
  EXPECT_EQ(causes[0].counterexamples.front(), 2U);
}

// Kills: an infinite value, which any error makes of the largest float, put before a simpler case.
TEST(CausesOf, ACauseWithInfiniteValuesSaysSoAndNeedNotBeginWithThem) {
  const std::vector<records::Cause> causes =
      causes_of({one("a", FragmentClass::beyond_bound, explained({kValues}, {})),
                 one("b", FragmentClass::infinite, explained({kValues}, {}))});
  ASSERT_EQ(causes.size(), 1U);
  EXPECT_EQ(causes[0].sentence, "values are wrong, sometimes infinite");
  EXPECT_EQ(causes[0].counterexamples.front(), 0U);
}

// Kills: two faults of one part merged into one, although each needs a condition that the other
// does without.
TEST(CausesOf, DifferentNeedsSeparateCauses) {
  const records::Explanation tie = explained({kCoverage}, {"tie"}, {"near plane"});
  const records::Explanation near = explained({kCoverage}, {"near plane"}, {"tie"});
  const std::vector<Counterexample> all{
      one("a", FragmentClass::missing, tie), one("b", FragmentClass::missing, near),
      one("c", FragmentClass::missing, tie), one("d", FragmentClass::missing, near)};
  EXPECT_THAT(places_of(all),
              UnorderedElementsAre(UnorderedElementsAre(0, 2), UnorderedElementsAre(1, 3)));
  std::set<std::string> sentences;
  for (const records::Cause& cause : causes_of(all)) sentences.insert(cause.sentence);
  EXPECT_THAT(sentences,
              UnorderedElementsAre("samples are missing where a sample lies exactly on an edge",
                                   "samples are missing where the near plane cuts the triangle"));
}

// A single law may hold by chance after something is removed.
TEST(CausesOf, DifferentNeedsOfASingleLawDoNotSeparateCauses) {
  const records::Explanation tie = explained({kCoverage}, {"tie"}, {"near plane"});
  const records::Explanation near = explained({kCoverage}, {"near plane"}, {"tie"});
  EXPECT_EQ(causes_of({one("a", FragmentClass::missing, tie), one("b", FragmentClass::missing, tie),
                       one("c", FragmentClass::missing, near)})
                .size(),
            1U);
}

TEST(CausesOf, NeedingAScissorSeparatesCauses) {
  const records::Explanation scissor = explained({kCoverage}, {"scissor"});
  const records::Explanation without = explained({kCoverage}, {}, {"tie"});
  EXPECT_THAT(
      places_of({one("a", FragmentClass::extra, scissor), one("b", FragmentClass::extra, scissor),
                 one("c", FragmentClass::extra, without)}),
      ElementsAre(UnorderedElementsAre(0, 1), ElementsAre(2)));
}

// Kills: a condition that was kept on purpose, counted as a need.
TEST(CausesOf, NeedsImpliedByTheConditionDoNotSeparateCauses) {
  std::vector<Counterexample> all;
  for (const char* law : {"a", "b"}) {
    all.push_back(one(law, FragmentClass::missing, explained({kCoverage}, {"samples"}, {"tie"})));
    all.back().source.found->condition = "several samples";
    all.push_back(one(law, FragmentClass::missing, explained({kCoverage}, {"tie"}, {"samples"})));
    all.back().source.found->condition = "tie";
  }
  EXPECT_EQ(causes_of(all).size(), 1U);
}

// Kills: a law about pictures counted as a separate cause although its fragments are wrong.
TEST(CausesOf, WrongPicturesShareTheCauseOfTheirFragments) {
  records::Explanation picture = explained({}, {});
  picture.wrong = {kCoverage};
  EXPECT_THAT(places_of({one("a", FragmentClass::missing, explained({kCoverage}, {})),
                         one("b", FragmentClass::beyond_bound, picture)}),
              ElementsAre(UnorderedElementsAre(0, 1)));
}

// If the fragments are right, laws that are violated by each other's cases belong to one stage.
TEST(CausesOf, LawsThatAreViolatedTogetherAreOfOneCause) {
  records::Explanation roll = explained({}, {});
  roll.also_violates = {"camera"};
  records::Explanation camera = explained({}, {});
  camera.also_violates = {"roll"};
  EXPECT_THAT(places_of({one("roll", FragmentClass::beyond_bound, roll),
                         one("camera", FragmentClass::beyond_bound, camera),
                         one("normals", FragmentClass::beyond_bound, explained({}, {}))}),
              ElementsAre(UnorderedElementsAre(0, 1), ElementsAre(2)));
}

// Kills: a wrong sign of zero that is shown before a missing sample.
TEST(CausesOf, ZerosComeLast) {
  std::vector<Counterexample> all{one("z", FragmentClass::missing, explained({kCoverage}, {}))};
  for (const char* law : {"a", "b", "c"}) {
    all.push_back(one(law, FragmentClass::wrong_sign_of_zero, explained({kValues}, {})));
  }
  const std::vector<records::Cause> causes = causes_of(all);
  ASSERT_EQ(causes.size(), 2U);
  EXPECT_EQ(causes[0].sentence, "samples are missing");
  EXPECT_EQ(causes[1].sentence, "zeros have the wrong sign");
}

TEST(CausesOf, DrawingsThatFailAreToldApartByWhatIsSaid) {
  const auto failing = [](const char* note) {
    Counterexample failed = one("a", FragmentClass::failed);
    failed.violations[0].note = note;
    return failed;
  };
  const std::vector<Counterexample> all{failing("wrote 7 of 9"), failing("wrote 8 of 9"),
                                        failing("no memory")};
  EXPECT_THAT(places_of(all), ElementsAre(UnorderedElementsAre(0, 1), ElementsAre(2)));
  EXPECT_EQ(causes_of(all)[1].sentence, "it does not draw: no memory");
}

TEST(CausesOf, BackendsHaveCausesOfTheirOwn) {
  std::vector<Counterexample> all{one("a", FragmentClass::missing, explained({kCoverage}, {})),
                                  one("a", FragmentClass::missing, explained({kCoverage}, {}))};
  all[1].source.found->backend = "gl:llvmpipe";
  EXPECT_EQ(causes_of(all).size(), 2U);
}

TEST(CausesOf, SaysWhatWasTriedOfTheFirst) {
  const std::vector<records::Cause> causes = causes_of(
      {one("a", FragmentClass::missing, explained({kCoverage}, {"scissor"}, {"tie", "samples"}))});
  EXPECT_THAT(causes.at(0).tried,
              ElementsAre("holds once coverage is corrected", "holds if: there is no scissor",
                          "still fails if: no sample lies on an edge; a pixel has one sample"));
}

/// A counterexample whose drawing becomes right by these changes.
Counterexample hinted(const char* law, std::optional<std::vector<std::string>> hints) {
  records::Explanation explanation = explained({kCoverage}, {});
  explanation.hints = std::move(hints);
  return one(law, FragmentClass::missing, explanation);
}

// Kills: a hint that is true of one drawing but given for all; a hint counted for drawings that are
// right.
TEST(CausesOf, GivesTheChangeThatMakesMostDrawingsRight) {
  const auto hint_of = [](const std::vector<Counterexample>& all) {
    return causes_of(all).at(0).hint;
  };
  const Counterexample right = hinted("a", std::nullopt);
  const Counterexample both =
      hinted("b", {{"y points in the other direction", "x and y are exchanged"}});
  const Counterexample second = hinted("c", {{"x and y are exchanged"}});
  const Counterexample none = hinted("d", {{}});
  EXPECT_EQ(hint_of({right, right}), std::nullopt);
  EXPECT_EQ(hint_of({right, both}), (records::Hint{"y points in the other direction", 1, 1}));
  EXPECT_EQ(hint_of({both, second, none}), (records::Hint{"x and y are exchanged", 2, 3}));
  EXPECT_EQ(hint_of({both, second, none, none, none}), std::nullopt);
}

// Kills: an upside-down picture reported as two faults, of coverage and of values.
TEST(CausesOf, CasesThatOneChangeMendsShareOneCause) {
  Counterexample values = hinted("a", {{"y points in the other direction"}});
  values.explanation->parts = {kValues};
  const Counterexample coverage = hinted("b", {{"y points in the other direction"}});
  const Counterexample other = hinted("c", {{"x points in the other direction"}});
  EXPECT_THAT(places_of({values, coverage}), ElementsAre(UnorderedElementsAre(0, 1)));
  EXPECT_THAT(places_of({values, other}), UnorderedElementsAre(ElementsAre(0), ElementsAre(1)));
}

// Kills: a sentence about missing samples above a picture of a wrong depth.
TEST(CausesOf, TheFirstOfACauseShowsWhatItsSentenceSays) {
  Counterexample values =
      hinted("values-stay-within-the-bound", {{"y points in the other direction"}});
  values.source.found->verdict = to_string(FragmentClass::beyond_bound);
  values.explanation->parts = {kValues};
  const std::vector<Counterexample> all{values, hinted("b", {{"y points in the other direction"}}),
                                        hinted("c", {{"y points in the other direction"}})};
  const records::Cause cause = causes_of(all).at(0);
  EXPECT_EQ(cause.sentence, "samples are missing");
  EXPECT_THAT(cause.counterexamples, ElementsAre(1, 0, 2));
}

// Kills: a state left over from an earlier drawing, reported as a separate fault for each class.
TEST(CausesOf, CasesThatDoNotFailAgainShareOneCause) {
  records::Explanation held;
  held.fails_again = false;
  const std::vector<Counterexample> all{
      one("a", FragmentClass::missing, held), one("b", FragmentClass::extra, held),
      one("c", FragmentClass::missing, explained({kCoverage}, {}))};
  EXPECT_THAT(places_of(all), ElementsAre(UnorderedElementsAre(0, 1), ElementsAre(2)));
  const records::Cause cause = causes_of(all).at(0);
  EXPECT_EQ(cause.sentence, "the drawing differs from one time to the next");
  EXPECT_THAT(cause.tried, ElementsAre("held when drawn again"));
}

// If a lost depth clamp cuts off a triangle, the triangle's values are wrong too: they belong to
// the clamp's cause.
TEST(CausesOf, ACaseMovesToTheGroupWithTheSameNeeds) {
  const records::Explanation clamped = explained({kCoverage}, {"depth clamp"});
  const records::Explanation values = explained({kValues}, {}, {"tie"});
  EXPECT_THAT(
      places_of({one("a", FragmentClass::missing, clamped),
                 one("b", FragmentClass::missing, clamped),
                 one("c", FragmentClass::beyond_bound, values),
                 one("d", FragmentClass::beyond_bound, values),
                 one("e", FragmentClass::beyond_bound, values),
                 one("f", FragmentClass::beyond_bound, explained({kValues}, {"depth clamp"}))}),
      UnorderedElementsAre(UnorderedElementsAre(0, 1, 5), UnorderedElementsAre(2, 3, 4)));
}

// Kills: two stages merged into one because their laws are both about cameras.
TEST(CausesOf, WhatLawsAreAboutDoesNotJoinStages) {
  records::Explanation camera = explained({}, {});
  camera.inherent = {"camera"};
  records::Explanation also = camera;
  also.also_violates = {"a", "b"};
  EXPECT_THAT(places_of({one("a", FragmentClass::beyond_bound, also),
                         one("b", FragmentClass::beyond_bound, also),
                         one("normals", FragmentClass::beyond_bound, camera)}),
              ElementsAre(UnorderedElementsAre(0, 1), ElementsAre(2)));
}

// If cases are kept as they were found, no explanation is sought.
TEST(CausesOf, WithoutAnExplanationVerdictsAreCauses) {
  const std::vector<Counterexample> all{one("a", FragmentClass::missing),
                                        one("b", FragmentClass::missing),
                                        one("b", FragmentClass::extra)};
  EXPECT_THAT(places_of(all), ElementsAre(UnorderedElementsAre(0, 1), ElementsAre(2)));
  EXPECT_EQ(causes_of(all)[0].sentence, "missing");
}

// Files of other versions may name needs that this version does not know.
TEST(CausesOf, UnknownNeedsAreTakenAsTheyAre) {
  const auto causes = causes_of({one("a", FragmentClass::missing, explained({kCoverage}, {"?"}))});
  EXPECT_EQ(causes.at(0).sentence, "samples are missing");
  EXPECT_THAT(causes.at(0).tried, ElementsAre("holds once coverage is corrected", "holds if: ?"));
}

}  // namespace
}  // namespace rastercheck::properties::causes_test
