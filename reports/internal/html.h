#pragma once

#include <string>
#include <string_view>

namespace rastercheck::reports {

/// Returns a text as HTML, also for use as the value of a quoted attribute. Markup characters
/// become entities. Control characters except line breaks and tabs, and bytes that are not UTF-8,
/// become U+FFFD.
std::string html(std::string_view text);

}  // namespace rastercheck::reports
