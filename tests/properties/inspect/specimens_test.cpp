#include "properties/inspect/specimens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <tuple>

#include "properties/campaign/campaign.h"
#include "properties/inspect/closer_looks.h"
#include "properties/law.h"
#include "records/histogram.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::specimens_test {
namespace {

using records::Specimen;
using testing::IsEmpty;
using testing::SizeIs;

/// A run of the laws of coverage and of values on random cases and on a corpus of the square.
records::Run run_of(const std::vector<std::string>& backends, std::uint64_t cases) {
  records::Run run;
  run.plan.seed = 1;
  TaskRunner runner({.seed = run.plan.seed, .shrinking = {0, std::nullopt}, .keeps_cases = true},
                    {square()});
  Findings all;
  records::Plan options;
  options.cases_per_law = cases;
  options.backends = backends;
  options.laws = {std::string(kCoverageLaw), std::string(kValuesLaw)};
  options.keeps_cases = true;
  for (const Task& task : tasks_of(options, 1)) merge(all, runner.run(task).value());
  run.plan.backends = backends;
  run.records = all.records;
  run.cases = all.cases;
  return run;
}

const std::vector<cases::Case>& corpus() {
  static const std::vector<cases::Case> kCorpus{square()};
  return kCorpus;
}

records::Plan plan_of_seed(std::uint64_t seed) {
  records::Plan plan;
  plan.seed = seed;
  return plan;
}

std::vector<Specimen> specimens_of(const records::Run& run) {
  CaseSources sources;
  sources.corpus = corpus();
  CaseDrawer drawer({});
  return make_specimens(run, sources, drawer);
}

std::vector<Specimen> again(const std::vector<Specimen>& kept, const std::string& backend) {
  CaseDrawer drawer({});
  return draw_again(kept, backend, plan_of_seed(1), corpus(), drawer);
}

using Stratum = std::tuple<std::string, std::string>;  ///< law and stratum of its records

/// The law and stratum of each case that is kept.
std::set<Stratum> strata_of(const records::Run& run, const std::vector<Specimen>& kept) {
  std::set<Stratum> strata;
  for (const Specimen& one : kept) strata.emplace(one.key.law, run.cases->at(one.key).stratum);
  return strata;
}

// Kills: strata without a kept case although their cases cover samples.
TEST(MakeSpecimens, HaveACaseOfEachStratumOfTheRecords) {
  const records::Run run = run_of({"cpu"}, 100);
  std::set<Stratum> strata;
  for (const auto& [key, record] : run.cases.value()) strata.emplace(key.law, record.stratum);
  const std::vector<Specimen> kept = specimens_of(run);
  EXPECT_GT(strata.size(), 20U);
  // With this seed, the first cases of "sizes" are smaller than a pixel, and no case that is tried
  // covers a sample.
  const std::set<Stratum> shown = strata_of(run, kept);
  for (const auto& [law, stratum] : strata) {
    EXPECT_TRUE(shown.contains({law, stratum}) || stratum == "sizes") << law << ", " << stratum;
  }
  EXPECT_LE(kept.size(), records::kMostSpecimens);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end(), [](const Specimen& a, const Specimen& b) {
    return std::tie(a.key, a.triangle) < std::tie(b.key, b.triangle);
  }));
  EXPECT_EQ(specimens_of(run), kept);
  for (const Specimen& one : kept) {
    EXPECT_LE(one.bits.size(), records::kMostSpecimenValues);
    EXPECT_GT(one.sample_count(), 0U);
  }
}

// Kills: worst cases that are not kept, are kept at another place, or with other values.
TEST(MakeSpecimens, HaveTheLargestErrorOfEachKindAndStratumOfFragments) {
  const records::Run run = run_of({"cpu"}, 100);
  struct Worst {
    records::CaseKey key;
    records::WorstError error;
  };
  std::map<std::tuple<records::AttributeKind, records::Stratum>, Worst> largest;
  for (const auto& [key, record] : run.cases.value()) {
    for (const auto& [kind, strata] : record.worst) {
      if (kind == records::AttributeKind::flat) continue;
      for (const auto& [stratum, worst] : strata) {
        Worst& kept = largest[{kind, stratum}];
        const double size = records::magnitude_bound(worst.error);
        if (size > records::magnitude_bound(kept.error.error)) kept = {key, worst};
      }
    }
  }
  EXPECT_GT(largest.size(), 6U);
  const std::vector<Specimen> kept = specimens_of(run);
  for (const auto& [of, worst] : largest) {
    SCOPED_TRACE(std::string(to_string(std::get<1>(of))));
    EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [&worst = worst](const Specimen& one) {
      const auto value = one.value_at(worst.error.place.x, worst.error.place.y,
                                      worst.error.place.sample, worst.error.attribute);
      return one.key == worst.key && one.triangle == worst.error.place.triangle && value &&
             std::bit_cast<std::uint32_t>(*value) ==
                 std::bit_cast<std::uint32_t>(worst.error.actual);
    }));
  }
}

// Kills: a choice of first cases that depends on the drawings, so that drawings of two backends
// cannot be compared.
TEST(MakeSpecimens, AreOfTheSamePartsForEachBackend) {
  const records::Run run = run_of({"cpu", "method:screen-linear"}, 60);
  const std::vector<Specimen> kept = specimens_of(run);
  const auto of_backend = [&kept](const std::string& backend) {
    std::vector<Specimen> some;
    std::copy_if(kept.begin(), kept.end(), std::back_inserter(some),
                 [&backend](const Specimen& one) { return one.key.backend == backend; });
    return some;
  };
  const std::vector<Specimen> ours = of_backend("cpu");
  const std::vector<Specimen> theirs = of_backend("method:screen-linear");
  std::vector<Specimen> shared;
  for (const Specimen& one : ours) {
    if (std::any_of(theirs.begin(), theirs.end(),
                    [&one](const Specimen& other) { return records::is_same_part(one, other); })) {
      shared.push_back(one);
    }
  }
  EXPECT_EQ(strata_of(run, shared), strata_of(run, ours));
  EXPECT_EQ(again(ours, "cpu"), ours);
  const std::vector<Specimen> redrawn = again(shared, "method:screen-linear");
  ASSERT_EQ(redrawn.size(), shared.size());
  EXPECT_TRUE(std::all_of(redrawn.begin(), redrawn.end(), [&theirs](const Specimen& one) {
    return std::find(theirs.begin(), theirs.end(), one) != theirs.end();
  }));
}

TEST(MakeSpecimens, KeepNothingOfRunsThatKeptNoCases) {
  records::Run run = run_of({"cpu"}, 5);
  run.cases.reset();
  EXPECT_THAT(specimens_of(run), IsEmpty());
}

// The square by hand: attribute x is u, depth is 1/4, and triangle A has the pixels with x + y < 7.
TEST(MakeSpecimens, HoldWhatWasDrawn) {
  const records::Run run = run_of({"cpu"}, 0);
  const std::vector<Specimen> kept = specimens_of(run);
  ASSERT_THAT(kept, SizeIs(2));  // one for each law
  const Specimen& one = kept[0];
  EXPECT_EQ(one.key,
            (records::CaseKey{std::string(kCoverageLaw), "cpu", records::Origin::corpus, 0}));
  EXPECT_EQ(one.case_name, square().name);
  EXPECT_EQ(one.triangle, 0U);
  EXPECT_EQ(one.width, 8U);
  EXPECT_EQ(one.value_at(2, 1, 0, 0), 2.5F);
  EXPECT_EQ(one.value_at(2, 1, 0, std::nullopt), 0.25F);
  EXPECT_EQ(one.value_at(7, 7, 0, 0), std::nullopt);
}

TEST(DrawAgain, LeavesOutWhatCannotBeDrawn) {
  std::vector<Specimen> kept = specimens_of(run_of({"cpu"}, 0));
  EXPECT_THAT(again(kept, "no-such-backend"), IsEmpty());
  EXPECT_THAT(again(kept, "damaged:refuses"), IsEmpty());
  kept[0].key.index = 1;  // the corpus has one case
  kept[1].left = 1;       // eight pixels from column 1 on are one too many
  EXPECT_THAT(again(kept, "cpu"), IsEmpty());
}

// --- Closer looks --------------------------------------------------------------------------------

/// Requests for the kept parts that change because `damaged` loses pixel (7, 7) of triangle B.
std::vector<LookRequest> lost_pixel() {
  Specimen whole = specimens_of(run_of({"cpu"}, 0)).at(0);
  whole.triangle = 1;
  const std::vector<Specimen> kept = again({whole}, "cpu");
  return changed_parts(kept, again(kept, "damaged"), 4);
}

TEST(ChangedParts, PointAtThePixelThatChangedMost) {
  const std::vector<LookRequest> parts = lost_pixel();
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].key.backend, "damaged");
  EXPECT_EQ(parts[0].at, (cases::SamplePlace{1, 7, 7, 0}));
  EXPECT_EQ(parts[0].attribute, std::nullopt);
  const std::vector<Specimen> kept = specimens_of(run_of({"cpu"}, 0));
  EXPECT_THAT(changed_parts(kept, again(kept, "cpu"), 4), IsEmpty());
  EXPECT_THAT(changed_parts(kept, {}, 4), IsEmpty());
}

std::vector<records::CloserLook> looks_at(const std::vector<LookRequest>& requests) {
  CaseDrawer drawer({});
  return closer_looks(requests, plan_of_seed(1), corpus(), drawer);
}

TEST(CloserLooks, ShowThePartThatWasKept) {
  const std::vector<LookRequest> requests = lost_pixel();
  ASSERT_THAT(requests, SizeIs(1));
  const std::vector<records::CloserLook> looks = looks_at(requests);
  ASSERT_THAT(looks, SizeIs(1));
  EXPECT_EQ(looks[0].before, requests[0].before);
  EXPECT_EQ(looks[0].inspection.width, requests[0].before->width);
  const records::InspectedSample* const sample = records::inspected_sample(looks[0].inspection);
  ASSERT_NE(sample, nullptr);
  EXPECT_FALSE(sample->is_drawn);
  EXPECT_EQ(sample->verdict, records::Verdict::required);
}

// Kills: pictures of another part; values other than those that were compared.
TEST(CloserLooks, LeaveOutWhatIsNotWhatWasAskedFor) {
  LookRequest request;
  request.key = {std::string(kValuesLaw), "cpu", records::Origin::corpus, 0};
  request.at = {0, 1, 2, 0};
  request.attribute = 0;
  request.actual = 2.5F;
  request.before = specimens_of(run_of({"cpu"}, 0)).at(0);
  EXPECT_THAT(looks_at({request}), SizeIs(1));
  request.before->triangle = 1;
  const std::vector<records::CloserLook> other = looks_at({request});
  ASSERT_THAT(other, SizeIs(1));
  EXPECT_FALSE(other[0].before);
  request.actual = 2.25F;
  EXPECT_THAT(looks_at({request}), IsEmpty());
}

}  // namespace
}  // namespace rastercheck::properties::specimens_test
