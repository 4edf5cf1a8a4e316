#include "properties/campaign/waiver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/campaign/check_case.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::waiver_test {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::KnownFact;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

/// A case found by a law's check of a backend, with a scissor that removes nothing.
cases::Case found_case(const std::string& law = kCoverage) {
  cases::Case c = square();
  c.scissor = cases::Scissor{0, 0, 8, 8};
  c.found = cases::Found{law, "damaged", "missing", 1, 0};
  return c;
}

/// Loses a fragment if there is a scissor; the contract requires this fragment.
void lose_with_scissor(const cases::Case& c, cases::Fragments& drawn) {
  if (c.scissor && find(drawn, 0, 1, 1) < drawn.size()) drop(drawn, 0, 1, 1);
}

Result<Waiver> waiver_of(const std::vector<cases::Case>& all, backends::Backend& backend,
                         const KnownDefects& known = {}) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) names.push_back("case " + std::to_string(i));
  return make_waiver(all, names, backend, known);
}

KnownDefects known_by(const Waiver& waiver) {
  KnownDefects known;
  known.defects.push_back({waiver.entry, std::nullopt, records::Staleness::waiver});
  known.defects.front().entry.id = "mine-1";
  return known;
}

TEST(Waiver, AsksForWhatTheCounterexampleNeeds) {
  DamagedBackend backend(&lose_with_scissor);
  const Waiver waiver = waiver_of({found_case()}, backend).value();
  EXPECT_THAT(waiver.entry.laws, IsEmpty());
  EXPECT_THAT(waiver.entry.verdicts, ElementsAre(FragmentClass::missing));
  EXPECT_THAT(waiver.entry.when.attribute_kinds, ElementsAre(AttributeKind::coverage));
  EXPECT_TRUE(waiver.entry.when.facts.at(KnownFact::scissor));
  EXPECT_THAT(waiver.sentence, HasSubstr("there is a scissor"));
}

// Kills: a waiver for one law only although the fault breaks a dozen laws.
TEST(Waiver, KnowsTheFaultInOtherLaws) {
  DamagedBackend backend(&lose_with_scissor);
  const KnownDefects known = known_by(waiver_of({found_case()}, backend).value());
  int violated = 0;
  for (const Law& law : laws()) {
    const Check check = check_or_note(law, found_case(), backend, 0, &known);
    if (check.violation_count == 0) continue;
    ++violated;
    EXPECT_THAT(check.known, ElementsAre("mine-1")) << law.id;
  }
  EXPECT_GT(violated, 1);
}

// Kills: a waiver that hides another fault in the same part, or a fault in another part of the same
// case.
TEST(Waiver, DoesNotHideAnotherFault) {
  DamagedBackend damaged(&lose_with_scissor);
  const KnownDefects known = known_by(waiver_of({found_case()}, damaged).value());
  DamagedBackend worse([](const cases::Case& c, cases::Fragments& drawn) {
    lose_with_scissor(c, drawn);
    add(drawn, 1, 2, 2);
  });
  const Check both = check_or_note(*find_law(kCoverage), found_case(), worse, 0, &known);
  EXPECT_THAT(both.known, IsEmpty());
  ASSERT_EQ(both.violation_count, 1U);
  EXPECT_EQ(both.violations.at(0).fragment_class, FragmentClass::extra);
  cases::Case without = found_case();
  without.scissor.reset();
  DamagedBackend always(
      [](const cases::Case& /*c*/, cases::Fragments& drawn) { drop(drawn, 0, 1, 1); });
  EXPECT_THAT(check_or_note(*find_law(kCoverage), without, always, 0, &known).known, IsEmpty());
}

// Kills: an intermittent fault that counts as known because it is gone when the case is drawn
// again.
TEST(Waiver, DoesNotHideWhatComesAndGoes) {
  DamagedBackend damaged(&lose_with_scissor);
  const KnownDefects known = known_by(waiver_of({found_case()}, damaged).value());
  int drawings = 0;
  DamagedBackend at_times([&drawings](const cases::Case& c, cases::Fragments& drawn) {
    // The first drawing has only another fault, the second only the known one, and later ones are
    // right.
    if (++drawings == 1) add(drawn, 1, 2, 2);
    if (drawings == 2) lose_with_scissor(c, drawn);
  });
  const Check check = check_or_note(*find_law(kCoverage), found_case(), at_times, 0, &known);
  EXPECT_GT(check.violation_count, 0U);
  EXPECT_THAT(check.known, IsEmpty());
}

TEST(Waiver, IsRefusedWhereTheLawHolds) {
  DamagedBackend backend;
  const Result<Waiver> waiver = waiver_of({found_case()}, backend);
  ASSERT_FALSE(waiver);
  EXPECT_EQ(
      to_string(waiver.error()),
      "case 0: the property coverage-obeys-the-contract holds here, so there is nothing to waive");
}

TEST(Waiver, IsRefusedOfWhatIsNoCounterexampleOrIsKnown) {
  DamagedBackend backend(&lose_with_scissor);
  cases::Case no_counterexample = found_case();
  no_counterexample.found.reset();
  EXPECT_EQ(to_string(waiver_of({no_counterexample}, backend).error()),
            "case 0: /found: is missing; only a counterexample can be recorded as known");
  const KnownDefects known = known_by(waiver_of({found_case()}, backend).value());
  EXPECT_EQ(to_string(waiver_of({found_case()}, backend, known).error()),
            "case 0: is already known: mine-1");
}

TEST(Waiver, OfWhatDrawsNothingIsOfItsMessage) {
  class Failing : public DamagedBackend {
   protected:
    Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
      return tl::unexpected(
          Error{"", "", "out of tiles after " + std::to_string(c.triangles.size()) + " triangles"});
    }
  };
  Failing backend;
  EXPECT_EQ(to_string(waiver_of({found_case()}, backend).error()),
            "case 0: fails in another way than recorded in the file");
  cases::Case failed = found_case();
  failed.found->verdict = "failed";
  const Waiver waiver = waiver_of({failed}, backend).value();
  EXPECT_THAT(waiver.entry.laws, ElementsAre(kCoverage));  // a message alone may come from anything
  EXPECT_THAT(waiver.entry.verdicts, ElementsAre(FragmentClass::failed));
  EXPECT_EQ(waiver.entry.when.note, "out of tiles after");
  const KnownDefects known = known_by(waiver);
  EXPECT_THAT(check_or_note(*find_law(kCoverage), found_case(), backend, 0, &known).known,
              ElementsAre("mine-1"));
}

}  // namespace
}  // namespace rastercheck::properties::waiver_test
