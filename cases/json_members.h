#pragma once

// Records as JSON, by one list of their members that serves both directions and strict keys:
//
//   template <typename Archive, cases::Either<ShardNumber> Number>
//   void members(Archive& archive, Number& number) {
//     archive.required("index", number.index);
//     archive.required("count", number.count);
//   }
//
// A member may be a bool, an integer, a double, a text, an enumerator with a name (names.h), a list
// or a std::optional of these, or another record that has such a list.

#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cases/json_node.h"
#include "cases/names.h"

namespace rastercheck::cases {

/// T, that may be const.
template <typename T, typename Plain>
concept Either = std::same_as<std::remove_const_t<T>, Plain>;

/// A whole number.
template <typename T>
constexpr bool kIsNumber = std::integral<T> && !std::same_as<T, bool>;

class JsonWriter;
class JsonReader;

template <typename T>
concept HasMembers = requires(JsonWriter& writer, const T& value) {
  members(writer, value);
};

// --- Writing -------------------------------------------------------------------------------------

void write_value(nlohmann::json& to, bool value);
void write_value(nlohmann::json& to, std::int64_t value);
void write_value(nlohmann::json& to, std::uint64_t value);
void write_value(nlohmann::json& to, double value);
void write_value(nlohmann::json& to, std::string_view value);
inline void write_value(nlohmann::json& to, const std::string& value) {
  write_value(to, std::string_view(value));
}
/// Gives the member of that key of an object; appends an element to an array.
nlohmann::json& member_of(nlohmann::json& object, std::string_view key);
nlohmann::json& element_of(nlohmann::json& array);
/// Makes it an empty object, or an empty array.
void make_object(nlohmann::json& to);
void make_array(nlohmann::json& to);

class JsonWriter {
 public:
  explicit JsonWriter(nlohmann::json& object) : object_(&object) { make_object(object); }

  template <typename T>
  void required(std::string_view key, const T& value) {
    write(member_of(*object_, key), value);
  }
  /// Leaves the key out if the value is the usual one.
  template <typename T>
  void optional(std::string_view key, const T& value, const std::type_identity_t<T>& usual = {}) {
    if (!(value == usual)) required(key, value);
  }

 private:
  template <typename T>
  static void write(nlohmann::json& to, const T& value) {
    if constexpr (HasMembers<T>) {
      JsonWriter writer(to);
      members(writer, value);
    } else if constexpr (kIsNumber<T> && std::unsigned_integral<T>) {
      write_value(to, std::uint64_t{value});
    } else if constexpr (kIsNumber<T>) {
      write_value(to, std::int64_t{value});
    } else if constexpr (std::is_enum_v<T>) {
      write_value(to, name_of(value));
    } else {
      write_value(to, value);
    }
  }
  template <typename T>
  static void write(nlohmann::json& to, const std::optional<T>& value) {
    write(to, *value);
  }
  template <typename T>
  static void write(nlohmann::json& to, const std::vector<T>& values) {
    make_array(to);
    for (const T& value : values) write(element_of(to), value);
  }

  nlohmann::json* object_;
};

/// Writes a record as an object.
template <HasMembers T>
void write_members(nlohmann::json& to, const T& record) {
  JsonWriter writer(to);
  members(writer, record);
}

// --- Reading -------------------------------------------------------------------------------------

/// The keys that a record has.
class JsonKeys {
 public:
  template <typename T>
  void required(std::string_view key, const T& /*value*/) {
    required_.push_back(key);
  }
  template <typename T>
  void optional(std::string_view key, const T& /*value*/,
                const std::type_identity_t<T>& /*usual*/ = {}) {
    optional_.push_back(key);
  }
  void expect(const JsonNode& node) const { node.expect_object(required_, optional_); }

 private:
  std::vector<std::string_view> required_;
  std::vector<std::string_view> optional_;
};

inline void read_value(const JsonNode& node, bool& value) { value = node.boolean(); }
inline void read_value(const JsonNode& node, double& value) { value = node.float64(); }
inline void read_value(const JsonNode& node, std::string& value) { value = node.text(); }

class JsonReader {
 public:
  explicit JsonReader(const JsonNode& node) : node_(&node) {}

  template <typename T>
  void required(std::string_view key, T& value) {
    if (!node_->failed()) read((*node_)[key], value);
  }
  template <typename T>
  void optional(std::string_view key, T& value, const std::type_identity_t<T>& usual = {}) {
    if (node_->has(key)) {
      required(key, value);
    } else {
      value = usual;
    }
  }

  template <typename T>
  static void read(const JsonNode& node, T& value) {
    if constexpr (HasMembers<T>) {
      JsonKeys keys;
      members(keys, value);
      keys.expect(node);
      JsonReader reader(node);
      if (!node.failed()) members(reader, value);
    } else if constexpr (kIsNumber<T> && std::unsigned_integral<T>) {
      value = node.count<T>();
    } else if constexpr (kIsNumber<T>) {
      value = static_cast<T>(
          node.integer(std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
    } else if constexpr (std::is_enum_v<T>) {
      value = node.enumerator<T>();
    } else {
      read_value(node, value);
    }
  }
  template <typename T>
  static void read(const JsonNode& node, std::optional<T>& value) {
    read(node, value.emplace());
  }
  template <typename T>
  static void read(const JsonNode& node, std::vector<T>& values) {
    values.clear();
    for (const JsonNode& element : node.elements()) {
      if (node.failed()) return;
      read(element, values.emplace_back());
    }
  }

 private:
  const JsonNode* node_;
};

/// Reads a record from an object. Refuses unknown and missing keys.
template <HasMembers T>
T read_members(const JsonNode& node) {
  T record{};
  JsonReader::read(node, record);
  return record;
}

}  // namespace rastercheck::cases
