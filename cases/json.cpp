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
  DocumentBuilder(std::string_view text, const std::string& file,
                  std::span<const std::string_view> left_out)
      : text_(text), file_(file), left_out_(left_out) {}

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
    const bool is_of_document = open_.size() == 1 && !is_left_out_;
    if (is_of_document && std::find(left_out_.begin(), left_out_.end(), value) != left_out_.end()) {
      is_left_out_ = true;
    }
    if (is_left_out_) return true;
    const auto [member, is_new] = open_.back()->emplace(value, nullptr);
    member_ = &*member;
    return is_new || refuse(pointer_in(document, *member_),
                            fmt::format("duplicate key '{}'", printable(value)));
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

  template <typename Value>
  bool add(Value&& value) {
    if (is_left_out_) return leave_out(0);
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
    return &(*member_ = std::move(value));
  }

  bool open(json container) {
    if (is_left_out_) return leave_out(1);
    const bool is_too_deep = open_.size() == kMaxJsonDepth;
    open_.push_back(place(std::move(container)));
    return !is_too_deep || refuse(pointer_in(document, *open_.back()),
                                  fmt::format("nested deeper than {} levels", kMaxJsonDepth));
  }

  bool close() {
    if (is_left_out_) return leave_out(-1);
    open_.pop_back();
    return true;
  }

  /// Leaves out a value, or the begin (1) or end (-1) of a container.
  bool leave_out(int begins) {
    left_out_depth_ += begins;
    is_left_out_ = left_out_depth_ > 0;
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  std::span<const std::string_view> left_out_;
  bool is_left_out_ = false;  ///< the next value is to be left out, or part of one
  int left_out_depth_ = 0;    ///< containers in the value left out that are not yet closed
  /// The containers not yet closed, outermost first. Pointers stay valid, because a container is
  /// appended to only while it is the innermost.
  std::vector<json*> open_;
  json* member_ = nullptr;  ///< of the innermost object: where its next value goes
};

/// The JSON pointer of `value` from `outer`; empty if it is not in there.
std::optional<std::string> find_pointer(const json& outer, const json& value) {
  if (&outer == &value) return "";
  if (!outer.is_structured()) return std::nullopt;
  for (const auto& member : outer.items()) {
    if (const auto rest = find_pointer(member.value(), value)) {
      return child_pointer("", member.key()) + *rest;
    }
  }
  return std::nullopt;
}

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

std::string pointer_in(const json& document, const json& value) {
  return find_pointer(document, value).value_or("");
}

Result<json> parse_json(std::string_view text, const std::string& file,
                        std::span<const std::string_view> left_out) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return tl::unexpected(Error{file, "1:1", "not valid JSON: empty"});
  }
  // nlohmann treats a NUL byte as the end of the text.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    return tl::unexpected(
        Error{file, line_and_column(text, nul + 1), "not valid JSON: unexpected NUL byte"});
  }
  DocumentBuilder builder(text, file, left_out);
  if (!json::sax_parse(text, &builder)) {
    return tl::unexpected(builder.error.value_or(Error{file, "/", "not valid JSON"}));
  }
  return std::move(builder.document);
}

}  // namespace rastercheck::cases
