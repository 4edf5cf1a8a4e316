#pragma once

// Reads a parsed document strictly: every value knows its place, and every fault becomes an error
// with file, JSON pointer and reason.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cases/error.h"

namespace rastercheck::cases {

/// Whether decimals that are no float32 may be rounded to one, and how many were.
struct DecimalRounding {
  bool is_allowed = false;
  std::uint64_t rounded = 0;
};

/// One value of a document from parse_json, with its place. After an error, reading continues with
/// neutral values, so that decoding code mirrors the format; only the first error is kept.
///
/// The reading must outlive the nodes that refer to it.
class JsonNode {
 public:
  /// A document that is being read, and its first error.
  struct Reading {
    const nlohmann::json& document;
    const std::string& file;
    std::optional<Error> error = {};
  };
  /// The document itself.
  explicit JsonNode(Reading& reading) : value_(&reading.document), reading_(&reading) {}

  /// The same value, but float32() of it and of all values in it may round as `rounding` says,
  /// which must outlive them, and an error names the document's key that allows it: "round".
  JsonNode with(DecimalRounding& rounding) const;

  /// Records an error at this value, unless one is already recorded.
  void refuse(std::string reason) const;
  bool failed() const { return reading_->error.has_value(); }

  /// Refuses anything but an object with all `required` keys and no others beyond `optional`.
  void expect_object(std::initializer_list<std::string_view> required,
                     std::initializer_list<std::string_view> optional = {}) const {
    expect_object(Keys(required.begin(), required.size()), Keys(optional.begin(), optional.size()));
  }
  using Keys = std::span<const std::string_view>;
  void expect_object(Keys required, Keys optional) const;
  /// Refuses an object whose "format" key has another value.
  void expect_format(std::string_view format) const;
  bool has(std::string_view key) const;
  /// The member with that key; a null value if the member is missing.
  JsonNode operator[](std::string_view key) const;
  /// An object's keys in alphabetical order; refuses any other value and returns none.
  std::vector<std::string> keys() const;

  /// The elements of an array; refuses any other value and returns none.
  std::vector<JsonNode> elements() const;
  /// The elements of an array of `least` to `most` elements, both inclusive; refuses any other
  /// value and returns none.
  std::vector<JsonNode> elements(std::size_t least, std::size_t most, std::string_view what) const;
  /// The two elements of an array of exactly two.
  std::pair<JsonNode, JsonNode> two_elements(std::string_view what) const;

  bool is_string() const;
  std::string text() const;
  bool boolean() const;

  /// The enumerator with this name (names.h).
  template <typename Enum>
  Enum enumerator() const {
    return static_cast<Enum>(index_in(names_of(Enum{})));
  }
  /// The same, but only one of the first `count` enumerators.
  template <typename Enum>
  Enum enumerator(std::size_t count) const {
    const auto names = names_of(Enum{});
    return static_cast<Enum>(index_in(std::span(names).first(count)));
  }

  /// An integer from `least` to `most`, both inclusive. Integral floats such as 64.0 count as
  /// integers, up to 2^53 in magnitude, where doubles still hold every integer.
  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  std::uint64_t unsigned_integer() const;

  /// An integer from 0 to `most`, written as an integer.
  template <typename Unsigned = std::uint64_t>
  Unsigned count(Unsigned most = std::numeric_limits<Unsigned>::max()) const {
    return static_cast<Unsigned>(count_up_to(most));
  }
  /// An object whose members are all counts.
  std::map<std::string, std::uint64_t> counts_by_name() const;

  /// A float32: a number that is exactly a float32, or the text of a hex float. With
  /// DecimalRounding, any number within the range of float32, rounded to the nearest.
  float float32() const;
  /// A float32 from `least` to `most`, both inclusive.
  float float32(float least, float most) const;
  /// A float32 as the text of a hex float.
  float hex_float32() const;
  /// A double, or "inf" or "-inf". An integer must be below 2^53 in magnitude, where doubles hold
  /// every integer.
  double float64() const;

 private:
  std::size_t index_in(std::span<const std::string_view> names) const;
  std::uint64_t count_up_to(std::uint64_t most) const;
  /// The value `inner` of this one.
  JsonNode child(const nlohmann::json& inner) const;
  /// The value's JSON pointer in the document; searches for it.
  std::string pointer() const;
  float rounded_float32(double value) const;

  const nlohmann::json* value_;
  Reading* reading_;
  std::string missing_;  ///< the JSON pointer of a missing member; else empty
  DecimalRounding* rounding_ = nullptr;
};

/// Parses a text (json.h) and passes its root to `read`; returns the first error of either. `file`
/// is the name used in errors, `left_out` as in parse_json().
Result<void> visit_json(std::string_view text, const std::string& file,
                        const std::function<void(const JsonNode& root)>& read,
                        JsonNode::Keys left_out = {});

/// Like visit_json(), and returns the result of `read`.
template <typename Read>
auto read_json(std::string_view text, const std::string& file, const Read& read,
               JsonNode::Keys left_out = {})
    -> Result<std::invoke_result_t<Read, const JsonNode&>> {
  std::invoke_result_t<Read, const JsonNode&> value{};
  return visit_json(
             text, file, [&](const JsonNode& root) { value = read(root); }, left_out)
      .map([&value] { return std::move(value); });
}

/// Converts a double to the form that float64() reads: a number, or "inf" or "-inf".
nlohmann::json float64_to_json(double value);

}  // namespace rastercheck::cases
