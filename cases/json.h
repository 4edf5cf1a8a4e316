#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "cases/error.h"

namespace rastercheck::cases {

/// Nesting of arrays and objects beyond this is refused.
inline constexpr std::size_t kMaxJsonDepth = 16;

/// Parses a JSON text as RFC 8259 has it, with the liberties closed that lose information:
/// duplicate keys are refused (at their JSON pointer), "-0" stays minus zero (as a float), nesting
/// is limited to kMaxJsonDepth. Syntax errors and invalid UTF-8 are placed at "line:column".
/// `file` is the name for error messages.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& file);

/// A value on one line; bytes that are not UTF-8 become U+FFFD.
std::string json_line(const nlohmann::json& value);

/// A text as a JSON string, quotes included; bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

/// The text with bytes that are not UTF-8 as U+FFFD: what it becomes when written and read again.
std::string valid_utf8(std::string_view text);

/// The text on one line, fit for a terminal: its control characters (U+0000 to U+001F, U+007F to
/// U+009F) as JSON escapes them, bytes that are not UTF-8 as U+FFFD. Twice is as once.
std::string one_line(std::string_view text);

/// The same for a message, shortened where it is long.
std::string printable(std::string_view text);

/// The JSON pointer (RFC 6901) of a key or element below `parent`; the document itself is "".
std::string child_pointer(const std::string& parent, std::string_view key);

}  // namespace rastercheck::cases
