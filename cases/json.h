#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "cases/error.h"

namespace rastercheck::cases {

/// The deepest nesting of arrays and objects that is accepted.
inline constexpr std::size_t kMaxJsonDepth = 16;

/// Parses a JSON text as RFC 8259 defines it, but rejects whatever would lose information:
/// duplicate keys are errors (at their JSON pointer), "-0" stays minus zero (as a float), nesting
/// is limited to kMaxJsonDepth. Syntax errors and invalid UTF-8 are placed at "line:column". `file`
/// is the name used in errors.
///
/// Leaves out the document's own members with the keys `left_out`; only their syntax is checked.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& file,
                                  std::span<const std::string_view> left_out = {});

/// Formats a value on one line; bytes that are not UTF-8 become U+FFFD.
std::string json_line(const nlohmann::json& value);

/// Formats a text as a JSON string, quotes included; bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

/// Replaces bytes that are not UTF-8 by U+FFFD, as writing and reading the text would.
std::string valid_utf8(std::string_view text);

/// Makes a text safe for one terminal line: escapes control characters (U+0000 to U+001F, U+007F to
/// U+009F) as JSON does, and replaces bytes that are not UTF-8 by U+FFFD. Idempotent.
std::string one_line(std::string_view text);

/// Like one_line(), but for use in a message: shortens long texts.
std::string printable(std::string_view text);

/// The JSON pointer (RFC 6901) of a key or element below `parent`; the document itself is "".
std::string child_pointer(const std::string& parent, std::string_view key);

/// The JSON pointer of `value`, which must be `document` or one of the values in it. Searches for
/// it: pointers are for errors, and most values have none.
std::string pointer_in(const nlohmann::json& document, const nlohmann::json& value);

}  // namespace rastercheck::cases
