// Rows of the accuracy table.

#include "records/accuracy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace rastercheck::records::accuracy_test {
namespace {

using ::testing::HasSubstr;

LawSummary summary_of(std::string_view law, std::string_view backend) {
  LawSummary summary;
  summary.law = law;
  summary.backend = backend;
  return summary;
}

LawSummary coverage_of(std::string_view backend) {
  LawSummary summary = summary_of(kCoverageLaw, backend);
  summary.cases.checked = 7;
  summary.cases.not_applicable = 3;
  summary.cases.violations = 2;
  summary.counts = {.required = 90, .forbidden = 110, .permitted = 1000};
  summary.classes[FragmentClass::missing] = 2;
  summary.classes[FragmentClass::extra] = 3;
  summary.classes[FragmentClass::wrong_triangle] = 1;
  return summary;
}

LawSummary values_of(std::string_view backend) {
  LawSummary summary = summary_of(kValuesLaw, backend);
  summary.cases.checked = 6;
  summary.cases.violations = 1;
  summary.cases.known = 2;
  summary.judged.values = 40;
  summary.judged.not_judged = {{"not promised", 5}, {"without bound", 6}};
  summary.classes[FragmentClass::beyond_bound] = 8;
  summary.classes[FragmentClass::not_a_number] = 3;
  summary.classes[FragmentClass::infinite] = 1;
  Precision clipped;
  clipped.kind = AttributeKind::smooth;
  clipped.stratum = Stratum::clipped;
  clipped.values = 12;
  clipped.min = {-9, -8.5};
  clipped.max = {2, 3};
  clipped.p99 = Enclosure{4, 5};
  summary.precision = {clipped};
  return summary;
}

// Kills: figures of another backend or property; permitted samples that count as decided; an error
// below the exact value that is not the largest.
TEST(Accuracy, IsOfBothProperties) {
  const AccuracyRow row = accuracy_of({coverage_of("gl"), values_of("gl"), coverage_of("cpu"),
                                       values_of("cpu"), summary_of("another", "gl")},
                                      {}, "gl");
  EXPECT_EQ(row.backend, "gl");
  EXPECT_EQ(row.asked, 10U);
  EXPECT_EQ(row.drawn, 6U);
  EXPECT_EQ(row.samples, 200U);
  EXPECT_EQ(row.wrong_samples, 6U);
  EXPECT_EQ(row.values, 40U);
  EXPECT_EQ(row.not_judged, 11U);
  EXPECT_EQ(row.wrong_values, 12U);
  EXPECT_EQ(row.not_numbers, 4U);
  EXPECT_EQ(row.violated, 5U);
  ASSERT_EQ(row.figures.size(), 1U);
  const AccuracyFigure* const figure = row.figure(AttributeKind::smooth, Stratum::clipped);
  ASSERT_NE(figure, nullptr);
  EXPECT_EQ(figure->worst, 9);
  EXPECT_EQ(figure->p99, 5);
  EXPECT_EQ(row.figure(AttributeKind::smooth, std::nullopt), nullptr);
  EXPECT_EQ(row.figure(AttributeKind::depth, Stratum::clipped), nullptr);
}

// Kills: a backend that fails to draw, or draws the farther triangle, and keeps its promise.
TEST(Accuracy, KeepsAPromiseWithoutAnyViolation) {
  LawSummary failing = summary_of(kCoverageLaw, "gl");
  EXPECT_TRUE(accuracy_of({failing}, {}, "gl").keeps_promise());
  failing.cases.violations = 1;
  EXPECT_FALSE(accuracy_of({failing}, {}, "gl").keeps_promise());
  failing.cases = {.checked = 1, .known = 1};
  EXPECT_FALSE(accuracy_of({failing}, {}, "gl").keeps_promise());
}

// Kills: the case of a larger error of depth, or of another backend.
TEST(Accuracy, NamesTheWorstCaseOfSmoothValues) {
  RecordSet records;
  const auto add = [&](const char* backend, AttributeKind kind, double error, const char* name) {
    WorstError worst;
    worst.error = {error, error};
    worst.case_name = name;
    const std::string law(kValuesLaw);
    keep(records[{law, backend, kind, "corpus"}].errors.ideal.extremes, worst);
  };
  add("gl", AttributeKind::smooth, -3, "this");
  add("gl", AttributeKind::smooth, 2, "less");
  add("gl", AttributeKind::depth, 9, "depth");
  add("cpu", AttributeKind::smooth, 8, "theirs");
  EXPECT_EQ(accuracy_of({}, records, "gl").worst_case, "this");
}

TEST(Accuracy, ComesBackFromJson) {
  AccuracyTable table{"0.1.0", 7, {}};
  table.rows = {accuracy_of({coverage_of("gl"), values_of("gl")}, {}, "gl"), AccuracyRow()};
  table.rows[0].date = "2026-11-30";
  table.rows[1].backend = "cpu";
  table.rows[1].frame_time = 0.25;
  table.rows[1].figures = {{AttributeKind::depth, std::nullopt, 3, 0.5, 0.25}};
  const auto read = parse_accuracy(accuracy_json(table), "table.json");
  ASSERT_TRUE(read.has_value()) << to_string(read.error());
  EXPECT_EQ(*read, table);
}

TEST(Accuracy, IsRefusedIfItIsSomethingElse) {
  const auto read = parse_accuracy(R"({"format": "rastercheck-run", "version": 1})", "table.json");
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(to_string(read.error()), HasSubstr("table.json: /format"));
}

}  // namespace
}  // namespace rastercheck::records::accuracy_test
