#pragma once

#include <string>
#include <string_view>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::cases {

class JsonNode;
struct DecimalRounding;

/// Reads a case file (version 1, docs/case-format.md). Every case it accepts can be
/// drawn, and no part of the text was defaulted by guess or ignored, nor rounded unless the case
/// says "round": true. `file` names the source in errors.
Result<Case> parse_case(std::string_view text, const std::string& file);

/// Like parse_case(), and says how many decimals were rounded. They are if `rounding` allows it, or
/// if the case says "round": true.
Result<Case> parse_case(std::string_view text, const std::string& file, DecimalRounding& rounding);

/// Reads a case from a file, or from standard input for "-".
Result<Case> read_case(const std::string& file);

/// Reads a case nested in another document; the node records the error.
Case read_case(const JsonNode& node);
/// For records that contain cases (json_members.h).
inline void read_value(const JsonNode& node, Case& c) { c = read_case(node); }

}  // namespace rastercheck::cases
