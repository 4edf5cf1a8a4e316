#include "records/record_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "records/enclosure_json.h"
#include "records/internal/shared_members.h"

namespace rastercheck::records {
namespace {

using cases::Either;
using cases::JsonNode;
using nlohmann::json;

}  // namespace

// --- Types with their own form -------------------------------------------------------------------

void write_value(json& to, const Histogram& histogram) {
  json buckets = json::array();
  for (std::size_t bucket = 0; bucket < Histogram::kBucketCount; ++bucket) {
    const std::uint64_t count = histogram.count_in(bucket);
    if (count > 0) buckets.push_back(json::array({bucket, count}));
  }
  to = {{"buckets", std::move(buckets)}, {"non_finite", histogram.non_finite()}};
}

void read_value(const JsonNode& node, Histogram& histogram) {
  histogram = {};
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
}

namespace {

/// Reads an integer from decimal text, with no sign but '-' and no leading zeros.
SignedSum::Units read_units(const JsonNode& node) {
  // As 10^38 < 2^127, no number of 38 digits overflows; the largest sum, 2^126, has 38 digits.
  constexpr std::size_t kMostDigits = 38;
  const std::string text = node.text();
  const bool is_negative = text.starts_with('-');
  const std::string digits = text.substr(is_negative ? 1 : 0);
  SignedSum::Units units = 0;
  if (digits.size() <= kMostDigits && digits.find_first_not_of("0123456789") == std::string::npos) {
    for (const char digit : digits) units = units * 10 + (digit - '0');
    if (is_negative) units = -units;
  }
  // Also refuses texts from which nothing was read: "" and texts with other characters.
  if (fmt::format("{}", units) != text) {
    node.refuse(fmt::format("must be an integer of at most {} digits, as text", kMostDigits));
  }
  return units;
}

}  // namespace

void write_value(json& to, const SignedSum& sum) {
  to = {{"lo", fmt::format("{}", sum.lo())},
        {"hi", fmt::format("{}", sum.hi())},
        {"count", sum.count()},
        {"beyond", sum.beyond()}};
}

void read_value(const JsonNode& node, SignedSum& sum) {
  node.expect_object({"lo", "hi", "count", "beyond"});
  const SignedSum::Units lo = read_units(node["lo"]);
  const SignedSum::Units hi = read_units(node["hi"]);
  const std::uint64_t count = node["count"].count(SignedSum::kMostTerms);
  if (lo > hi) node.refuse("the lower end must not be above the upper");
  // Merging relies on this check: sums that are larger than their terms allow might overflow.
  const SignedSum::Units most = SignedSum::kMostOfTerm * count;
  if (lo < -most) node["lo"].refuse("is too low for the sum of so few errors");
  if (hi > most) node["hi"].refuse("is too high for the sum of so few errors");
  sum = {lo, hi, count, node["beyond"].count()};
}

// --- Lists of members ----------------------------------------------------------------------------

/// All members but the case, for records that give the case elsewhere.
template <typename Archive, Either<WorstError> T>
void members(Archive& archive, T& worst) {
  archive.required("error", worst.error);
  archive.required("exact", worst.exact);
  archive.required("actual", worst.actual);
  members(archive, worst.place);
  archive.optional("attribute", worst.attribute);
  archive.check([&](const JsonNode& node) {
    if (!std::isfinite(worst.actual)) node["actual"].refuse("must be finite");
  });
}

void write_value(json& to, const WorstError& worst) { cases::write_members(to, worst); }
void read_value(const JsonNode& node, WorstError& worst) { cases::read_members(node, worst); }

/// Each extreme must be on the side of zero that its name says.
template <typename Archive, Either<Extremes> T>
void members(Archive& archive, T& extremes) {
  const auto with_case = [](auto& inner, auto& worst) {
    members(inner, worst);
    inner.object("case", [&](auto& of) {
      of.required("index", worst.case_index);
      of.required("name", worst.case_name);
    });
  };
  archive.optional_object("most_negative", extremes.most_negative, with_case);
  archive.optional_object("most_positive", extremes.most_positive, with_case);
  archive.check([&](const JsonNode& node) {
    const auto& [below, above] = extremes;
    if (below && !(below->error.lo < 0)) node["most_negative"]["error"].refuse("must be negative");
    if (above && !(above->error.hi > 0)) node["most_positive"]["error"].refuse("must be positive");
  });
}

template <typename Archive, Either<ErrorSizes> T>
void members(Archive& archive, T& sizes) {
  archive.required("histogram", sizes.histogram);
  members(archive, sizes.extremes);
  archive.optional("sum", sizes.sum);
}

template <typename Archive, Either<ClassCounts> T>
void members(Archive& archive, T& classes) {
  for (std::size_t i = 0; i < classes.counts.size(); ++i) {
    archive.required(to_string(static_cast<FragmentClass>(i)), classes.counts[i]);
  }
}

template <typename Archive, Either<CaseCounts> T>
void members(Archive& archive, T& cases) {
  archive.required("checked", cases.checked);
  archive.required("not_applicable", cases.not_applicable);
  archive.required("violations", cases.violations);
  archive.optional("known", cases.known);
}

template <typename Archive, Either<Counts> T>
void members(Archive& archive, T& counts) {
  archive.required("required", counts.required);
  archive.required("forbidden", counts.forbidden);
  archive.required("permitted", counts.permitted);
  archive.required("undecided", counts.undecided);
}

template <typename Archive, Either<Levels> T>
void members(Archive& archive, T& levels) {
  archive.optional("samples by filter", levels.samples.filter);
  archive.optional("samples by interval", levels.samples.interval);
  archive.optional("samples by exact numbers", levels.samples.exact);
  archive.optional("values by filter", levels.values.filter);
  archive.optional("values by interval", levels.values.interval);
  archive.optional("values by exact numbers", levels.values.exact);
}

template <typename Archive, Either<Noticed> T>
void members(Archive& archive, T& noticed) {
  archive.required("drawings", noticed.drawings);
  archive.required("noticed", noticed.noticed);
  archive.check([&](const JsonNode& node) {
    if (noticed.noticed > noticed.drawings) {
      node["noticed"].refuse("must not exceed \"drawings\"");
    }
  });
}

void write_value(json& to, const Noticed& noticed) { cases::write_members(to, noticed); }
void read_value(const JsonNode& node, Noticed& noticed) { cases::read_members(node, noticed); }

template <typename Archive, Either<RecordKey> Key, Either<Record> T>
void members(Archive& archive, Key& key, T& record) {
  archive.required("property", key.law);
  archive.required("backend", key.backend);
  archive.required("attribute_kind", key.attribute_kind);
  archive.required("stratum", key.stratum);
  archive.required("cases", record.cases);
  archive.required("counts", record.counts);
  archive.required("classes", record.errors.classes);
  archive.optional_object("not_judged", record.errors.not_judged,
                          [](auto& inner, auto& counts) { inner.entries(counts); });
  archive.required("excess", record.errors.excess);
  archive.required("ideal", record.errors.ideal);
  archive.optional("strata", record.errors.strata);
  archive.optional("stages", record.errors.stages);
  archive.required("labels", record.labels);
  archive.required("decided_at", record.levels);
  archive.optional("known", record.known);
  archive.optional("not_applicable_because", record.not_applicable_because);
  archive.optional_object("power", record.power,
                          [](auto& inner, auto& power) { inner.entries(power); });
}

void write_value(json& to, const RecordSet::value_type& one) {
  cases::write_object(to, [&](auto& archive) { members(archive, one.first, one.second); });
}
void write_value(json& to, const RecordSet& records) { cases::write_entries(to, records); }
void read_value(const JsonNode& node, RecordSet& records) {
  cases::read_entries(node, records, "record with the same property, backend, kind and stratum");
}

}  // namespace rastercheck::records
