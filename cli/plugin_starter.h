#pragma once

// The files of a starter project for plugins (docs/examples/plugin), which the build embeds in the
// program.

#include <span>
#include <string_view>

namespace rastercheck::cli {

struct StarterFile {
  std::string_view path;  ///< within the project's folder
  std::string_view text;
};

std::span<const StarterFile> starter_in_c();
std::span<const StarterFile> starter_in_cxx();

}  // namespace rastercheck::cli
