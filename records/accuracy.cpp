#include "records/accuracy.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/json_document.h"
#include "cases/json_members.h"
#include "cases/json_node.h"

namespace rastercheck::records {

template <typename Archive, cases::Either<AccuracyFigure> T>
void members(Archive& archive, T& figure) {
  archive.required("kind", figure.kind);
  archive.optional("stratum", figure.stratum);
  archive.required("values", figure.values);
  archive.required("worst", figure.worst);
  archive.required("p99", figure.p99);
}

template <typename Archive, cases::Either<AccuracyRow> T>
void members(Archive& archive, T& row) {
  archive.required("backend", row.backend);
  archive.required("drawn_by", row.drawn_by);
  archive.required("date", row.date);
  archive.required("asked", row.asked);
  archive.required("drawn", row.drawn);
  archive.required("violated", row.violated);
  archive.required("samples", row.samples);
  archive.required("wrong_samples", row.wrong_samples);
  archive.required("values", row.values);
  archive.required("not_judged", row.not_judged);
  archive.required("wrong_values", row.wrong_values);
  archive.required("not_numbers", row.not_numbers);
  archive.optional("worst_case", row.worst_case);
  archive.optional("frame_time", row.frame_time);
  archive.required("figures", row.figures);
}

template <typename Archive, cases::Either<AccuracyTable> T>
void members(Archive& archive, T& table) {
  archive.format("rastercheck-accuracy", 1);
  archive.required("program", table.program);
  archive.required("seed", table.seed);
  archive.required("rows", table.rows);
}

namespace {

double upper_end(const std::optional<Enclosure>& enclosure) {
  return enclosure ? enclosure->hi : INFINITY;
}

void add_values(AccuracyRow& row, const LawSummary& summary) {
  row.drawn = summary.cases.checked;
  row.not_numbers =
      summary.classes[FragmentClass::not_a_number] + summary.classes[FragmentClass::infinite];
  row.wrong_values = row.not_numbers + summary.classes[FragmentClass::beyond_bound] +
                     summary.classes[FragmentClass::wrong_sign_of_zero];
  row.values = summary.judged.values;
  for (const auto& [why, count] : summary.judged.not_judged) row.not_judged += count;
  for (const Precision& precision : summary.precision) {
    row.figures.push_back({precision.kind, precision.stratum, precision.values,
                           std::max(-precision.min.lo, precision.max.hi),
                           upper_end(precision.p99)});
  }
}

}  // namespace

const AccuracyFigure* AccuracyRow::figure(AttributeKind kind,
                                          std::optional<Stratum> stratum) const {
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const AccuracyFigure& one) {
    return one.kind == kind && one.stratum == stratum;
  });
  return found == figures.end() ? nullptr : &*found;
}

AccuracyRow accuracy_of(const std::vector<LawSummary>& rows, const RecordSet& records,
                        const std::string& backend) {
  AccuracyRow row;
  row.backend = backend;
  for (const LawSummary& summary : rows) {
    const bool is_of_table = summary.law == kCoverageLaw || summary.law == kValuesLaw;
    if (summary.backend != backend || !is_of_table) continue;
    row.violated += summary.cases.violations + summary.cases.known;
    if (summary.law == kValuesLaw) add_values(row, summary);
    if (summary.law != kCoverageLaw) continue;
    row.asked = summary.cases.checked + summary.cases.not_applicable;
    row.samples = summary.counts.required + summary.counts.forbidden;
    row.wrong_samples = summary.classes[FragmentClass::missing] +
                        summary.classes[FragmentClass::extra] +
                        summary.classes[FragmentClass::wrong_triangle];
  }
  Extremes worst;
  for (const auto& [key, record] : records) {
    const bool is_smooth = key.law == kValuesLaw && key.attribute_kind == AttributeKind::smooth;
    if (is_smooth && key.backend == backend) merge(worst, record.errors.ideal.extremes);
  }
  if (const WorstError* const error = worst_of(worst)) row.worst_case = error->case_name;
  return row;
}

std::string accuracy_json(const AccuracyTable& table) { return cases::document_of(table); }

Result<AccuracyTable> parse_accuracy(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &cases::read_as<AccuracyTable>);
}

}  // namespace rastercheck::records
