#include "records/record_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/records/random_record.h"

namespace rastercheck::records::record_json_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Result<RecordSet> read(const std::string& text) {
  return cases::read_json(text, "run.json", &cases::read_as<RecordSet>);
}

WorstError small_worst() {
  WorstError worst;
  worst.error = {-0.1, -0.0625};
  worst.exact = "84/5";
  worst.actual = 0x1.8p-2F;
  worst.case_index = std::numeric_limits<std::uint64_t>::max();
  worst.case_name = "one vertex \"behind\" the eye";
  worst.place.triangle = 1;
  worst.place.x = 2;
  worst.place.y = 3;
  worst.place.sample = 4;
  return worst;
}

/// Records with one record in which every member is set.
RecordSet small_records() {
  Record record;
  record.cases = {7, 1, 2};
  record.counts = {9, 90, 1, 3};
  record.errors.classes.counts = {1, 2, 3, 4, 5, 6, 7, 8};
  record.errors.excess.histogram.add_to_bucket(155, 4);
  record.errors.excess.histogram.add(0);
  record.errors.excess.histogram.add_non_finite(2);
  record.errors.excess.extremes.most_negative = small_worst();
  WorstError above = small_worst();
  above.error = {1, kInfinity};
  above.attribute = 6;
  record.errors.excess.extremes.most_positive = above;
  record.errors.excess.sum = {-7, -5, 3, 4};
  record.errors.ideal.histogram.add_to_bucket(3, 5);
  record.errors.ideal.extremes.most_positive = above;
  ErrorSizes& sliver = record.errors.strata[Stratum::sliver];
  sliver.histogram.add(0);
  // 2^64 and 2^71, which do not fit into 64 bits.
  sliver.sum = {SignedSum::Units{1} << 64, SignedSum::Units{1} << 71, 1, 0};
  record.errors.strata[Stratum::near_horizon].histogram.add(0);
  record.errors.stages[Stratum::sliver][Stage::set_up] = {1, 2, 3, 0};
  record.errors.stages[Stratum::sliver][Stage::left_open] = {0, 0, 0, 4};
  record.labels = {{"tie", 4}};
  record.levels = {{100, 0, 2}, {3, 4, 5}};
  return {{{"law", "cpu", AttributeKind::smooth, "grid"}, record}};
}

// Kills: any change of the format; readers of old files would not notice it.
TEST(RecordsToJson, WritesTheFormat) {
  const json expected = json::parse(R"([{
    "property": "law", "backend": "cpu", "attribute_kind": "smooth", "stratum": "grid",
    "cases": {"checked": 7, "not_applicable": 1, "violations": 2},
    "counts": {"required": 9, "forbidden": 90, "permitted": 1, "undecided": 3},
    "classes": {"correct": 1, "beyond bound": 2, "missing": 3, "extra": 4, "wrong triangle": 5,
                "not a number": 6, "infinite": 7, "wrong sign of zero": 8},
    "excess": {
      "histogram": {"buckets": [[0, 1], [155, 4]], "non_finite": 2},
      "most_negative": {"error": [-0.1, -0.0625], "exact": "84/5", "actual": "0x1.8p-2",
                        "case": {"index": 18446744073709551615,
                                 "name": "one vertex \"behind\" the eye"},
                        "triangle": 1, "x": 2, "y": 3, "sample": 4},
      "most_positive": {"error": [1.0, "inf"], "exact": "84/5", "actual": "0x1.8p-2",
                        "case": {"index": 18446744073709551615,
                                 "name": "one vertex \"behind\" the eye"},
                        "triangle": 1, "x": 2, "y": 3, "sample": 4, "attribute": 6},
      "sum": {"lo": "-7", "hi": "-5", "count": 3, "beyond": 4}},
    "ideal": {"histogram": {"buckets": [[3, 5]], "non_finite": 0},
              "most_positive": {"error": [1.0, "inf"], "exact": "84/5", "actual": "0x1.8p-2",
                                "case": {"index": 18446744073709551615,
                                         "name": "one vertex \"behind\" the eye"},
                                "triangle": 1, "x": 2, "y": 3, "sample": 4, "attribute": 6}},
    "strata": {"near horizon": {"histogram": {"buckets": [[0, 1]], "non_finite": 0}},
               "sliver": {"histogram": {"buckets": [[0, 1]], "non_finite": 0},
                          "sum": {"lo": "18446744073709551616", "hi": "2361183241434822606848",
                                  "count": 1, "beyond": 0}}},
    "stages": {"sliver": {"set-up": {"lo": "1", "hi": "2", "count": 3, "beyond": 0},
                          "left open": {"lo": "0", "hi": "0", "count": 0, "beyond": 4}}},
    "labels": {"tie": 4},
    "decided_at": {"samples by filter": 100, "samples by exact numbers": 2, "values by filter": 3,
                   "values by interval": 4, "values by exact numbers": 5}}])");
  EXPECT_EQ(cases::json_of(small_records()), expected);
  EXPECT_EQ(cases::json_of(RecordSet()), json::array());
}

TEST(RecordsToJson, OrdersRecordsByKey) {
  RecordSet records;
  records[{"b", "cpu", AttributeKind::depth, ""}];
  records[{"a", "gl", AttributeKind::depth, ""}];
  records[{"a", "cpu", AttributeKind::flat, ""}];
  records[{"a", "cpu", AttributeKind::coverage, "z"}];
  records[{"a", "cpu", AttributeKind::coverage, "y"}];
  std::vector<std::string> order;
  for (const json& record : cases::json_of(records)) {
    order.push_back(
        record["property"].get<std::string>() + " " + record["backend"].get<std::string>() + " " +
        record["attribute_kind"].get<std::string>() + " " + record["stratum"].get<std::string>());
  }
  EXPECT_EQ(order, (std::vector<std::string>{"a cpu coverage y", "a cpu coverage z", "a cpu flat ",
                                             "a gl depth ", "b cpu depth "}));
}

TEST(RecordsFromJson, ReadsWhatWasWritten) {
  const RecordSet records = small_records();
  EXPECT_EQ(read(cases::json_of(records).dump()).value(), records);
  EXPECT_EQ(read(cases::json_of(records).dump(2)).value(), records);
  EXPECT_EQ(read("[]").value(), RecordSet());
}

// Records from before sums, strata and stages existed lack these members. Kills: refusing old runs
// and baselines.
TEST(RecordsFromJson, SumsStrataAndStagesMayBeMissing) {
  json array = cases::json_of(small_records());
  array[0].erase("strata");
  array[0].erase("stages");
  array[0]["excess"].erase("sum");
  RecordSet expected = small_records();
  ErrorStatistics& errors = expected.begin()->second.errors;
  errors.strata.clear();
  errors.stages.clear();
  errors.excess.sum = SignedSum();
  EXPECT_EQ(read(array.dump()).value(), expected);
}

// Kills: a range of sums that excludes its ends.
TEST(RecordsFromJson, TakesTheLargestSums) {
  RecordSet records = small_records();
  SignedSum& sum = records.begin()->second.errors.ideal.sum;
  const SignedSum::Units most = SignedSum::kMostOfTerm * SignedSum::kMostTerms;
  sum = {-most, most, SignedSum::kMostTerms, std::numeric_limits<std::uint64_t>::max()};
  json array = cases::json_of(records);
  EXPECT_EQ(array[0]["ideal"]["sum"]["lo"], "-85070591730234615865843651857942052864");
  EXPECT_EQ(read(array.dump()).value(), records);
}

// Kills: leaving out a member; a count converted to a double; too few digits; sums of only 64 bits.
RC_GTEST_PROP(RecordsFromJson, GivesBackAnyRecords, ()) {
  RecordSet records = records_of(random_observations());
  for (auto& [key, record] : records) {
    record.cases.not_applicable = *rc::gen::arbitrary<std::uint64_t>();
    record.counts.undecided = *rc::gen::arbitrary<std::uint64_t>();
    record.errors.excess.histogram.add_to_bucket(7, *rc::gen::arbitrary<std::uint64_t>());
    record.labels[*rc::gen::element<std::string>("", "a/b~c", "\n\"")] = 1;
    WorstError worst = random_worst();
    const double a = any_finite_double();
    const double b = any_finite_double();
    worst.error = {std::min(a, b), std::max(a, b)};
    worst.actual = any_finite_float();
    worst.place.x = *rc::gen::arbitrary<std::uint32_t>();
    keep(record.errors.excess.extremes, worst);
    record.errors.excess.sum = random_sum();
    record.errors.strata[random_stratum()].sum = random_sum();
    record.errors.stages[random_stratum()][random_stage()] = random_sum();
  }
  const std::string text = cases::json_of(records).dump();
  const Result<RecordSet> again = read(text);
  RC_ASSERT(again.has_value());
  RC_ASSERT(again.value() == records);
  RC_ASSERT(cases::json_of(again.value()).dump() == text);
}

// Kills: "%.15g"; dropping the sign of zero.
RC_GTEST_PROP(RecordsFromJson, GivesBackAnyDoubleToTheBit, ()) {
  const double end = any_finite_double();
  WorstError worst;
  worst.error = end > 0 ? Enclosure{-0.0, end} : Enclosure{end, -0.0};
  if (end == 0) worst.error = {-1, end};
  RecordSet records;
  keep(records[{}].errors.excess.extremes, worst);
  const Extremes again = read(cases::json_of(records).dump()).value()[{}].errors.excess.extremes;
  const Enclosure error =
      again.most_positive ? again.most_positive->error : again.most_negative.value().error;
  RC_ASSERT(std::bit_cast<std::uint64_t>(error.lo) == std::bit_cast<std::uint64_t>(worst.error.lo));
  RC_ASSERT(std::bit_cast<std::uint64_t>(error.hi) == std::bit_cast<std::uint64_t>(worst.error.hi));
}

TEST(RecordsFromJson, AWholeNumberMayStandForADouble) {
  json array = cases::json_of(small_records());
  array[0]["excess"]["most_negative"]["error"] = {-3, -2};
  const RecordSet records = read(array.dump()).value();
  EXPECT_EQ(records.begin()->second.errors.excess.extremes.most_negative->error,
            (Enclosure{-3, -2}));
}

/// A fault that must be refused: the value at a place in a good document is replaced.
struct Fault {
  std::string pointer;
  std::string value;  ///< JSON text; empty: the value is removed
  std::string place;
  std::string reason;  ///< part of the expected reason
};

/// Used in the test's name, which would otherwise contain addresses that differ in every run.
void PrintTo(const Fault& fault, std::ostream* out) {
  *out << (fault.value.empty() ? "without " + fault.pointer : fault.pointer + " = " + fault.value);
}

class BadRecords : public ::testing::TestWithParam<Fault> {};

TEST_P(BadRecords, AreRefusedOnOneLineWithTheirPlace) {
  const Fault& fault = GetParam();
  json array = cases::json_of(small_records());
  const json::json_pointer pointer(fault.pointer);
  if (fault.value.empty()) {
    array[pointer.parent_pointer()].erase(pointer.back());
  } else {
    array[pointer] = json::parse(fault.value);
  }
  const Result<RecordSet> records = read(array.dump());
  ASSERT_FALSE(records.has_value());
  EXPECT_EQ(records.error().file, "run.json");
  EXPECT_EQ(records.error().place, fault.place);
  EXPECT_THAT(records.error().reason, HasSubstr(fault.reason));
  EXPECT_THAT(to_string(records.error()), Not(HasSubstr("\n")));
}

const Fault kFaults[] = {
    {"", "7", "/", "must be an array"},
    {"", "{}", "/", "must be an array"},
    {"/0", "null", "/0", "must be an object"},
    {"/0/property", "", "/0", "missing key 'property'"},
    {"/0/property", "3", "/0/property", "must be a string"},
    {"/0/more", "1", "/0/more", "unknown key 'more'"},
    {"/0/a~1b\n", "1", "/0/a~1b\\n", "unknown key 'a/b\\n'"},
    {"/0/attribute_kind", R"("colour")", "/0/attribute_kind", "must be coverage, depth, smooth"},
    {"/0/cases/checked", "-1", "/0/cases/checked", "integer from 0 to 18446744073709551615"},
    {"/0/cases/checked", "1.0", "/0/cases/checked", "must be an integer"},
    {"/0/cases/checked", "1e30", "/0/cases/checked", "must be an integer"},
    {"/0/cases/violations", "", "/0/cases", "missing key 'violations'"},
    {"/0/counts", "[]", "/0/counts", "must be an object"},
    {"/0/counts/required", R"("9")", "/0/counts/required", "must be an integer"},
    {"/0/counts/odd", "1", "/0/counts/odd", "unknown key"},
    {"/0/classes/late", "1", "/0/classes/late", "unknown key 'late'"},
    {"/0/classes/extra", "", "/0/classes", "missing key 'extra'"},
    {"/0/excess/histogram/buckets", "{}", "/0/excess/histogram/buckets", "must be an array"},
    {"/0/excess/histogram/buckets/1", "[155]", "/0/excess/histogram/buckets/1", "array of two"},
    {"/0/excess/histogram/buckets/1/0", "483", "/0/excess/histogram/buckets/1/0", "from 0 to 482"},
    {"/0/excess/histogram/buckets/1/0", "0", "/0/excess/histogram/buckets/1/0", "ascending"},
    {"/0/excess/histogram/non_finite", "null", "/0/excess/histogram/non_finite",
     "must be an integer"},
    {"/0/ideal", "", "/0", "missing key 'ideal'"},
    {"/0/ideal/odd", "1", "/0/ideal/odd", "unknown key 'odd'"},
    {"/0/ideal/histogram/non_finite", "-1", "/0/ideal/histogram/non_finite", "must be an integer"},
    {"/0/labels", "[]", "/0/labels", "must be an object"},
    {"/0/labels/tie", "true", "/0/labels/tie", "must be an integer"},
    {"/0/decided_at", "", "/0", "missing key 'decided_at'"},
    {"/0/decided_at/values by filter", "1.5", "/0/decided_at/values by filter",
     "must be an integer"},
    {"/0/decided_at/samples", "1", "/0/decided_at/samples", "unknown key 'samples'"},
    {"/0/strata", "[]", "/0/strata", "must be an object"},
    {"/0/strata/far", "{}", "/0/strata/far", "unknown key 'far'"},
    {"/0/strata/sliver/histogram", "", "/0/strata/sliver", "missing key 'histogram'"},
    {"/0/strata/sliver/sum/hi", R"("x")", "/0/strata/sliver/sum/hi", "must be an integer"},
    {"/0/stages", "[]", "/0/stages", "must be an object"},
    {"/0/stages/far", "{}", "/0/stages/far", "unknown key 'far'"},
    {"/0/stages/sliver/blur", "{}", "/0/stages/sliver/blur", "unknown key 'blur'"},
    {"/0/stages/sliver/set-up/lo", R"("3")", "/0/stages/sliver/set-up", "must not be above"},
    {"/0/excess/sum", "null", "/0/excess/sum", "must be an object"},
    {"/0/excess/sum/mean", "[-2, -2]", "/0/excess/sum/mean", "unknown key 'mean'"},
    {"/0/excess/sum/beyond", "", "/0/excess/sum", "missing key 'beyond'"},
    {"/0/excess/sum/beyond", "-1", "/0/excess/sum/beyond", "must be an integer"},
    {"/0/excess/sum/count", "18014398509481985", "/0/excess/sum/count", "0 to 18014398509481984"},
    {"/0/excess/sum/lo", "-7", "/0/excess/sum/lo", "must be a string"},
    {"/0/excess/sum/lo", R"("")", "/0/excess/sum/lo", "must be an integer"},
    {"/0/excess/sum/lo", R"("-")", "/0/excess/sum/lo", "must be an integer"},
    {"/0/excess/sum/lo", R"("-0")", "/0/excess/sum/lo", "must be an integer"},
    {"/0/excess/sum/lo", R"("--7")", "/0/excess/sum/lo", "must be an integer"},
    {"/0/excess/sum/lo", R"("-07")", "/0/excess/sum/lo", "must be an integer"},
    {"/0/excess/sum/lo", R"("-7.0")", "/0/excess/sum/lo", "must be an integer"},
    {"/0/excess/sum/lo", R"("-7 ")", "/0/excess/sum/lo", "must be an integer"},
    {"/0/excess/sum/lo", R"("-1000000000000000000000000000000000000000")", "/0/excess/sum/lo",
     "at most 38 digits"},
    {"/0/excess/sum/lo", R"("-4")", "/0/excess/sum", "lower end"},
    {"/0/excess/sum/lo", R"("-14167099448608935641089")", "/0/excess/sum/lo", "too low"},
    {"/0/excess/sum/hi", R"("14167099448608935641089")", "/0/excess/sum/hi", "too high"},
    {"/0/excess/sum/hi", R"("+5")", "/0/excess/sum/hi", "must be an integer"},
    {"/0/excess/most_negative", "null", "/0/excess/most_negative", "must be an object"},
    {"/0/excess/most_negative/case/name", "", "/0/excess/most_negative/case", "missing key 'name'"},
    {"/0/excess/most_negative/error", "[-1]", "/0/excess/most_negative/error", "array of two"},
    {"/0/excess/most_negative/error", "[-1, -2]", "/0/excess/most_negative/error", "lower end"},
    {"/0/excess/most_negative/error", "[1, 2]", "/0/excess/most_negative/error",
     "must be negative"},
    {"/0/excess/most_negative/error/0", "9007199254740993", "/0/excess/most_negative/error/0",
     "not exactly a double"},
    {"/0/excess/most_positive/error", "[-2, 0]", "/0/excess/most_positive/error",
     "must be positive"},
    {"/0/excess/most_positive/error/1", R"("nan")", "/0/excess/most_positive/error/1",
     "must be a number"},
    {"/0/excess/most_positive/actual", "0.5", "/0/excess/most_positive/actual", "must be a string"},
    {"/0/excess/most_positive/actual", R"("0x1.0000001p+0")", "/0/excess/most_positive/actual",
     "hex float"},
    {"/0/excess/most_positive/x", "4294967296", "/0/excess/most_positive/x",
     "from 0 to 4294967295"},
    {"/0/excess/most_positive/attribute", "-1", "/0/excess/most_positive/attribute",
     "must be an integer"},
};

INSTANTIATE_TEST_SUITE_P(RecordsFromJson, BadRecords, ::testing::ValuesIn(kFaults));

// Kills: "the last one wins".
TEST(RecordsFromJson, TwoRecordsOfOneKeyAreRefused) {
  json array = cases::json_of(small_records());
  array.push_back(array[0]);
  const Result<RecordSet> records = read(array.dump());
  ASSERT_FALSE(records.has_value());
  EXPECT_EQ(records.error().place, "/1");
  EXPECT_THAT(records.error().reason, HasSubstr("second record with the same"));
}

TEST(RecordsFromJson, PlacesAreThoseOfTheWholeFile) {
  const auto records = [](const cases::JsonNode& root) {
    return cases::read_as<RecordSet>(root["records"]);
  };
  const auto read = cases::read_json(R"({"records": [{"property": 1}]})", "run.json", records);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().place, "/records/0");
}

}  // namespace
}  // namespace rastercheck::records::record_json_test
