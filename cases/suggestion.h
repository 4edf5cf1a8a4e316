#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::cases {

/// "; did you mean --cases?" if one of the names begins with the word, resembles the word, or is
/// the word's ending (as "gl" is of "opengl"); else "".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace rastercheck::cases
