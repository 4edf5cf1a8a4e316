#pragma once

#include <string>
#include <string_view>

#include "cases/error.h"

namespace rastercheck::reports {

/// RFC 4648, section 4: the standard alphabet, with padding, without line breaks.
std::string to_base64(std::string_view bytes);

/// The bytes that to_base64 made this text of. Refuses every other text: foreign characters,
/// missing or misplaced padding, bits that no byte has.
Result<std::string> from_base64(std::string_view text);

}  // namespace rastercheck::reports
