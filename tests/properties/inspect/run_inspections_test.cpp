#include "properties/inspect/run_inspections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <tuple>

#include "properties/campaign/campaign.h"
#include "properties/law.h"
#include "records/histogram.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::run_inspections_test {
namespace {

using records::Inspection;
using records::Occasion;
using testing::IsEmpty;
using testing::SizeIs;

/// A run of both laws on random cases and on a corpus of the square.
records::Run run_of(const std::vector<std::string>& backends, std::uint64_t cases) {
  records::Run run;
  run.plan.seed = 1;
  TaskRunner runner({.seed = run.plan.seed, .shrinking = {0, std::nullopt}}, {square()});
  Findings all;
  records::Plan options;
  options.cases_per_law = cases;
  options.backends = backends;
  options.laws = {std::string(kCoverageLaw), std::string(kValuesLaw)};
  for (const Task& task : tasks_of(options, 1)) merge(all, runner.run(task).value());
  run.records = all.records;
  run.counterexamples = all.counterexamples;
  return run;
}

std::vector<Inspection> inspections_of(const records::Run& run) {
  const std::vector<cases::Case> corpus{square()};
  CaseSources sources;
  sources.corpus = corpus;
  CaseDrawer drawer({});
  return inspect_run(run, sources, drawer);
}

/// An upper bound on the error of the inspected sample, in scale ULP.
double error_of(const Inspection& inspection) {
  const records::InspectedSample* sample = records::inspected_sample(inspection);
  if (sample == nullptr) return 0;
  const std::size_t value = inspection.attribute ? 1 + *inspection.attribute : 0;
  return records::magnitude_bound(sample->values.at(value).scale_error.value());
}

// Kills: an inspection of a case other than the one with the error.
TEST(InspectRun, ShowsTheLargestErrorOfEachKindAndStratum) {
  const records::Run run = run_of({"cpu"}, 60);
  const std::vector<Inspection> all = inspections_of(run);
  EXPECT_GT(all.size(), 6U);
  std::set<std::tuple<records::AttributeKind, records::Stratum>> seen;
  for (const Inspection& one : all) {
    SCOPED_TRACE(std::string(to_string(one.kind.value())) + ", " +
                 std::string(to_string(one.stratum.value())));
    EXPECT_EQ(one.occasion, Occasion::worst);
    EXPECT_EQ(one.law, kValuesLaw);
    EXPECT_EQ(one.backend, "cpu");
    EXPECT_TRUE(seen.emplace(*one.kind, *one.stratum).second);
    double largest = 0;
    for (const auto& [key, record] : run.records) {
      const auto sizes = record.errors.strata.find(*one.stratum);
      if (key.attribute_kind != one.kind || sizes == record.errors.strata.end()) continue;
      const records::Extremes& extremes = sizes->second.extremes;
      for (const auto& worst : {extremes.most_negative, extremes.most_positive}) {
        if (worst) largest = std::max(largest, records::magnitude_bound(worst->error));
      }
    }
    EXPECT_GT(largest, 0);
    if (!one.source.coverage) {
      EXPECT_EQ(error_of(one), largest);
    }
    EXPECT_FALSE(one.splits.empty());
    EXPECT_LE(one.samples.size(), 256U);
  }
}

// Kills: counterexamples that come after worst cases, or that have another index.
TEST(InspectRun, ShowsCounterexamplesFirst) {
  const records::Run run = run_of({"damaged", "cpu"}, 20);
  ASSERT_THAT(run.counterexamples, SizeIs(testing::Ge(1)));
  const std::vector<Inspection> all = inspections_of(run);
  ASSERT_GT(all.size(), run.counterexamples.size());
  for (std::size_t i = 0; i < run.counterexamples.size(); ++i) {
    EXPECT_EQ(all[i].occasion, Occasion::counterexample);
    EXPECT_EQ(all[i].counterexample, i);
    EXPECT_EQ(all[i].law, run.counterexamples[i].source.found->law);
    const records::InspectedSample* sample = records::inspected_sample(all[i]);
    ASSERT_NE(sample, nullptr);
    EXPECT_EQ(sample->verdict, records::Verdict::required);
    EXPECT_FALSE(sample->is_drawn);
  }
  const auto key_of = [](const Inspection& one) {
    return std::tuple(one.law, one.backend, one.kind, one.stratum);
  };
  for (std::size_t i = run.counterexamples.size() + 1; i < all.size(); ++i) {
    EXPECT_LT(key_of(all[i - 1]), key_of(all[i]));
  }
  EXPECT_EQ(inspections_of(run), all);
}

/// A counterexample on the square with one violation.
records::Counterexample violated_at(std::uint32_t x, records::FragmentClass fragment_class,
                                    const std::string& backend = "damaged") {
  records::Counterexample one;
  one.source = square();
  one.source.found = {"a law", backend, "missing", 1, 0};
  records::Violation violation;
  violation.fragment_class = fragment_class;
  violation.place.x = x;
  one.violations = {violation};
  return one;
}

// The violation names a pixel that the case does not have; `damaged` loses pixel (7, 7) of B.
TEST(InspectRun, LooksAtTheCaseWhereAViolationIsOfAnotherDrawing) {
  records::Run run;
  run.counterexamples = {violated_at(8, records::FragmentClass::missing)};
  const std::vector<Inspection> all = inspections_of(run);
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(all[0].place.triangle, 1U);
  EXPECT_EQ(all[0].place.x, 7U);
  EXPECT_EQ(all[0].place.y, 7U);
}

// Kills: a report that fails because a backend does.
TEST(InspectRun, LeavesOutWhatCannotBeShown) {
  records::Run run;
  run.counterexamples = {violated_at(0, records::FragmentClass::crash),
                         violated_at(0, records::FragmentClass::missing, "damaged:absent"),
                         violated_at(0, records::FragmentClass::missing, "damaged:refuses")};
  EXPECT_THAT(inspections_of(run), IsEmpty());
}

// The first error is not in the case itself, because a law changed the case; the second error is.
TEST(InspectRun, ShowsNoErrorThatDoesNotComeBack) {
  records::Run run = run_of({"cpu"}, 0);  // the square: x at (0, 0) is 1/2 exactly
  records::WorstError worst;
  worst.error = {3, 3};
  worst.actual = 0.75F;
  worst.attribute = 0;
  records::Record& record = run.records[{"a law", "cpu", records::AttributeKind::smooth, "corpus"}];
  record.errors.strata[records::Stratum::clipped].extremes.most_positive = worst;
  EXPECT_THAT(inspections_of(run), IsEmpty());
  worst.error = {2, 2};
  worst.actual = 0.5F;
  record.errors.strata[records::Stratum::clipped].extremes.most_negative = worst;
  EXPECT_THAT(inspections_of(run), SizeIs(1));
}

TEST(InspectRun, ShowsNotMoreThanForty) {
  records::Run run;
  run.counterexamples.assign(41, violated_at(0, records::FragmentClass::missing));
  EXPECT_THAT(inspections_of(run), SizeIs(records::kMostInspections));
}

// Kills: a whole scene copied into a report.
TEST(InspectRun, TakesATriangleOutOfALargeCase) {
  records::Run run;
  run.counterexamples = {violated_at(6, records::FragmentClass::missing)};
  run.counterexamples[0].violations[0].place.y = 6;
  run.counterexamples[0].violations[0].place.triangle = 20;
  run.counterexamples[0].source.triangles.assign(20, {0, 1, 2});
  run.counterexamples[0].source.triangles.push_back({2, 1, 3});
  const std::vector<Inspection> all = inspections_of(run);
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(all[0].place.triangle, 0U);
  EXPECT_THAT(all[0].source.triangles, SizeIs(1));
  EXPECT_EQ(records::inspected_sample(all[0])->reason, records::Reason::inside);
}

}  // namespace
}  // namespace rastercheck::properties::run_inspections_test
