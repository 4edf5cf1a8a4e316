#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rastercheck::cases {

/// Returns the bytes of a base64 text (RFC 4648, §4), which may have spaces and line ends anywhere;
/// empty if the text is not base64.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace rastercheck::cases
