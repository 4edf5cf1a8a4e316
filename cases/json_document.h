#pragma once

// Writes records as JSON text that people can read and tools can compare. Members appear in the
// order of the member lists that json_members.h also reads. In a document each member has its own
// line, and so has each element of its lists.
//
//   {
//   "seed": 1,
//   "approvals": [
//   {"reason":"…","version":"…"},
//   {"reason":"…","version":"…"}]
//   }
//
// A type with its own form is written on one line, its keys in alphabetical order. A type with
// text() writes itself.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/json.h"
#include "cases/json_members.h"

namespace rastercheck::cases {

/// An array with each element on its own line.
class JsonLines {
 public:
  void add(const std::string& line) { text_ += (text_.size() > 1 ? ",\n" : "\n") + line; }
  std::string end() && { return std::move(text_) + (text_.size() > 1 ? "\n]" : "]"); }

 private:
  std::string text_ = "[";
};

/// A type with a list of members and no form of its own.
template <typename T>
concept IsRecord = !WritesItself<T> && HasMembers<T>;

template <typename T>
concept HasText = requires(const T& value) {
  { value.text() } -> std::same_as<std::string>;
};

/// Writes an object as a document, or on one line.
class TextWriter {
 public:
  explicit TextWriter(bool is_document)
      : before_key_(is_document ? "\n" : ""), after_key_(is_document ? ": " : ":") {}
  std::string end() && { return std::move(text_) + before_key_ + "}"; }

  void format(std::string_view format, std::uint64_t version) {
    add("format", json_string(format));
    add("version", std::to_string(version));
  }
  template <typename T>
  void required(std::string_view key, const T& value) {
    add(key, text_of(value));
  }
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
    add(key, line(list));
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
    add(key, list_of(map));
  }
  template <IsName Name, typename T>
  void entries(const std::map<Name, T>& map) {
    for (const auto& [name, value] : map) required(key_of(name), value);
  }
  template <typename Check>
  void check(const Check& /*check*/) {}

  /// An object on one line.
  template <typename List>
  static std::string line(const List& list) {
    TextWriter writer(false);
    list(writer);
    return std::move(writer).end();
  }

  /// Formats any value; in lists, each record on its own line. Elements are formatted one at a
  /// time, because a JSON tree of all elements would take many times the memory of their text.
  template <typename T>
  static std::string text_of(const T& value) {
    if constexpr (HasText<T>) {
      return value.text();
    } else if constexpr (IsRecord<T>) {
      return line([&](auto& inner) { members(inner, value); });
    } else {
      return json_line(json_of(value));
    }
  }
  template <typename T>
  static std::string text_of(const std::optional<T>& value) {
    return text_of(*value);
  }
  template <typename T>
  static std::string text_of(const std::vector<T>& values) {
    if constexpr (IsName<T>) {
      return json_line(json_of(values));
    } else {
      JsonLines lines;
      for (const T& value : values) lines.add(text_of(value));
      return std::move(lines).end();
    }
  }
  template <typename Key, typename T>
  static std::string text_of(const std::map<Key, T>& map) {
    if constexpr (IsName<Key>) {
      return json_line(json_of(map));
    } else {
      return list_of(map);
    }
  }

 private:
  /// Formats a map as a list (write_entries).
  template <typename Key, typename T>
  static std::string list_of(const std::map<Key, T>& map) {
    JsonLines lines;
    for (const auto& entry : map) {
      if constexpr (WritesItself<typename std::map<Key, T>::value_type>) {
        lines.add(text_of(entry));
      } else {
        lines.add(line([&](auto& inner) { members(inner, entry.first, entry.second); }));
      }
    }
    return std::move(lines).end();
  }

  void add(std::string_view key, const std::string& value) {
    text_ += (text_.size() > 1 ? "," : "") + before_key_ + json_string(key) + after_key_ + value;
  }

  std::string before_key_;
  std::string after_key_;
  std::string text_ = "{";
};

/// Formats a record as a document, without a final newline.
template <typename T>
std::string document_of(const T& record) {
  TextWriter writer(true);
  members(writer, record);
  return std::move(writer).end();
}

}  // namespace rastercheck::cases
