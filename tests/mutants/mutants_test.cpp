// The laws can fail: each mutant, a rasterizer with one defect, breaks the law that its patch
// names. Mutants whose patches argue that they are no defect break none.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "properties/campaign/campaign.h"
#include "properties/law.h"
#include "tests/mutants/attribution.h"
#include "tests/mutants/mutant_backend.h"

namespace rastercheck::mutants::mutants_test {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::uint64_t kCases = 1000;  // as in a default campaign

/// A case by which a mutant breaks a law.
struct Kill {
  std::uint64_t index = 0;
  cases::Case source;
  properties::Check check;
};

/// The first of the law's own cases whose check finds violations.
Result<std::optional<Kill>> first_kill(const properties::Law& law, backends::Backend& mutant) {
  for (std::uint64_t index = 0; index < kCases; ++index) {
    properties::Draw draw = draw_of(law, kSeed, index);
    const properties::Generated generated = law.generate(draw);
    Result<properties::Check> check = properties::check_law(law, generated.source, mutant, index);
    if (!check) return tl::unexpected(check.error());
    if (check->fault) return tl::unexpected(Error{"", "", *check->fault});
    if (check->violation_count > 0) return Kill{index, generated.source, *std::move(check)};
  }
  return std::nullopt;
}

/// Expects that the backend without the defect passes the law on the same case, so that the law has
/// found the defect.
void expect_unharmed_passes(const properties::Law& law, const std::string& of, const Kill& kill) {
  const auto unharmed = backends::make_backend(of);
  ASSERT_TRUE(unharmed) << to_string(unharmed.error());
  const auto check = properties::check_law(law, kill.source, **unharmed, {kill.index});
  ASSERT_TRUE(check) << to_string(check.error());
  EXPECT_TRUE(check->is_applicable);
  EXPECT_EQ(check->fault, std::nullopt);
  EXPECT_EQ(check->violation_count, 0U);
}

/// Expects that the case, written as a case file and read back, gets the same verdict with a newly
/// loaded mutant.
void expect_replays(const properties::Law& law, const std::string& mutant, const Kill& kill) {
  cases::Case saved = kill.source;
  saved.found = {std::string(law.id), "mutant:" + mutant, "violated", kSeed, kill.index};
  const auto read = cases::parse_case(cases::to_json(saved), "counterexample");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(*read, saved);
  const auto backend = backends::make_backend(read->found->backend);
  ASSERT_TRUE(backend) << to_string(backend.error());
  const auto again = properties::check_law(law, *read, **backend, 0);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->violation_count, kill.check.violation_count);
  EXPECT_EQ(again->violations, kill.check.violations);
}

/// The most triangles that a counterexample may have to be easily understood. A mutant's patch may
/// allow more, if it says why.
constexpr std::size_t kMostTriangles = 3;
std::size_t most_triangles(const Header& header) {
  return header.least.empty() ? kMostTriangles : std::stoul(header.least);
}

/// True if the case without its last column or row fails in the same way, and so was larger than
/// needed.
bool fails_cropped(const properties::Law& law, backends::Backend& mutant,
                   const records::Counterexample& found, int cases::FramebufferSize::*side) {
  cases::Case cropped = found.source;
  if (--(cropped.framebuffer.*side) == 0) return false;
  properties::Check check =
      properties::check_or_note(law, cropped, mutant, found.source.found->index);
  return check.is_applicable && properties::put_alike_first(check, cropped, *found.source.found);
}

/// Expects that a default campaign shrinks the case to few triangles and no pixel too many, and
/// that the failure is still due to the defect.
void expect_shrinks(const properties::Law& law, const Header& header, backends::Backend& mutant,
                    const Kill& kill) {
  properties::Findings found;
  properties::check_case(law, "mutant", mutant, kSeed, {kill.source, "", kill.index}, found);
  // The case may fail in several ways; takes the way of the check's first violation.
  const auto first = std::find_if(
      found.counterexamples.begin(), found.counterexamples.end(), [&kill](const auto& one) {
        const cases::Found& way = *one.source.found;
        const bool is_of_kind =
            way.kind.empty() || to_string(kill.check.violations.front().kind) == way.kind;
        return properties::verdict_of(kill.check) == way.verdict && is_of_kind;
      });
  ASSERT_NE(first, found.counterexamples.end());
  properties::Findings shrunk;
  const properties::ShrinkLimits limits{records::ShrinkBudget().tries, {}};
  properties::shrink_counterexample(law, mutant, *first, limits, shrunk);
  ASSERT_EQ(shrunk.fault, std::nullopt);
  ASSERT_EQ(shrunk.counterexamples.size(), 1U);
  const records::Counterexample& least = shrunk.counterexamples[0];
  const cases::FramebufferSize& size = least.source.framebuffer;
  testing::Test::RecordProperty("triangles", static_cast<int>(least.source.triangles.size()));
  testing::Test::RecordProperty("pixels", size.width * size.height);
  testing::Test::RecordProperty("shrink_tries", static_cast<int>(least.shrinking->tries));
  EXPECT_LE(least.source.triangles.size(), most_triangles(header));
  EXPECT_TRUE(least.shrinking->is_least) << least.shrinking->tries << " tries were not enough";
  EXPECT_FALSE(fails_cropped(law, mutant, least, &cases::FramebufferSize::width)) << size.width;
  EXPECT_FALSE(fails_cropped(law, mutant, least, &cases::FramebufferSize::height)) << size.height;
  // Textbook methods have faults of their own, which the smaller case may show instead.
  if (header.of.starts_with("method:")) return;
  expect_unharmed_passes(law, header.of, {kill.index, least.source, {}});
}

/// Expects that the exact split of what the law found names the damaged stage.
void expect_attributed(const Header& header, backends::Backend& mutant, const Kill& kill) {
  if (header.attributed_to.empty()) return;
  const auto stage = blamed_stage(header.killed_by, kill.source, mutant);
  ASSERT_TRUE(stage) << "no stage is to blame";
  EXPECT_EQ(to_string(*stage), header.attributed_to);
}

class Mutants : public testing::TestWithParam<std::string> {};

TEST_P(Mutants, HasADefectAndALawThatKillsIt) {
  const Header header = header_of(GetParam());
  EXPECT_FALSE(header.defect.empty());
  EXPECT_NE(properties::find_law(header.killed_by), nullptr) << "'" << header.killed_by << "'";
  EXPECT_TRUE(backends::make_backend(header.of)) << "'" << header.of << "'";
}

TEST_P(Mutants, IsKilledByItsLawAtAFixedSeed) {
  const Header header = header_of(GetParam());
  const properties::Law* law = properties::find_law(header.killed_by);
  ASSERT_NE(law, nullptr);
  const auto mutant = backends::make_backend("mutant:" + GetParam());
  ASSERT_TRUE(mutant) << to_string(mutant.error());
  const auto kill = first_kill(*law, **mutant);
  ASSERT_TRUE(kill) << to_string(kill.error());
  ASSERT_TRUE(*kill) << "survives " << kCases << " cases of seed " << kSeed;
  RecordProperty("killing_case", std::to_string((*kill)->index));
  SCOPED_TRACE("case " + std::to_string((*kill)->index));
  ASSERT_FALSE((*kill)->check.violations.empty());
  expect_unharmed_passes(*law, header.of, **kill);
  expect_replays(*law, GetParam(), **kill);
  expect_shrinks(*law, header, **mutant, **kill);
  expect_attributed(header, **mutant, **kill);
}

/// Test names must not contain hyphens.
std::string test_name(const testing::TestParamInfo<std::string>& mutant) {
  std::string name = mutant.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Returns the mutants that are argued to be no defect if `is_equivalent`, otherwise those that a
/// law kills.
std::vector<std::string> names_of(bool is_equivalent) {
  std::vector<std::string> names = mutant_names();
  std::erase_if(names, [is_equivalent](const std::string& name) {
    return header_of(name).equivalent.empty() == is_equivalent;
  });
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, Mutants, testing::ValuesIn(names_of(false)), test_name);

class EquivalentMutants : public testing::TestWithParam<std::string> {};

/// Checks the two laws that judge the whole drawing by the contract.
TEST_P(EquivalentMutants, KeepTheContract) {
  EXPECT_EQ(header_of(GetParam()).killed_by, "");
  const auto mutant = backends::make_backend("mutant:" + GetParam());
  ASSERT_TRUE(mutant) << to_string(mutant.error());
  for (const char* name : {"coverage-obeys-the-contract", "values-stay-within-the-bound"}) {
    const properties::Law* law = properties::find_law(name);
    ASSERT_NE(law, nullptr);
    const auto kill = first_kill(*law, **mutant);
    ASSERT_TRUE(kill) << to_string(kill.error());
    EXPECT_FALSE(*kill) << name << " kills it with case " << (*kill)->index;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EquivalentMutants, testing::ValuesIn(names_of(true)), test_name);

// Mutants damage the rasterizer. One law applies only to drivers, two of which break it
// (backends/llvmpipe/known.json); in that law's own test a made-up backend breaks it.
TEST(Laws, HaveAMutantEach) {
  ASSERT_FALSE(properties::laws().empty());
  for (const properties::Law& law : properties::laws()) {
    if (law.id == "every-way-of-drawing-draws-the-same-bits") continue;
    EXPECT_TRUE(
        std::any_of(mutant_names().begin(), mutant_names().end(),
                    [&law](const std::string& m) { return header_of(m).killed_by == law.id; }))
        << law.id;
  }
}

TEST(MutantBackend, ListsEveryMutantAsAbleToRun) {
  std::set<std::string> expected;
  for (const auto* names : {&mutant_names(), &gate_mutant_names(), &rare_mutant_names()}) {
    expected.insert(names->begin(), names->end());
  }
  const std::set<std::string> rare(rare_mutant_names().begin(), rare_mutant_names().end());
  constexpr std::string_view kPrefix = "mutant:";
  std::set<std::string> listed;
  for (const backends::Listing& listing : backends::BackendFactory().list()) {
    if (!listing.specification.starts_with(kPrefix)) continue;
    const std::string name = listing.specification.substr(kPrefix.size());
    listed.insert(name);
    // Rare mutants are built by a target of their own, and may not be there.
    if (rare.contains(name)) continue;
    EXPECT_EQ(listing.unavailable_because, "") << name;
  }
  EXPECT_EQ(listed, expected);
}

TEST(MutantBackend, KnowsNoOther) {
  EXPECT_FALSE(backends::make_backend("mutant:"));
  EXPECT_FALSE(backends::make_backend("mutant:../modules/pixel-corner"));
}

}  // namespace
}  // namespace rastercheck::mutants::mutants_test
