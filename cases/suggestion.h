#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::cases {

/// "; did you mean --cases?", where one of the names begins like the word, is much like it, or is
/// the end of it, as gl is of opengl; else nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace rastercheck::cases
