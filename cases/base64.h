#pragma once

#include <string>
#include <string_view>

#include "cases/error.h"

namespace rastercheck::cases {

/// Encodes as in RFC 4648, section 4: with the standard alphabet and padding, without line breaks.
std::string to_base64(std::string_view bytes);

/// Decodes a text that to_base64() made. Refuses every other text: foreign characters, missing or
/// misplaced padding, nonzero padding bits.
Result<std::string> from_base64(std::string_view text);

}  // namespace rastercheck::cases
