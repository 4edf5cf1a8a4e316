#include "records/record_json.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "cases/float_text.h"
#include "records/enclosure_json.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using nlohmann::json;

/// The names in "decided_at", and what they are of.
constexpr auto kLevelNames = std::to_array<std::string_view>(
    {"samples by filter", "samples by interval", "samples by exact numbers", "values by filter",
     "values by interval", "values by exact numbers"});
std::array<std::uint64_t*, kLevelNames.size()> counts_of(Levels& levels) {
  auto& [samples, values] = levels;
  return {&samples.filter, &samples.interval, &samples.exact,
          &values.filter,  &values.interval,  &values.exact};
}

// Writing.

}  // namespace

json histogram_to_json(const Histogram& histogram) {
  json buckets = json::array();
  for (std::size_t bucket = 0; bucket < Histogram::kBucketCount; ++bucket) {
    const std::uint64_t count = histogram.count_in(bucket);
    if (count > 0) buckets.push_back(json::array({bucket, count}));
  }
  return {{"buckets", std::move(buckets)}, {"non_finite", histogram.non_finite()}};
}

namespace {

json json_of(const ClassCounts& classes) {
  json object = json::object();
  for (std::size_t i = 0; i < classes.counts.size(); ++i) {
    object[std::string(to_string(static_cast<FragmentClass>(i)))] = classes.counts[i];
  }
  return object;
}

json json_of(const WorstError& worst) {
  json object = error_without_case_to_json(worst);
  object["case"] = {{"index", worst.case_index}, {"name", worst.case_name}};
  return object;
}

}  // namespace

json sum_to_json(const SignedSum& sum) {
  return {{"lo", fmt::format("{}", sum.lo())},
          {"hi", fmt::format("{}", sum.hi())},
          {"count", sum.count()},
          {"beyond", sum.beyond()}};
}

namespace {

json json_of(const ErrorSizes& sizes) {
  json object{{"histogram", histogram_to_json(sizes.histogram)}};
  const Extremes& extremes = sizes.extremes;
  if (extremes.most_negative) object["most_negative"] = json_of(*extremes.most_negative);
  if (extremes.most_positive) object["most_positive"] = json_of(*extremes.most_positive);
  if (sizes.sum != SignedSum()) object["sum"] = sum_to_json(sizes.sum);
  return object;
}

json json_of(const std::map<Stratum, ErrorSizes>& strata) {
  json object = json::object();
  for (const auto& [stratum, sizes] : strata) {
    object[std::string(to_string(stratum))] = json_of(sizes);
  }
  return object;
}

json json_of(const std::map<Stratum, std::map<Stage, SignedSum>>& strata) {
  json object = json::object();
  for (const auto& [stratum, stages] : strata) {
    json& sums = object[std::string(to_string(stratum))] = json::object();
    for (const auto& [stage, sum] : stages) sums[std::string(to_string(stage))] = sum_to_json(sum);
  }
  return object;
}

json json_of(Levels levels) {
  const auto counts = counts_of(levels);
  json object = json::object();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (*counts[i] > 0) object[std::string(kLevelNames[i])] = *counts[i];
  }
  return object;
}

json json_of(const RecordKey& key, const Record& record) {
  const CaseCounts& cases = record.cases;
  const Counts& counts = record.counts;
  json object{{"law", key.law},
              {"backend", key.backend},
              {"attribute_kind", to_string(key.attribute_kind)},
              {"stratum", key.stratum},
              {"cases",
               {{"checked", cases.checked},
                {"not_applicable", cases.not_applicable},
                {"violations", cases.violations}}},
              {"counts",
               {{"required", counts.required},
                {"forbidden", counts.forbidden},
                {"permitted", counts.permitted},
                {"undecided", counts.undecided}}},
              {"classes", json_of(record.errors.classes)},
              {"excess", json_of(record.errors.excess)},
              {"ideal", json_of(record.errors.ideal)},
              {"labels", json(record.labels)},
              {"decided_at", json_of(record.levels)}};
  if (!record.errors.strata.empty()) object["strata"] = json_of(record.errors.strata);
  if (!record.errors.stages.empty()) object["stages"] = json_of(record.errors.stages);
  if (cases.known > 0) object["cases"]["known"] = cases.known;
  if (!record.known.empty()) object["known"] = record.known;
  if (!record.not_applicable_because.empty()) {
    object["not_applicable_because"] = record.not_applicable_because;
  }
  return object;
}

// Reading.

}  // namespace

Histogram histogram_from_json(const JsonNode& node) {
  Histogram histogram;
  node.expect_object({"buckets", "non_finite"});
  histogram.add_non_finite(node["non_finite"].count());
  std::size_t next = 0;  // the least number that the next bucket may have
  for (const JsonNode& entry : node["buckets"].elements()) {
    const auto [number, count] = entry.two_elements("bucket and count");
    const auto bucket = number.count<std::size_t>(Histogram::kBucketCount - 1);
    if (bucket < next) number.refuse("the buckets must be in ascending order");
    histogram.add_to_bucket(bucket, count.count());
    next = bucket + 1;
  }
  return histogram;
}

namespace {

ClassCounts read_classes(const JsonNode& node) {
  constexpr auto kNames = names_of(FragmentClass{});
  ClassCounts classes;
  node.expect_object(std::span(kNames).first(classes.counts.size()), {});
  for (std::size_t i = 0; i < classes.counts.size(); ++i) {
    classes.counts[i] = node[kNames[i]].count();
  }
  return classes;
}

/// All but the case.
WorstError read_error(const JsonNode& node) {
  WorstError worst;
  worst.error = enclosure_from_json(node["error"]);
  worst.exact = node["exact"].text();
  worst.actual = node["actual"].hex_float32();
  worst.place.triangle = node["triangle"].count<std::uint32_t>();
  worst.place.x = node["x"].count<std::uint32_t>();
  worst.place.y = node["y"].count<std::uint32_t>();
  worst.place.sample = node["sample"].count<std::uint32_t>();
  if (node.has("attribute")) worst.attribute = node["attribute"].count<std::uint32_t>();
  return worst;
}

WorstError read_worst(const JsonNode& node) {
  node.expect_object({"error", "exact", "actual", "case", "triangle", "x", "y", "sample"},
                     {"attribute"});
  node["case"].expect_object({"index", "name"});
  WorstError worst = read_error(node);
  worst.case_index = node["case"]["index"].count();
  worst.case_name = node["case"]["name"].text();
  return worst;
}

/// The extremes of a sort of errors, each on the side of zero that its name says.
Extremes read_extremes(const JsonNode& sizes) {
  Extremes extremes;
  if (sizes.has("most_negative")) {
    const JsonNode node = sizes["most_negative"];
    extremes.most_negative = read_worst(node);
    if (!(extremes.most_negative->error.lo < 0)) node["error"].refuse("must be below 0");
  }
  if (sizes.has("most_positive")) {
    const JsonNode node = sizes["most_positive"];
    extremes.most_positive = read_worst(node);
    if (!(extremes.most_positive->error.hi > 0)) node["error"].refuse("must be above 0");
  }
  return extremes;
}

/// A whole number as decimal text: no sign but '-', no leading zeros.
SignedSum::Units read_units(const JsonNode& node) {
  // 10^38 < 2^127, so that no such number overflows, and the largest sum, 2^126, has 38 digits.
  constexpr std::size_t kMostDigits = 38;
  const std::string text = node.text();
  const bool is_negative = text.starts_with('-');
  const std::string digits = text.substr(is_negative ? 1 : 0);
  SignedSum::Units units = 0;
  if (digits.size() <= kMostDigits && digits.find_first_not_of("0123456789") == std::string::npos) {
    for (const char digit : digits) units = units * 10 + (digit - '0');
    if (is_negative) units = -units;
  }
  // Also where nothing was read, as of "" and of what has other characters.
  if (fmt::format("{}", units) != text) {
    node.refuse(fmt::format("must be a whole number of at most {} digits as text", kMostDigits));
  }
  return units;
}

}  // namespace

SignedSum sum_from_json(const JsonNode& node) {
  node.expect_object({"lo", "hi", "count", "beyond"});
  const SignedSum::Units lo = read_units(node["lo"]);
  const SignedSum::Units hi = read_units(node["hi"]);
  const std::uint64_t count = node["count"].count(SignedSum::kMostTerms);
  if (lo > hi) node.refuse("the lower end must not be above the upper");
  // Merging relies on this: sums that no terms have might overflow.
  const SignedSum::Units most = SignedSum::kMostOfTerm * count;
  if (lo < -most) node["lo"].refuse("the sum of so few errors cannot be as low");
  if (hi > most) node["hi"].refuse("the sum of so few errors cannot be as high");
  return {lo, hi, count, node["beyond"].count()};
}

namespace {

ErrorSizes read_sizes(const JsonNode& node) {
  node.expect_object({"histogram"}, {"most_negative", "most_positive", "sum"});
  return {histogram_from_json(node["histogram"]), read_extremes(node),
          node.has("sum") ? sum_from_json(node["sum"]) : SignedSum()};
}

std::map<Stratum, ErrorSizes> read_strata(const JsonNode& node) {
  constexpr auto kNames = names_of(Stratum{});
  node.expect_object({}, kNames);
  std::map<Stratum, ErrorSizes> strata;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (node.has(kNames[i])) strata[static_cast<Stratum>(i)] = read_sizes(node[kNames[i]]);
  }
  return strata;
}

std::map<Stratum, std::map<Stage, SignedSum>> read_stages(const JsonNode& node) {
  constexpr auto kStrata = names_of(Stratum{});
  constexpr auto kStages = names_of(Stage{});
  node.expect_object({}, kStrata);
  std::map<Stratum, std::map<Stage, SignedSum>> strata;
  for (std::size_t i = 0; i < kStrata.size(); ++i) {
    if (!node.has(kStrata[i])) continue;
    const JsonNode stages = node[kStrata[i]];
    stages.expect_object({}, kStages);
    std::map<Stage, SignedSum>& sums = strata[static_cast<Stratum>(i)];
    for (std::size_t k = 0; k < kStages.size(); ++k) {
      if (stages.has(kStages[k])) sums[static_cast<Stage>(k)] = sum_from_json(stages[kStages[k]]);
    }
  }
  return strata;
}

Levels read_levels(const JsonNode& node) {
  node.expect_object({}, kLevelNames);
  Levels levels;
  const auto counts = counts_of(levels);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (node.has(kLevelNames[i])) *counts[i] = node[kLevelNames[i]].count();
  }
  return levels;
}

CaseCounts read_cases(const JsonNode& node) {
  node.expect_object({"checked", "not_applicable", "violations"}, {"known"});
  return {node["checked"].count(), node["not_applicable"].count(), node["violations"].count(),
          node.has("known") ? node["known"].count() : 0};
}

Counts read_counts(const JsonNode& node) {
  node.expect_object({"required", "forbidden", "permitted", "undecided"});
  return {node["required"].count(), node["forbidden"].count(), node["permitted"].count(),
          node["undecided"].count()};
}

RecordKey read_key(const JsonNode& node) {
  return {node["law"].text(), node["backend"].text(),
          node["attribute_kind"].enumerator<AttributeKind>(), node["stratum"].text()};
}

Record read_record(const JsonNode& node) {
  Record record;
  record.cases = read_cases(node["cases"]);
  record.counts = read_counts(node["counts"]);
  record.errors.excess = read_sizes(node["excess"]);
  record.errors.ideal = read_sizes(node["ideal"]);
  record.errors.classes = read_classes(node["classes"]);
  if (node.has("strata")) record.errors.strata = read_strata(node["strata"]);
  if (node.has("stages")) record.errors.stages = read_stages(node["stages"]);
  record.labels = node["labels"].counts_by_name();
  record.levels = read_levels(node["decided_at"]);
  if (node.has("known")) record.known = node["known"].counts_by_name();
  if (node.has("not_applicable_because")) {
    record.not_applicable_because = node["not_applicable_because"].counts_by_name();
  }
  return record;
}

}  // namespace

json error_without_case_to_json(const WorstError& worst) {
  json object{{"error", enclosure_to_json(worst.error)},
              {"exact", worst.exact},
              {"actual", cases::to_hex(worst.actual)},
              {"triangle", worst.place.triangle},
              {"x", worst.place.x},
              {"y", worst.place.y},
              {"sample", worst.place.sample}};
  if (worst.attribute) object["attribute"] = *worst.attribute;
  return object;
}

WorstError error_without_case_from_json(const JsonNode& node) {
  node.expect_object({"error", "exact", "actual", "triangle", "x", "y", "sample"}, {"attribute"});
  return read_error(node);
}

json records_to_json(const RecordSet& records) {
  json array = json::array();
  for (const auto& [key, record] : records) array.push_back(json_of(key, record));
  return array;
}

RecordSet records_from_json(const JsonNode& array) {
  RecordSet records;
  for (const JsonNode& node : array.elements()) {
    node.expect_object({"law", "backend", "attribute_kind", "stratum", "cases", "counts", "classes",
                        "excess", "ideal", "labels", "decided_at"},
                       {"strata", "stages", "known", "not_applicable_because"});
    if (node.failed()) break;
    RecordKey key = read_key(node);
    Record record = read_record(node);
    const bool is_new = records.emplace(std::move(key), std::move(record)).second;
    if (!is_new) node.refuse("a second record of the same law, backend, kind and stratum");
  }
  return records;
}

}  // namespace rastercheck::records
