#pragma once

// Records as JSON. One list of a record's members serves reading, writing and the check of keys:
//
//   template <typename Archive, cases::Either<ShardNumber> Number>
//   void members(Archive& archive, Number& number) {
//     archive.required("index", number.index);
//     archive.required("count", number.count);
//   }
//
// A member may be a bool, an integer, a double, a float (as hexadecimal text), a text, an
// enumerator with a name (names.h); a list, an array or a std::optional of such values; a map from
// names to such values; another record with a list of members; or a type with its own form,
// declared in the type's namespace:
//
//   void write_value(nlohmann::json& to, const Enclosure& enclosure);
//   void read_value(const cases::JsonNode& node, Enclosure& enclosure);
//
// A record that other files nest must declare this pair in its header; the pair must call
// write_members() and read_members().
//
// Archives have, besides required() and optional():
//
//   archive.format("rastercheck-known", 1);                 "format" and "version" of a document
//   archive.added("origin", one.origin, Origin::random);    always written; older files lack it
//   archive.object("driver", [&](auto& inner) {…});         an object that is no record
//   archive.optional_object("worst", x.worst, [](auto& inner, auto& worst) {…});
//   archive.entries(x.facts);                               a map's entries as members
//   archive.list("cases", x.cases, "case of the same name"); a map as a list (write_entries)
//   archive.check([&](const JsonNode& node) {…});           checks that only a reader makes

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cases/json_node.h"
#include "cases/names.h"

namespace rastercheck::cases {

/// T is Plain, possibly const.
template <typename T, typename Plain>
concept Either = std::same_as<std::remove_const_t<T>, Plain>;

/// T is an integer type other than bool.
template <typename T>
constexpr bool kIsNumber = std::integral<T> && !std::same_as<T, bool>;

class JsonWriter;
class JsonReader;

inline void read_value(const JsonNode& node, bool& value) { value = node.boolean(); }
inline void read_value(const JsonNode& node, double& value) { value = node.float64(); }
inline void read_value(const JsonNode& node, std::string& value) { value = node.text(); }
/// Also accepts "nan", "inf" and "-inf".
void read_value(const JsonNode& node, float& value);

/// A type's own form takes precedence over its list of members, because files that nest a record
/// see only the form.
template <typename T>
concept ReadsItself = requires(const JsonNode& node, std::remove_const_t<T>& value) {
  read_value(node, value);
};

template <typename T>
concept HasMembers = requires(JsonWriter& writer, const T& value) {
  members(writer, value);
};

/// A type that may be a key.
template <typename T>
concept IsName = std::is_enum_v<T> || std::same_as<T, std::string>;
template <IsName Name>
constexpr std::string_view key_of(const Name& name) {
  if constexpr (std::is_enum_v<Name>) {
    return name_of(name);
  } else {
    return name;
  }
}

// --- Writing -------------------------------------------------------------------------------------

void write_value(nlohmann::json& to, bool value);
void write_value(nlohmann::json& to, std::int64_t value);
void write_value(nlohmann::json& to, std::uint64_t value);
void write_value(nlohmann::json& to, double value);
void write_value(nlohmann::json& to, float value);
void write_value(nlohmann::json& to, std::string_view value);
inline void write_value(nlohmann::json& to, const std::string& value) {
  write_value(to, std::string_view(value));
}
template <typename T>
concept WritesItself = requires(nlohmann::json& to, const T& value) {
  write_value(to, value);
};
/// member_of() returns the object's member with that key; element_of() appends an element to the
/// array and returns it.
nlohmann::json& member_of(nlohmann::json& object, std::string_view key);
nlohmann::json& element_of(nlohmann::json& array);
/// Turns `to` into an empty object, or an empty array.
void make_object(nlohmann::json& to);
void make_array(nlohmann::json& to);

/// Writes an object whose members `list` passes to an archive.
template <typename List>
void write_object(nlohmann::json& to, const List& list);
/// Writes a map as a list of objects; members(archive, key, value) lists the members of key and
/// value together.
template <typename Key, typename T>
void write_entries(nlohmann::json& to, const std::map<Key, T>& map);

class JsonWriter {
 public:
  explicit JsonWriter(nlohmann::json& object) : object_(&object) { make_object(object); }

  void format(std::string_view format, std::uint64_t version) {
    required("format", format);
    required("version", version);
  }
  template <typename T>
  void required(std::string_view key, const T& value) {
    write(member_of(*object_, key), value);
  }
  /// Omits the key if the value is `usual`.
  template <typename T>
  void optional(std::string_view key, const T& value, const std::type_identity_t<T>& usual = {}) {
    if (!(value == usual)) required(key, value);
  }
  template <typename T>
  void added(std::string_view key, const T& value, const std::type_identity_t<T>& /*usual*/) {
    required(key, value);
  }
  template <typename List>
  void object(std::string_view key, const List& list) {
    write_object(member_of(*object_, key), list);
  }
  template <typename T, typename List>
  void optional_object(std::string_view key, const std::optional<T>& value, const List& list) {
    if (value) object(key, [&](auto& inner) { list(inner, *value); });
  }
  template <typename T, typename List>
  void optional_object(std::string_view key, const T& value, const List& list) {
    if (!(value == T())) object(key, [&](auto& inner) { list(inner, value); });
  }
  template <typename Key, typename T>
  void list(std::string_view key, const std::map<Key, T>& map, const char* /*what*/) {
    write_entries(member_of(*object_, key), map);
  }
  template <IsName Name, typename T>
  void entries(const std::map<Name, T>& map) {
    for (const auto& [name, value] : map) required(key_of(name), value);
  }
  template <typename Check>
  void check(const Check& /*check*/) {}

  template <typename T>
  static void write(nlohmann::json& to, const T& value) {
    if constexpr (WritesItself<T>) {
      write_value(to, value);
    } else if constexpr (HasMembers<T>) {
      write_object(to, [&](auto& archive) { members(archive, value); });
    } else if constexpr (kIsNumber<T> && std::unsigned_integral<T>) {
      write_value(to, std::uint64_t{value});
    } else if constexpr (kIsNumber<T>) {
      write_value(to, std::int64_t{value});
    } else {
      static_assert(std::is_enum_v<T>, "has neither a list of members nor a form of its own");
      write_value(to, name_of(value));
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
  template <typename T, std::size_t size>
  static void write(nlohmann::json& to, const std::array<T, size>& values) {
    make_array(to);
    for (const T& value : values) write(element_of(to), value);
  }
  template <IsName Name, typename T>
  static void write(nlohmann::json& to, const std::map<Name, T>& map) {
    write_object(to, [&](auto& archive) { archive.entries(map); });
  }

 private:
  nlohmann::json* object_;
};

template <typename List>
void write_object(nlohmann::json& to, const List& list) {
  JsonWriter writer(to);
  list(writer);
}

/// Writes a record by its list, even if it has its own form.
template <typename T>
void write_members(nlohmann::json& to, const T& record) {
  write_object(to, [&](auto& archive) { members(archive, record); });
}

template <typename Key, typename T>
void write_entries(nlohmann::json& to, const std::map<Key, T>& map) {
  make_array(to);
  for (const auto& entry : map) {
    write_object(element_of(to),
                 [&](auto& archive) { members(archive, entry.first, entry.second); });
  }
}

/// Converts any of the values listed above to JSON; do not pass the second template argument.
template <typename T, typename Json = nlohmann::json>
Json json_of(const T& value) {
  Json to;
  JsonWriter::write(to, value);
  return to;
}

// --- Reading -------------------------------------------------------------------------------------

/// Collects the keys of a record.
class JsonKeys {
 public:
  void format(std::string_view format, std::uint64_t version) {
    required_.insert(required_.end(), {"format", "version"});
    format_ = format;
    version_ = version;
  }
  template <typename T>
  void required(std::string_view key, const T& /*value*/) {
    required_.push_back(key);
  }
  template <typename T>
  void optional(std::string_view key, const T& /*value*/,
                const std::type_identity_t<T>& /*usual*/ = {}) {
    optional_.push_back(key);
  }
  template <typename T>
  void added(std::string_view key, const T& /*value*/, const std::type_identity_t<T>& /*usual*/) {
    optional_.push_back(key);
  }
  template <typename List>
  void object(std::string_view key, const List& /*list*/) {
    required_.push_back(key);
  }
  template <typename T, typename List>
  void optional_object(std::string_view key, const T& /*value*/, const List& /*list*/) {
    optional_.push_back(key);
  }
  template <typename Key, typename T>
  void list(std::string_view key, const std::map<Key, T>& /*map*/, const char* /*what*/) {
    required_.push_back(key);
  }
  template <typename Enum, typename T>
  void entries(const std::map<Enum, T>& /*map*/) {
    static constexpr auto kNames = names_of(Enum{});
    optional_.insert(optional_.end(), kNames.begin(), kNames.end());
  }
  template <typename Check>
  void check(const Check& /*check*/) {}

  /// Refuses a document of another format or version first, then unknown and missing keys, so that
  /// a later version is reported as such and not by its keys.
  void expect(const JsonNode& node) const;

 private:
  std::vector<std::string_view> required_;
  std::vector<std::string_view> optional_;
  std::string_view format_;  ///< empty: not checked
  std::uint64_t version_ = 0;
};

/// Reads an object whose members `list` passes to an archive. Refuses unknown and missing keys.
template <typename List>
void read_object(const JsonNode& node, const List& list);
/// Reads the output of write_entries(). Refuses a second entry with the same key as "a second "
/// plus `what`.
template <typename Key, typename T>
void read_entries(const JsonNode& node, std::map<Key, T>& map, const char* what);

class JsonReader {
 public:
  explicit JsonReader(const JsonNode& node) : node_(&node) {}

  void format(std::string_view /*format*/, std::uint64_t /*version*/) {}
  /// Also accepts views of values (UpTo).
  template <typename T>
  void required(std::string_view key, T&& value) {
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
  void added(std::string_view key, T& value, const std::type_identity_t<T>& usual) {
    optional(key, value, usual);
  }
  template <typename List>
  void object(std::string_view key, const List& list) {
    if (!node_->failed()) read_object((*node_)[key], list);
  }
  template <typename T, typename List>
  void optional_object(std::string_view key, std::optional<T>& value, const List& list) {
    if (!node_->has(key)) return;
    value.emplace();
    object(key, [&](auto& inner) { list(inner, *value); });
  }
  template <typename T, typename List>
  void optional_object(std::string_view key, T& value, const List& list) {
    if (node_->has(key)) object(key, [&](auto& inner) { list(inner, value); });
  }
  template <typename Key, typename T>
  void list(std::string_view key, std::map<Key, T>& map, const char* what) {
    if (!node_->failed()) read_entries((*node_)[key], map, what);
  }
  template <typename Enum, typename T>
  void entries(std::map<Enum, T>& map) {
    constexpr auto kNames = names_of(Enum{});
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      if (node_->has(kNames[i])) required(kNames[i], map[static_cast<Enum>(i)]);
    }
  }
  template <typename Check>
  void check(const Check& check) {
    if (!node_->failed()) check(*node_);
  }

  template <typename T>
  static void read(const JsonNode& node, T& value) {
    if constexpr (ReadsItself<T>) {
      read_value(node, value);
    } else if constexpr (HasMembers<T>) {
      read_object(node, [&](auto& archive) { members(archive, value); });
    } else if constexpr (kIsNumber<T> && std::unsigned_integral<T>) {
      value = node.count<T>();
    } else if constexpr (kIsNumber<T>) {
      value = static_cast<T>(
          node.integer(std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
    } else {
      static_assert(std::is_enum_v<T>, "has neither a list of members nor a form of its own");
      value = node.enumerator<T>();
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
  template <typename T, std::size_t size>
  static void read(const JsonNode& node, std::array<T, size>& values) {
    const std::vector<JsonNode> elements = node.elements(size, size, "elements");
    for (std::size_t i = 0; i < elements.size(); ++i) read(elements[i], values[i]);
  }
  template <IsName Name, typename T>
  static void read(const JsonNode& node, std::map<Name, T>& map) {
    map.clear();
    if constexpr (std::is_enum_v<Name>) {
      read_object(node, [&](auto& archive) { archive.entries(map); });
    } else {
      for (const std::string& key : node.keys()) read(node[key], map[key]);
    }
  }

 private:
  const JsonNode* node_;
};

template <typename List>
void read_object(const JsonNode& node, const List& list) {
  JsonKeys keys;
  list(keys);
  keys.expect(node);
  JsonReader reader(node);
  if (!node.failed()) list(reader);
}

/// Reads a record by its list, even if it has its own form.
template <typename T>
void read_members(const JsonNode& node, T& record) {
  read_object(node, [&](auto& archive) { members(archive, record); });
}

template <typename Key, typename T>
void read_entries(const JsonNode& node, std::map<Key, T>& map, const char* what) {
  map.clear();
  for (const JsonNode& element : node.elements()) {
    Key key{};
    T value{};
    read_object(element, [&](auto& archive) { members(archive, key, value); });
    if (node.failed()) return;
    if (!map.emplace(std::move(key), std::move(value)).second) {
      element.refuse(std::string("a second ") + what);
    }
  }
}

/// Reads any of the values listed above.
template <typename T>
T read_as(const JsonNode& node) {
  T value{};
  JsonReader::read(node, value);
  return value;
}

// --- Views of members ----------------------------------------------------------------------------

/// View of an integer from 0 to `most`.
template <typename T>
struct UpTo {
  T& value;
  std::uint64_t most;

  friend void write_value(nlohmann::json& to, const UpTo& number) {
    write_value(to, static_cast<std::uint64_t>(number.value));
  }
  friend void read_value(const JsonNode& node, UpTo& number) {
    number.value = static_cast<T>(node.count<std::uint64_t>(number.most));
  }
};
template <typename T>
UpTo(T&, std::uint64_t) -> UpTo<T>;

}  // namespace rastercheck::cases
