#include "records/record.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "records/record_json.h"
#include "tests/records/random_record.h"

namespace rastercheck::records::record_test {
namespace {

WorstError error_of(Enclosure error) {
  WorstError worst;
  worst.error = error;
  worst.exact = "5";
  worst.actual = 5;
  worst.case_index = 5;
  worst.case_name = "name";
  worst.place.triangle = worst.place.x = worst.place.y = worst.place.sample = 5;
  worst.attribute = 5;
  return worst;
}

Extremes extremes_of(const std::vector<WorstError>& errors) {
  Extremes extremes;
  for (const WorstError& error : errors) keep(extremes, error);
  return extremes;
}

TEST(Words, AreOfTheOutputFormat) {
  EXPECT_EQ(to_string(AttributeKind::coverage), "coverage");
  EXPECT_EQ(to_string(AttributeKind::depth), "depth");
  EXPECT_EQ(to_string(AttributeKind::smooth), "smooth");
  EXPECT_EQ(to_string(AttributeKind::noperspective), "noperspective");
  EXPECT_EQ(to_string(AttributeKind::flat), "flat");
  EXPECT_EQ(to_string(FragmentClass::correct), "correct");
  EXPECT_EQ(to_string(FragmentClass::beyond_bound), "beyond bound");
  EXPECT_EQ(to_string(FragmentClass::missing), "missing");
  EXPECT_EQ(to_string(FragmentClass::extra), "extra");
  EXPECT_EQ(to_string(FragmentClass::wrong_triangle), "wrong triangle");
  EXPECT_EQ(to_string(FragmentClass::not_a_number), "not a number");
  EXPECT_EQ(to_string(FragmentClass::infinite), "infinite");
  EXPECT_EQ(to_string(FragmentClass::wrong_sign_of_zero), "wrong sign of zero");
  EXPECT_EQ(to_string(Stratum::clipped), "clipped");
  EXPECT_EQ(to_string(Stratum::near_horizon), "near horizon");
  EXPECT_EQ(to_string(Stratum::sliver), "sliver");
  EXPECT_EQ(to_string(Stratum::multisampled), "multisampled");
  EXPECT_EQ(to_string(Stratum::ordinary), "ordinary");
}

TEST(Extremes, OfErrorsOnOneSideLeaveTheOtherEmpty) {
  EXPECT_EQ(extremes_of({}), Extremes());
  const WorstError above = error_of({0.5, 0.5});
  EXPECT_EQ(extremes_of({above}), (Extremes{std::nullopt, above}));
  const WorstError below = error_of({-0.5, -0.5});
  EXPECT_EQ(extremes_of({below}), (Extremes{below, std::nullopt}));
}

// Kills: >= 0 instead of > 0, which would show "no error" as the worst one.
TEST(Extremes, AnErrorOfZeroIsOnNeitherSide) {
  EXPECT_EQ(extremes_of({error_of({0, 0})}), Extremes());
  EXPECT_EQ(extremes_of({error_of({-0.0, -0.0})}), Extremes());
}

TEST(Extremes, AnEnclosureOfBothSignsIsOnBothSides) {
  const WorstError error = error_of({-1, 2});
  EXPECT_EQ(extremes_of({error}), (Extremes{error, error}));
}

// Kills: comparing the wrong ends; choosing the smaller magnitude.
TEST(Extremes, TheLargerMagnitudeWins) {
  const WorstError small = error_of({0.25, 0.25});
  const WorstError large = error_of({3, 3});
  const WorstError deep = error_of({-7, -7});
  const WorstError shallow = error_of({-1, -1});
  const Extremes expected{deep, large};
  EXPECT_EQ(extremes_of({small, large, deep, shallow}), expected);
  EXPECT_EQ(extremes_of({shallow, deep, large, small}), expected);
}

TEST(Extremes, OfEqualFarEndsTheLargerNearEndWins) {
  const WorstError wide = error_of({1, 2});
  const WorstError narrow = error_of({1.5, 2});
  EXPECT_EQ(extremes_of({wide, narrow}).most_positive, narrow);
  EXPECT_EQ(extremes_of({narrow, wide}).most_positive, narrow);
  const WorstError wide_below = error_of({-2, -1});
  const WorstError narrow_below = error_of({-2, -1.5});
  EXPECT_EQ(extremes_of({wide_below, narrow_below}).most_negative, narrow_below);
  EXPECT_EQ(extremes_of({narrow_below, wide_below}).most_negative, narrow_below);
}

std::string records_to_text(const RecordSet& records) { return cases::json_of(records).dump(); }

/// Changes an error so that it comes earlier or later in the order of places.
using Change = std::function<void(WorstError&)>;

// Kills: leaving a member out of the order, or exchanging two of them.
TEST(Extremes, OfEqualErrorsTheFirstPlaceWins) {
  // In the order of comparison; each pair sets an earlier and a later value.
  const std::vector<std::pair<Change, Change>> members{
      {[](WorstError& e) { e.case_index = 4; }, [](WorstError& e) { e.case_index = 6; }},
      {[](WorstError& e) { e.case_name = "a"; }, [](WorstError& e) { e.case_name = "z"; }},
      {[](WorstError& e) { e.place.triangle = 4; }, [](WorstError& e) { e.place.triangle = 6; }},
      {[](WorstError& e) { e.place.y = 4; }, [](WorstError& e) { e.place.y = 6; }},
      {[](WorstError& e) { e.place.x = 4; }, [](WorstError& e) { e.place.x = 6; }},
      {[](WorstError& e) { e.place.sample = 4; }, [](WorstError& e) { e.place.sample = 6; }},
      {[](WorstError& e) { e.attribute = std::nullopt; }, [](WorstError& e) { e.attribute = 6; }},
      {[](WorstError& e) { e.exact = "4"; }, [](WorstError& e) { e.exact = "6"; }},
      {[](WorstError& e) { e.actual = 4; }, [](WorstError& e) { e.actual = 6; }},
  };
  for (std::size_t i = 0; i < members.size(); ++i) {
    // This error is earlier in member i, and later in all members that are compared after it.
    WorstError first = error_of({1, 1});
    members[i].first(first);
    for (std::size_t j = i + 1; j < members.size(); ++j) members[j].second(first);
    WorstError second = error_of({1, 1});
    members[i].second(second);
    EXPECT_EQ(extremes_of({first, second}).most_positive, first) << i;
    EXPECT_EQ(extremes_of({second, first}).most_positive, first) << i;
  }
}

TEST(WorstOf, IsTheLargerOfBothSides) {
  Extremes extremes;
  EXPECT_EQ(worst_of(extremes), nullptr);
  extremes.most_negative.emplace().error = {-2, -2};
  EXPECT_EQ(worst_of(extremes), &*extremes.most_negative);
  extremes.most_positive.emplace().error = {1, 1};
  EXPECT_EQ(worst_of(extremes), &*extremes.most_negative);
  extremes.most_positive->error = {2, 2};
  EXPECT_EQ(worst_of(extremes), &*extremes.most_negative);
  extremes.most_positive->error = {2, 3};
  EXPECT_EQ(worst_of(extremes), &*extremes.most_positive);
  extremes.most_negative.reset();
  EXPECT_EQ(worst_of(extremes), &*extremes.most_positive);
}

TEST(IsFrozen, IsOfTheCorpusAndOfRandomCases) {
  const auto is = [](const std::string& stratum) {
    return is_frozen({"a law", "cpu", AttributeKind::depth, stratum});
  };
  EXPECT_TRUE(is("corpus"));
  EXPECT_TRUE(is("random triangles"));
  EXPECT_FALSE(is("saved"));
  EXPECT_FALSE(is("known"));
  EXPECT_FALSE(is("scene bunny"));
}

TEST(MayKeep, AsksWithTheEnclosureAlone) {
  const Extremes extremes = extremes_of({error_of({-2, -2}), error_of({3, 3})});
  EXPECT_TRUE(may_keep(extremes, {4, 4}));
  EXPECT_TRUE(may_keep(extremes, {3, 3}));  // the place may decide
  EXPECT_FALSE(may_keep(extremes, {2, 2}));
  EXPECT_TRUE(may_keep(extremes, {-2, -2}));
  EXPECT_FALSE(may_keep(extremes, {-1, -1}));
  EXPECT_FALSE(may_keep(Extremes(), {0, 0}));
  EXPECT_TRUE(may_keep(Extremes(), {-1, -1}));
}

// Kills: a may_keep that is stricter than keep, which would lose extremes.
RC_GTEST_PROP(MayKeep, IsTrueOfAllThatChangeTheExtremes, ()) {
  Extremes extremes;
  for (int i = 0; i < 6; ++i) {
    const WorstError error = random_worst();
    const Extremes before = extremes;
    keep(extremes, error);
    if (!may_keep(before, error.error)) RC_ASSERT(extremes == before);
  }
}

TEST(Add, CountsGoToCoverageAndErrorsToTheirKinds) {
  Judgement judgement;
  judgement.counts = {1, 2, 3, 4};
  judgement.errors[AttributeKind::coverage].classes[FragmentClass::missing] = 5;
  judgement.errors[AttributeKind::depth].classes[FragmentClass::correct] = 6;
  judgement.levels = {{1, 2, 3}, {4, 0, 5}};
  RecordSet records;
  add(records, {"law", "cpu", AttributeKind::flat, "all"}, judgement);
  add(records, {"law", "cpu", AttributeKind::flat, "all"}, judgement);

  ASSERT_EQ(records.size(), 2U);
  const Record& coverage = records.at({"law", "cpu", AttributeKind::coverage, "all"});
  EXPECT_EQ(coverage.counts, (Counts{2, 4, 6, 8}));
  EXPECT_EQ(coverage.errors.classes[FragmentClass::missing], 10U);
  EXPECT_EQ(coverage.levels, (Levels{{2, 4, 6}, {8, 0, 10}}));
  const Record& depth = records.at({"law", "cpu", AttributeKind::depth, "all"});
  EXPECT_EQ(depth.counts, Counts());
  EXPECT_EQ(depth.levels, Levels());
  EXPECT_EQ(depth.errors.classes[FragmentClass::correct], 12U);
}

// Adding judgements one by one gives the same as adding them merged. Kills: a merge that forgets
// levels.
RC_GTEST_PROP(Add, OfMergedJudgementsIsAddingBoth, ()) {
  Judgement a;
  a.levels = {random_levels(), random_levels()};
  a.errors[AttributeKind::smooth].strata[random_stratum()].sum = random_sum();
  a.errors[AttributeKind::smooth].stages[random_stratum()][random_stage()] = random_sum();
  Judgement b;
  b.levels = {random_levels(), random_levels()};
  b.errors[AttributeKind::smooth].strata[random_stratum()].sum = random_sum();
  b.errors[AttributeKind::smooth].stages[random_stratum()][random_stage()] = random_sum();
  RecordSet one_by_one;
  add(one_by_one, {}, a);
  add(one_by_one, {}, b);
  merge(a, b);
  RecordSet at_once;
  add(at_once, {}, a);
  RC_ASSERT(one_by_one == at_once);
  RC_ASSERT(at_once[{}].levels == a.levels);
}

TEST(Merge, AddsStrataOneByOne) {
  ErrorStatistics a;
  a.strata[Stratum::sliver].histogram.add(1);
  a.strata[Stratum::sliver].sum.add({1, 1});
  a.strata[Stratum::clipped].sum.add({2, 2});
  keep(a.strata[Stratum::sliver].extremes, error_of({1, 1}));
  ErrorStatistics b;
  b.strata[Stratum::sliver].histogram.add(3);
  b.strata[Stratum::sliver].sum.add({-3, -3});
  b.strata[Stratum::ordinary].sum.add({4, 4});
  keep(b.strata[Stratum::sliver].extremes, error_of({-3, -3}));
  merge(a, b);
  ASSERT_EQ(a.strata.size(), 3U);
  const ErrorSizes& sliver = a.strata.at(Stratum::sliver);
  EXPECT_EQ(sliver.histogram.count(), 2U);
  EXPECT_EQ(sliver.extremes, extremes_of({error_of({1, 1}), error_of({-3, -3})}));
  const SignedSum::Units unit = SignedSum::Units{1} << 32;
  EXPECT_EQ(sliver.sum, SignedSum(-2 * unit, -2 * unit, 2, 0));
  EXPECT_EQ(a.strata.at(Stratum::clipped).sum, SignedSum(2 * unit, 2 * unit, 1, 0));
  EXPECT_EQ(a.strata.at(Stratum::ordinary).sum, SignedSum(4 * unit, 4 * unit, 1, 0));
}

TEST(Merge, AddsStagesOneByOne) {
  ErrorStatistics a;
  a.stages[Stratum::sliver][Stage::weights].add({1, 1});
  a.stages[Stratum::clipped][Stage::snap].add({2, 2});
  ErrorStatistics b;
  b.stages[Stratum::sliver][Stage::weights].add({3, 3});
  b.stages[Stratum::sliver][Stage::rounding].add({0.5, 0.5});
  merge(a, b);
  const SignedSum::Units unit = SignedSum::Units{1} << 32;
  using Sums = std::map<Stage, SignedSum>;
  EXPECT_EQ(a.stages,
            (std::map<Stratum, Sums>{
                {Stratum::sliver,
                 {{Stage::weights, SignedSum(4 * unit, 4 * unit, 2, 0)},
                  {Stage::rounding, SignedSum(unit / 2, unit / 2, 1, 0)}}},
                {Stratum::clipped, {{Stage::snap, SignedSum(2 * unit, 2 * unit, 1, 0)}}}}));
}

// Kills: a merge that forgets a member.
TEST(Merge, AddsEveryCount) {
  Record a;
  a.cases = {1, 2, 3};
  a.counts = {4, 5, 6, 7};
  a.errors.classes.counts = {1, 2, 3, 4, 5, 6, 7, 8};
  a.errors.excess.histogram.add(1);
  a.errors.excess.histogram.add_non_finite(3);
  a.errors.excess.sum = {-5, 6, 7, 8};
  a.labels = {{"tie", 1}, {"clipped", 2}};
  a.levels = {{1, 2, 3}, {4, 5, 6}};
  a.power = {{Defect::crack, {5, 2}}, {Defect::depth_90, {1, 1}}};
  Record b = a;
  b.power = {{Defect::crack, {7, 7}}, {Defect::depth_nan, {2, 0}}};
  b.labels = {{"tie", 10}, {"w <= 0", 3}};
  merge(a, b);
  EXPECT_EQ(a.cases, (CaseCounts{2, 4, 6}));
  EXPECT_EQ(a.counts, (Counts{8, 10, 12, 14}));
  EXPECT_EQ(a.errors.classes.counts, (std::array<std::uint64_t, 8>{2, 4, 6, 8, 10, 12, 14, 16}));
  EXPECT_EQ(a.errors.excess.histogram.count(), 2U);
  EXPECT_EQ(a.errors.excess.histogram.non_finite(), 6U);
  EXPECT_EQ(a.errors.excess.sum, SignedSum(-10, 12, 14, 16));
  EXPECT_EQ(a.labels,
            (std::map<std::string, std::uint64_t>{{"tie", 11}, {"clipped", 2}, {"w <= 0", 3}}));
  EXPECT_EQ(a.levels, (Levels{{2, 4, 6}, {8, 10, 12}}));
  EXPECT_EQ(
      a.power,
      (Power{{Defect::crack, {12, 9}}, {Defect::depth_90, {1, 1}}, {Defect::depth_nan, {2, 0}}}));
  EXPECT_EQ(total(a.power), (Noticed{15, 10}));
}

TEST(Merge, KeepsRecordsOfDifferentKeysApart) {
  RecordSet a;
  a[{"law", "cpu", AttributeKind::depth, "s"}].cases.checked = 1;
  RecordSet b;
  b[{"law 2", "cpu", AttributeKind::depth, "s"}].cases.checked = 1;
  b[{"law", "gl", AttributeKind::depth, "s"}].cases.checked = 1;
  b[{"law", "cpu", AttributeKind::flat, "s"}].cases.checked = 1;
  b[{"law", "cpu", AttributeKind::depth, "t"}].cases.checked = 1;
  merge(a, b);
  EXPECT_EQ(a.size(), 5U);
  for (const auto& [key, record] : a) EXPECT_EQ(record.cases.checked, 1U);
}

RC_GTEST_PROP(Merge, WithNothingChangesNothing, ()) {
  const RecordSet records = records_of(random_observations());
  RC_ASSERT(merged(records, {}) == records);
  RC_ASSERT(merged({}, records) == records);
}

// Kills: "the later one wins" among equal extremes.
RC_GTEST_PROP(Merge, IsCommutative, ()) {
  const RecordSet a = records_of(random_observations());
  const RecordSet b = records_of(random_observations());
  RC_ASSERT(records_to_text(merged(a, b)) == records_to_text(merged(b, a)));
}

RC_GTEST_PROP(Merge, IsAssociative, ()) {
  const RecordSet a = records_of(random_observations());
  const RecordSet b = records_of(random_observations());
  const RecordSet c = records_of(random_observations());
  RC_ASSERT(records_to_text(merged(merged(a, b), c)) == records_to_text(merged(a, merged(b, c))));
}

// Kills: ties decided by the order of arrival; members missing from the order.
RC_GTEST_PROP(Merge, OfAnySplitGivesTheSameBytes, ()) {
  const std::vector<Observation> observations = random_observations();
  // Every observation goes to a random part, where the order is kept. The parts are merged in any
  // order.
  const auto part_count = *rc::gen::inRange<std::size_t>(1, 5);
  std::vector<RecordSet> parts(part_count);
  for (const Observation& observation : observations) {
    const auto part = *rc::gen::inRange<std::size_t>(0, part_count);
    add(parts[part], observation);
  }
  while (parts.size() > 1) {
    const auto from = *rc::gen::inRange<std::size_t>(0, parts.size());
    const RecordSet taken = std::move(parts[from]);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(from));
    const auto into = *rc::gen::inRange<std::size_t>(0, parts.size());
    merge(parts[into], taken);
  }
  RC_ASSERT(records_to_text(parts.front()) == records_to_text(records_of(observations)));
}

}  // namespace
}  // namespace rastercheck::records::record_test
