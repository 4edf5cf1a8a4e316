#pragma once

// Reading a parsed document strictly: every value knows its place, and what is wrong with it is an
// error with file, JSON pointer and reason.

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

/// One value of a document by parse_json, with its place. Reading goes on after an error, on
/// neutral values, so that decoding reads as the format does; only the first error is kept.
///
/// Nodes refer to the document, the error and the file name they are made with, which must outlive
/// them.
class JsonNode {
 public:
  /// `pointer` is the value's JSON pointer in `file`, "" for the document itself.
  JsonNode(const nlohmann::json& value, std::string pointer, std::optional<Error>& error,
           const std::string& file)
      : value_(&value), pointer_(std::move(pointer)), error_(&error), file_(&file) {}

  /// Records an error of this value, unless there already is one.
  void refuse(std::string reason) const;
  bool failed() const { return error_->has_value(); }

  /// Refuses anything but an object with all of `required` and nothing beyond `optional`.
  void expect_object(std::initializer_list<std::string_view> required,
                     std::initializer_list<std::string_view> optional = {}) const {
    expect_object(Keys(required.begin(), required.size()), Keys(optional.begin(), optional.size()));
  }
  using Keys = std::span<const std::string_view>;
  void expect_object(Keys required, Keys optional) const;
  /// Refuses an object whose key "format", if it has one, says something else.
  void expect_format(std::string_view format) const;
  bool has(std::string_view key) const;
  /// The member of that key; a null value where there is none.
  JsonNode operator[](std::string_view key) const;
  /// An object's keys in alphabetical order; none of anything else, which is refused.
  std::vector<std::string> keys() const;

  /// The elements of an array; none of anything else, which is refused.
  std::vector<JsonNode> elements() const;
  /// The elements of an array of `least` to `most`, both inclusive; none of another.
  std::vector<JsonNode> elements(std::size_t least, std::size_t most, std::string_view what) const;
  /// The two elements of an array of two.
  std::pair<JsonNode, JsonNode> two_elements(std::string_view what) const;

  bool is_string() const;
  std::string text() const;
  bool boolean() const;

  /// The enumerator whose name (names.h) it is.
  template <typename Enum>
  Enum enumerator() const {
    return static_cast<Enum>(index_in(names_of(Enum{})));
  }

  /// Integers from `least` to `most`, both inclusive. Integral floats such as 64.0 are integers,
  /// as far as doubles count exactly.
  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  std::uint64_t unsigned_integer() const;

  /// An integer from 0 to `most`, written as one.
  template <typename Unsigned = std::uint64_t>
  Unsigned count(Unsigned most = std::numeric_limits<Unsigned>::max()) const {
    return static_cast<Unsigned>(count_up_to(most));
  }
  /// An object whose members all are counts.
  std::map<std::string, std::uint64_t> counts_by_name() const;

  /// A float32: a number that is exactly one, or the text of a hex float.
  float float32() const;
  /// The same from `least` to `most`, both inclusive.
  float float32(float least, float most) const;
  /// A float32 as the text of a hex float.
  float hex_float32() const;
  /// A double, or "inf" or "-inf". A whole number must be one that doubles count exactly.
  double float64() const;

 private:
  std::size_t index_in(std::span<const std::string_view> names) const;
  std::uint64_t count_up_to(std::uint64_t most) const;
  JsonNode element(std::size_t i) const;

  const nlohmann::json* value_;
  std::string pointer_;
  std::optional<Error>* error_;
  const std::string* file_;
};

/// Parses a text (json.h) and gives its root to `read`; the first error of either. `file` is the
/// name for errors.
Result<void> visit_json(std::string_view text, const std::string& file,
                        const std::function<void(const JsonNode& root)>& read);

/// The same, and what `read` makes of it.
template <typename Read>
auto read_json(std::string_view text, const std::string& file, const Read& read)
    -> Result<std::invoke_result_t<Read, const JsonNode&>> {
  std::invoke_result_t<Read, const JsonNode&> value{};
  return visit_json(text, file, [&](const JsonNode& root) { value = read(root); }).map([&value] {
    return std::move(value);
  });
}

/// How a double stands in a document that float64() reads: a number, or "inf" or "-inf".
nlohmann::json float64_to_json(double value);

}  // namespace rastercheck::cases
