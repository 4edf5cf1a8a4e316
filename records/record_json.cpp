#include "records/record_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "cases/float_text.h"
#include "cases/json.h"

namespace rastercheck::records {
namespace {

using cases::child_pointer;
using cases::printable;
using nlohmann::json;

constexpr std::string_view kInfinityText = "inf";
constexpr std::string_view kMinusInfinityText = "-inf";

// Writing.

json json_of(double value) {
  if (std::isinf(value)) return value > 0 ? kInfinityText : kMinusInfinityText;
  return value;
}

json json_of(const Histogram& histogram) {
  json buckets = json::array();
  for (std::size_t bucket = 0; bucket < Histogram::kBucketCount; ++bucket) {
    const std::uint64_t count = histogram.count_in(bucket);
    if (count > 0) buckets.push_back(json::array({bucket, count}));
  }
  return {{"buckets", std::move(buckets)}, {"non_finite", histogram.non_finite()}};
}

json json_of(const ClassCounts& classes) {
  json object = json::object();
  for (std::size_t i = 0; i < classes.counts.size(); ++i) {
    object[std::string(kFragmentClassWords[i])] = classes.counts[i];
  }
  return object;
}

json json_of(const WorstError& worst) {
  json object{{"error", json::array({json_of(worst.error.lo), json_of(worst.error.hi)})},
              {"exact", worst.exact},
              {"actual", cases::to_hex(worst.actual)},
              {"case", {{"index", worst.case_index}, {"name", worst.case_name}}},
              {"triangle", worst.triangle},
              {"x", worst.x},
              {"y", worst.y},
              {"sample", worst.sample}};
  if (worst.attribute) object["attribute"] = *worst.attribute;
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
              {"histogram", json_of(record.errors.histogram)},
              {"labels", json(record.labels)},
              {"decided_at", json(record.decided_at)}};
  const Extremes& extremes = record.errors.extremes;
  if (extremes.most_negative) object["most_negative"] = json_of(*extremes.most_negative);
  if (extremes.most_positive) object["most_positive"] = json_of(*extremes.most_positive);
  return object;
}

// Reading.

/// One value of the document with its place. Reading goes on after an error, on neutral values, so
/// that the decoding below reads as the format does; only the first error is kept.
class Node {
 public:
  Node(const json& value, std::string pointer, std::optional<Error>& error, const std::string& file)
      : value_(&value), pointer_(std::move(pointer)), error_(&error), file_(&file) {}

  void refuse(std::string reason) const {
    if (failed()) return;
    *error_ = Error{*file_, pointer_.empty() ? "/" : pointer_, std::move(reason)};
  }
  bool failed() const { return error_->has_value(); }

  /// Refuses anything but an object with all of `required` and nothing beyond `optional`.
  void expect_object(std::initializer_list<std::string_view> required,
                     std::initializer_list<std::string_view> optional = {}) const {
    if (!value_->is_object()) return refuse("must be an object");
    for (const auto& [key, member] : value_->items()) {
      const auto is_key = [&name = key](std::string_view known) { return known == name; };
      if (std::none_of(required.begin(), required.end(), is_key) &&
          std::none_of(optional.begin(), optional.end(), is_key)) {
        (*this)[key].refuse(fmt::format("unknown key '{}'", printable(key)));
      }
    }
    for (const std::string_view key : required) {
      if (!has(key)) refuse(fmt::format("missing key '{}'", key));
    }
  }

  bool has(std::string_view key) const { return value_->is_object() && value_->contains(key); }

  Node operator[](std::string_view key) const {
    static const json kMissing;
    return {has(key) ? value_->at(std::string(key)) : kMissing, child_pointer(pointer_, key),
            *error_, *file_};
  }

  /// Calls `take` with every element; anything but an array is refused.
  template <typename Take>
  void for_each_element(const Take& take) const {
    if (!value_->is_array()) return refuse("must be an array");
    for (std::size_t i = 0; i < value_->size() && !failed(); ++i) take(element(i));
  }

  /// The two elements of an array of two.
  std::pair<Node, Node> two_elements(std::string_view what) const {
    if (value_->is_array() && value_->size() == 2) return {element(0), element(1)};
    refuse(fmt::format("must be an array of two: {}", what));
    return {*this, *this};
  }

  std::map<std::string, std::uint64_t> counts_by_name() const {
    std::map<std::string, std::uint64_t> counts;
    if (!value_->is_object()) {
      refuse("must be an object");
      return counts;
    }
    for (const auto& item : value_->items()) counts[item.key()] = (*this)[item.key()].count();
    return counts;
  }

  std::string text() const {
    if (value_->is_string()) return value_->get<std::string>();
    refuse("must be a string");
    return {};
  }

  /// Which of the words it is.
  template <std::size_t N>
  std::size_t word(const std::array<std::string_view, N>& words) const {
    const std::string chosen = text();
    const auto* found = std::find(words.begin(), words.end(), chosen);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    refuse(fmt::format("must be one of '{}'", fmt::join(words, "', '")));
    return 0;
  }

  template <typename Unsigned = std::uint64_t>
  Unsigned count(Unsigned most = std::numeric_limits<Unsigned>::max()) const {
    // A number that was not parsed but put there may be signed, whatever its value.
    if (value_->is_number_unsigned() ||
        (value_->is_number_integer() && value_->get<std::int64_t>() >= 0)) {
      const auto value = value_->get<std::uint64_t>();
      if (value <= most) return static_cast<Unsigned>(value);
    }
    refuse(fmt::format("must be an integer from 0 to {}", most));
    return 0;
  }

  /// A double, or the text of an infinite one.
  double number() const {
    if (*value_ == kInfinityText) return std::numeric_limits<double>::infinity();
    if (*value_ == kMinusInfinityText) return -std::numeric_limits<double>::infinity();
    if (value_->is_number_float()) return value_->get<double>();
    if (value_->is_number_integer()) {
      constexpr double kExactIntegers = 0x1p53;  // up to here each is a double
      const auto value = value_->get<double>();
      if (std::abs(value) < kExactIntegers) return value;
      refuse("not exactly a double: write it with a decimal point or an exponent");
      return 0;
    }
    refuse("must be a number, \"inf\" or \"-inf\"");
    return 0;
  }

  float float_number() const {
    const std::optional<float> value = cases::float_from_hex(text());
    if (!value) refuse("must be the hex float of a float32, such as \"0x1.8p-2\"");
    return value.value_or(0.0F);
  }

 private:
  Node element(std::size_t i) const {
    return {(*value_)[i], child_pointer(pointer_, std::to_string(i)), *error_, *file_};
  }

  const json* value_;
  std::string pointer_;
  std::optional<Error>* error_;
  const std::string* file_;
};

Enclosure read_enclosure(const Node& node) {
  const auto [lo, hi] = node.two_elements("lower and upper end");
  const Enclosure enclosure{lo.number(), hi.number()};
  if (!(enclosure.lo <= enclosure.hi)) node.refuse("the lower end must not be above the upper");
  return enclosure;
}

Histogram read_histogram(const Node& node) {
  Histogram histogram;
  node.expect_object({"buckets", "non_finite"});
  histogram.add_non_finite(node["non_finite"].count());
  std::size_t next = 0;  // the least number that the next bucket may have
  node["buckets"].for_each_element([&](const Node& entry) {
    const auto [number, count] = entry.two_elements("bucket and count");
    const auto bucket = number.count<std::size_t>(Histogram::kBucketCount - 1);
    if (bucket < next) number.refuse("the buckets must be in ascending order");
    histogram.add_to_bucket(bucket, count.count());
    next = bucket + 1;
  });
  return histogram;
}

ClassCounts read_classes(const Node& node) {
  ClassCounts classes;
  for (auto& [word, count] : node.counts_by_name()) {
    const auto* found = std::find(kFragmentClassWords.begin(), kFragmentClassWords.end(), word);
    if (found == kFragmentClassWords.end()) {
      node[word].refuse(fmt::format("unknown key '{}'", printable(word)));
    } else {
      classes.counts[static_cast<std::size_t>(found - kFragmentClassWords.begin())] = count;
    }
  }
  for (const std::string_view word : kFragmentClassWords) {
    if (!node.has(word)) node.refuse(fmt::format("missing key '{}'", word));
  }
  return classes;
}

WorstError read_worst(const Node& node) {
  node.expect_object({"error", "exact", "actual", "case", "triangle", "x", "y", "sample"},
                     {"attribute"});
  node["case"].expect_object({"index", "name"});
  WorstError worst;
  worst.error = read_enclosure(node["error"]);
  worst.exact = node["exact"].text();
  worst.actual = node["actual"].float_number();
  worst.case_index = node["case"]["index"].count();
  worst.case_name = node["case"]["name"].text();
  worst.triangle = node["triangle"].count<std::uint32_t>();
  worst.x = node["x"].count<std::uint32_t>();
  worst.y = node["y"].count<std::uint32_t>();
  worst.sample = node["sample"].count<std::uint32_t>();
  if (node.has("attribute")) worst.attribute = node["attribute"].count<std::uint32_t>();
  return worst;
}

/// The extremes of a record, each on the side of zero that its name says.
Extremes read_extremes(const Node& record) {
  Extremes extremes;
  if (record.has("most_negative")) {
    const Node node = record["most_negative"];
    extremes.most_negative = read_worst(node);
    if (!(extremes.most_negative->error.lo < 0)) node["error"].refuse("must be below 0");
  }
  if (record.has("most_positive")) {
    const Node node = record["most_positive"];
    extremes.most_positive = read_worst(node);
    if (!(extremes.most_positive->error.hi > 0)) node["error"].refuse("must be above 0");
  }
  return extremes;
}

CaseCounts read_cases(const Node& node) {
  node.expect_object({"checked", "not_applicable", "violations"});
  return {node["checked"].count(), node["not_applicable"].count(), node["violations"].count()};
}

Counts read_counts(const Node& node) {
  node.expect_object({"required", "forbidden", "permitted", "undecided"});
  return {node["required"].count(), node["forbidden"].count(), node["permitted"].count(),
          node["undecided"].count()};
}

RecordKey read_key(const Node& node) {
  return {node["law"].text(), node["backend"].text(),
          static_cast<AttributeKind>(node["attribute_kind"].word(kAttributeKindWords)),
          node["stratum"].text()};
}

Record read_record(const Node& node) {
  Record record;
  record.cases = read_cases(node["cases"]);
  record.counts = read_counts(node["counts"]);
  record.errors.histogram = read_histogram(node["histogram"]);
  record.errors.extremes = read_extremes(node);
  record.errors.classes = read_classes(node["classes"]);
  record.labels = node["labels"].counts_by_name();
  record.decided_at = node["decided_at"].counts_by_name();
  return record;
}

}  // namespace

json records_to_json(const RecordSet& records) {
  json array = json::array();
  for (const auto& [key, record] : records) array.push_back(json_of(key, record));
  return array;
}

Result<RecordSet> records_from_json(const json& array, const std::string& file,
                                    const std::string& pointer) {
  std::optional<Error> error;
  RecordSet records;
  Node(array, pointer, error, file).for_each_element([&records](const Node& node) {
    node.expect_object({"law", "backend", "attribute_kind", "stratum", "cases", "counts", "classes",
                        "histogram", "labels", "decided_at"},
                       {"most_negative", "most_positive"});
    if (node.failed()) return;
    RecordKey key = read_key(node);
    Record record = read_record(node);
    const bool is_new = records.emplace(std::move(key), std::move(record)).second;
    if (!is_new) node.refuse("a second record of the same law, backend, kind and stratum");
  });
  if (error) return tl::unexpected(*error);
  return records;
}

}  // namespace rastercheck::records
