#include "gate/sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/records/sample_sections.h"
#include "tests/reports/sample_run.h"

namespace rastercheck::gate::sections_test {
namespace {

using records::AttributeKind;
using records::CaseOutcome;
using records::FragmentClass;
using records::Origin;
using records::Stratum;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kValues = "values are within bounds";

/// The sample run with two cases of that law, and with the records that saved counterexamples add.
records::Run run_with_cases() {
  records::Run run = reports::sample_run();
  run.environment["architecture"] = "x86_64";
  run.environment["instruction_set"] = "avx2";
  run.cases.emplace();
  records::CaseRecord corpus;
  corpus.name = "a name";
  corpus.source_digest = 5;
  corpus.found_digest = 6;
  corpus.mismatches = 2;
  corpus.outcome = CaseOutcome::violated;
  corpus.worst[AttributeKind::smooth][Stratum::ordinary] = reports::sample_worst(0.5);
  (*run.cases)[{kValues, "cpu", Origin::corpus, 3}] = corpus;
  records::CaseRecord none;
  none.outcome = CaseOutcome::not_applicable;
  none.source_digest = 7;
  (*run.cases)[{kValues, "cpu", Origin::random, 0}] = none;
  (*run.cases)[{kValues, "method:float32", Origin::random, 0}] = none;
  records::Record saved;
  saved.cases.checked = 100;
  saved.errors.classes[FragmentClass::missing] = 100;
  run.records[{kValues, "cpu", AttributeKind::coverage, std::string(records::kSavedStratum)}] =
      saved;
  return run;
}

TEST(SectionOf, HasTheFiguresOfAllFrozenCases) {
  const Result<records::BaselineSection> section = section_of(run_with_cases(), "cpu");
  ASSERT_TRUE(section) << to_string(section.error());
  EXPECT_EQ(section->key, (records::BaselineKey{"cpu", "x86_64", "", ""}));
  EXPECT_EQ(section->taken, (records::Taken{"cpu", "0.1.0", "", "avx2", "g++ <12> & more"}));
  EXPECT_THAT(section->plan.properties, ElementsAre("*<values>*"));
  // Two strata of the generator, with 600 and 400 cases, but none of the 100 saved cases.
  const records::EntryFigures coverage =
      section->entries.at({kValues, AttributeKind::coverage, std::nullopt});
  EXPECT_EQ(coverage.cases, (records::CaseCounts{1000, 3, 0, 0}));
  EXPECT_EQ(coverage.classes[FragmentClass::missing], 0U);
  const records::EntryFigures smooth =
      section->entries.at({kValues, AttributeKind::smooth, std::nullopt});
  EXPECT_EQ(smooth.histogram.count(), 12000U);
  EXPECT_EQ(smooth.worst, (records::Enclosure{0.5, 0.5}));
  const records::EntryFigures near =
      section->entries.at({kValues, AttributeKind::smooth, Stratum::near_horizon});
  EXPECT_EQ(near.histogram.count(), 3000U);
  EXPECT_EQ(near.worst, (records::Enclosure{0.375, 0.375}));
  EXPECT_EQ(near.classes, records::ClassCounts());
  // A law that checked nothing has an entry of its own, so that it is visible.
  EXPECT_TRUE(section->entries.contains(
      {"a law <that> says | nothing", AttributeKind::coverage, std::nullopt}));
}

// Kills: keeping only the path of a contract; keeping settings that do not decide the generated
// cases.
TEST(SectionOf, HasWhatIsFrozenOfThePlan) {
  records::Run run = run_with_cases();
  run.plan.contract.emplace().file = "lax.json";
  run.plan.contract->terms.keeps_constants = false;
  run.plan.timeout = 5;
  run.plan.shrinking.tries = 3;
  const Result<records::BaselineSection> section = section_of(run, "cpu");
  EXPECT_EQ(section->plan.contract, run.plan.contract);
  EXPECT_EQ(section->plan, records::frozen(run.plan));
  EXPECT_EQ(section->plan.timeout, records::Plan().timeout);
}

// Kills: ignoring a worst error that lies below the exact value.
TEST(SectionOf, HasTheWorstOnEitherSide) {
  const Result<records::BaselineSection> section = section_of(run_with_cases(), "method:float32");
  ASSERT_TRUE(section);
  EXPECT_EQ(section->entries.at({kValues, AttributeKind::smooth, std::nullopt}).worst,
            (records::Enclosure{0.7, 0.7}));
}

TEST(SectionOf, HasEachCaseToWhichTheLawApplies) {
  const Result<records::BaselineSection> section = section_of(run_with_cases(), "cpu");
  ASSERT_TRUE(section);
  const records::LawCases& law = section->laws.at(kValues);
  EXPECT_EQ(law.count, 2U);
  ASSERT_EQ(law.cases.size(), 1U);
  const records::CaseFigures& figures = law.cases.at({Origin::corpus, 3});
  EXPECT_EQ(figures.found_digest, 6U);
  EXPECT_EQ(figures.mismatches, 2U);
  EXPECT_EQ(figures.outcome, CaseOutcome::violated);
  EXPECT_EQ(figures.worst.at(AttributeKind::smooth).at(Stratum::ordinary),
            reports::sample_worst(0.5));
  EXPECT_THAT(section->corpus, ElementsAre(testing::Pair(3, "a name")));
  EXPECT_EQ(section->laws.size(), 3U);
}

// Kills: a digest that leaves out a case, its number or its file.
TEST(SectionOf, HasADigestOfAllThatIsFrozen) {
  const auto digest = [](const records::Run& run) {
    return section_of(run, "cpu")->laws.at(kValues).digest;
  };
  const records::Run run = run_with_cases();
  records::Run other = run;
  (*other.cases)[{kValues, "cpu", Origin::random, 0}].source_digest = 8;
  EXPECT_NE(digest(other), digest(run));
  other = run;
  (*other.cases)[{kValues, "cpu", Origin::random, 1}] =
      run.cases->at({kValues, "cpu", Origin::random, 0});
  EXPECT_NE(digest(other), digest(run));
  other.cases->erase({kValues, "cpu", Origin::random, 0});
  EXPECT_NE(digest(other), digest(run));
  other = run;
  (*other.cases)[{kValues, "cpu", Origin::random, 0}].found_digest = 99;
  EXPECT_EQ(digest(other), digest(run));
}

TEST(SectionOf, RefusesRunsThatCannotBeCompared) {
  records::Run run = run_with_cases();
  EXPECT_THAT(section_of(run, "gl").error().reason, HasSubstr("does not include the backend 'gl'"));
  run.shard.emplace();
  run.plan.shard = {2, 7};
  EXPECT_THAT(section_of(run, "cpu").error().reason, HasSubstr("is only shard 2"));
  run.cases_left = 1;
  EXPECT_THAT(section_of(run, "cpu").error().reason, HasSubstr("was interrupted"));
  run.cases.reset();
  EXPECT_THAT(section_of(run, "cpu").error().reason, HasSubstr("--keep-cases"));
}

// --- Sections of a file --------------------------------------------------------------------------

records::BaselineSection with_key(const std::string& instruction_set, const std::string& compiler) {
  records::BaselineSection section = records::sample_section();
  section.key.instruction_set = instruction_set;
  section.key.compiler = compiler;
  return section;
}

/// The last two parts of the key of the section that is found for a machine with avx2 and GNU
/// 12.2.0.
std::string found_in(const std::vector<records::BaselineSection>& sections) {
  records::Baseline baseline;
  for (const records::BaselineSection& section : sections) put(baseline, section);
  const records::BaselineSection* found = find_section(baseline, records::sample_section());
  return found == nullptr ? "none" : found->key.instruction_set + "/" + found->key.compiler;
}

TEST(FindSection, TakesTheMostSpecificThatMatches) {
  const records::BaselineSection any = with_key("", "");
  const records::BaselineSection vectors = with_key("avx2", "");
  const records::BaselineSection compiler = with_key("", "GNU 12.2.0");
  const records::BaselineSection both = with_key("avx2", "GNU 12.2.0");
  const records::BaselineSection others = with_key("avx512", "");
  EXPECT_EQ(found_in({any, others}), "/");
  EXPECT_EQ(found_in({any, compiler, others}), "/GNU 12.2.0");
  EXPECT_EQ(found_in({compiler, vectors, any}), "avx2/");
  EXPECT_EQ(found_in({both, compiler, vectors, any}), "avx2/GNU 12.2.0");
  EXPECT_EQ(found_in({others, with_key("avx2", "Clang 14")}), "none");
  EXPECT_EQ(found_in({}), "none");
}

TEST(FindSection, AsksForBackendAndArchitecture) {
  records::BaselineSection other = records::sample_section();
  other.key.backend = "gl";
  EXPECT_EQ(found_in({other}), "none");
  other = records::sample_section();
  other.key.architecture = "aarch64";
  EXPECT_EQ(found_in({other}), "none");
}

TEST(Put, KeepsOneSectionOfAKey) {
  records::Baseline baseline;
  put(baseline, with_key("avx2", ""));
  put(baseline, with_key("", ""));
  records::BaselineSection again = with_key("avx2", "");
  again.plan.seed = 5;
  put(baseline, again);
  ASSERT_EQ(baseline.sections.size(), 2U);
  EXPECT_EQ(baseline.sections[0].key.instruction_set, "");
  EXPECT_EQ(baseline.sections[1].plan.seed, 5U);
}

// Kills: finding no section for a plugin because its path is written in another way.
TEST(SectionName, IsTheSameForTheSamePath) {
  EXPECT_EQ(records::section_name("plugin:./build//x/../p.so"), "plugin:build/p.so");
  EXPECT_EQ(records::section_name("plugin:build/p.so"), "plugin:build/p.so");
  EXPECT_EQ(records::section_name("plugin:/a/./p.so"), "plugin:/a/p.so");
  EXPECT_EQ(records::section_name("plugin:../p.so"), "plugin:../p.so");
  EXPECT_EQ(records::section_name("method:./a"), "method:./a");
  records::Run run = run_with_cases();
  run.plan.backends = {"plugin:./p.so"};
  EXPECT_EQ(section_of(run, "plugin:./p.so")->key.backend, "plugin:p.so");
  EXPECT_EQ(section_of(run, "plugin:./p.so")->taken.backend, "plugin:./p.so");
  run.plan.backends.emplace_back("plugin:p.so");
  EXPECT_EQ(baseline_of(run).error().reason,
            "the backends 'plugin:./p.so' and 'plugin:p.so' have the same name in a baseline");
}

TEST(BaselineKey, ReadsAsASentencePart) {
  EXPECT_EQ(to_string(with_key("", "").key), "cpu on x86_64");
  EXPECT_EQ(to_string(with_key("avx2", "GNU 12").key), "cpu on x86_64, avx2, GNU 12");
  EXPECT_EQ(to_string(records::kSampleSliver), "values are <within> bounds: smooth, sliver");
  EXPECT_EQ(to_string(records::kSampleCoverage), "values are <within> bounds: coverage");
}

}  // namespace
}  // namespace rastercheck::gate::sections_test
