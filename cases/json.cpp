#include "cases/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace rastercheck::cases {
namespace {

using nlohmann::json;

/// The code point that begins at a byte of a UTF-8 text, if it is below U+0100; else 0x100.
unsigned code_point_below_100(std::string_view text, std::size_t at) {
  const auto byte = [text](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  if (byte(at) < 0x80) return byte(at);
  const bool has_two_bytes =
      (byte(at) == 0xc2 || byte(at) == 0xc3) && (byte(at + 1) & 0xc0U) == 0x80;
  return has_two_bytes ? (byte(at) & 0x03U) << 6U | (byte(at + 1) & 0x3fU) : 0x100;
}

/// The place of byte `offset` (1-based, as nlohmann counts) as "line:column", both counted from 1.
std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before =
      text.substr(0, std::min(offset > 0 ? offset - 1 : 0, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n');
  const std::size_t column =
      line_start == std::string_view::npos ? before.size() + 1 : before.size() - line_start;
  return fmt::format("{}:{}", line, column);
}

/// Builds the document from SAX events, to keep or refuse what a DOM parser drops (the sign of
/// "-0", all but the last of duplicate keys).
class DocumentBuilder : public nlohmann::json_sax<json> {
 public:
  DocumentBuilder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  // nlohmann reports every number without a minus sign as unsigned, so a signed zero was "-0".
  bool number_integer(number_integer_t value) override {
    return value == 0 ? add(-0.0) : add(value);
  }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& /*value*/) override { return false; }  // JSON text has no binary values
  bool start_object(std::size_t /*size*/) override { return open(json::object()); }
  bool start_array(std::size_t /*size*/) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    key_ = std::move(value);
    if (!open_.back()->contains(key_)) return true;
    return refuse(child_pointer(pointer(), key_),
                  fmt::format("duplicate key '{}'", printable(key_)));
  }

  bool parse_error(std::size_t position, const std::string& /*last_token*/,
                   const nlohmann::detail::exception& problem) override {
    return refuse(line_and_column(text_, position), reason_of(problem.what()));
  }

  json document;
  std::optional<Error> error;

 private:
  bool refuse(std::string place, std::string reason) {
    error = Error{file_, std::move(place), std::move(reason)};
    return false;
  }

  /// nlohmann's "[json.exception.parse_error.101] parse error at line 1, column 2: …" without the
  /// parts that the place already says.
  static std::string reason_of(std::string_view message) {
    const std::size_t end_of_id = message.find("] ");
    if (end_of_id != std::string_view::npos) message.remove_prefix(end_of_id + 2);
    if (message.starts_with("parse error")) {
      const std::size_t colon = message.find(": ");
      if (colon != std::string_view::npos) message.remove_prefix(colon + 2);
    }
    return "not valid JSON: " + printable(message);
  }

  std::string pointer() const {
    std::string place;
    for (std::size_t i = 1; i < open_.size(); ++i) place = child_pointer(place, steps_[i]);
    return place;
  }

  /// The key or index of the next value in the innermost open container.
  std::string next_step() const {
    if (open_.empty()) return "";
    return open_.back()->is_object() ? key_ : std::to_string(open_.back()->size());
  }

  template <typename Value>
  bool add(Value&& value) {
    place(std::forward<Value>(value));
    return true;
  }

  json* place(json value) {
    if (open_.empty()) {
      document = std::move(value);
      return &document;
    }
    if (open_.back()->is_array()) {
      open_.back()->push_back(std::move(value));
      return &open_.back()->back();
    }
    return &((*open_.back())[key_] = std::move(value));
  }

  bool open(json container) {
    if (open_.size() == kMaxJsonDepth) {
      return refuse(child_pointer(pointer(), next_step()),
                    fmt::format("nested deeper than {} levels", kMaxJsonDepth));
    }
    steps_.push_back(next_step());
    open_.push_back(place(std::move(container)));
    return true;
  }

  bool close() {
    open_.pop_back();
    steps_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  /// The containers not yet closed, outermost first. Pointers stay valid, because a container is
  /// appended to only while it is the innermost.
  std::vector<json*> open_;
  std::vector<std::string> steps_;  ///< key or index of each open container in its parent
  std::string key_;
};

}  // namespace

std::string json_line(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string json_string(std::string_view text) { return json_line(text); }

std::string valid_utf8(std::string_view text) {
  return json::parse(json_string(text)).get<std::string>();
}

std::string one_line(std::string_view text) {
  const auto is_plain = [](char c) { return c >= ' ' && c < '\x7f'; };
  if (std::all_of(text.begin(), text.end(), is_plain)) return std::string(text);
  const std::string quoted = json_string(text);
  std::string line;
  for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
    // Quotes and backslashes read best as they are; only control characters must be escaped.
    const bool is_escaped_mark =
        quoted[i] == '\\' && (quoted[i + 1] == '"' || quoted[i + 1] == '\\');
    if (is_escaped_mark) ++i;
    // JSON does not escape these control characters, but terminals take some of them for the start
    // of a command.
    const unsigned code = code_point_below_100(quoted, i);
    if (code == 0x7f || (code >= 0x80 && code < 0xa0)) {
      line += fmt::format("\\u{:04x}", code);
      if (code >= 0x80) ++i;
    } else {
      line += quoted[i];
    }
  }
  return line;
}

std::string printable(std::string_view text) {
  // Keeps both ends, which say most; a parser's message, for example, ends with what was expected.
  constexpr std::size_t kLongest = 240;
  if (text.size() <= kLongest) return one_line(text);
  return one_line(text.substr(0, kLongest / 2)) + " ... " +
         one_line(text.substr(text.size() - kLongest / 2));
}

std::string child_pointer(const std::string& parent, std::string_view key) {
  std::string pointer;
  pointer.reserve(parent.size() + 1 + key.size());
  pointer.append(parent).append(1, '/');
  for (const char c : one_line(key)) {
    if (c == '~') {
      pointer += "~0";
    } else if (c == '/') {
      pointer += "~1";
    } else {
      pointer += c;
    }
  }
  return pointer;
}

Result<json> parse_json(std::string_view text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return tl::unexpected(Error{file, "1:1", "not valid JSON: empty"});
  }
  // nlohmann treats a NUL byte as the end of the text.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    return tl::unexpected(
        Error{file, line_and_column(text, nul + 1), "not valid JSON: unexpected NUL byte"});
  }
  DocumentBuilder builder(text, file);
  if (!json::sax_parse(text, &builder)) {
    return tl::unexpected(builder.error.value_or(Error{file, "/", "not valid JSON"}));
  }
  return std::move(builder.document);
}

}  // namespace rastercheck::cases
