#pragma once

#include <string>
#include <string_view>

namespace rastercheck::reports {

/// A text as HTML and as the value of a quoted attribute: markup characters as entities, control
/// characters but line breaks and tabs, and bytes that are not UTF-8, as U+FFFD.
std::string html(std::string_view text);

}  // namespace rastercheck::reports
