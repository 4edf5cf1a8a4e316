#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rastercheck::cases {

/// The bytes of a base64 text (RFC 4648, §4) with spaces and line ends anywhere; empty if it is not
/// one.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace rastercheck::cases
