#pragma once

// The files of the starter projects (docs/examples/plugin, docs/examples/exec), which the build
// embeds in the program.

#include <string_view>
#include <vector>

namespace rastercheck::cli {

struct StarterFile {
  std::string_view path;  ///< within the project's folder
  std::string_view text;
};

/// A project for a rasterizer of this language, which gives fragments or only an image.
struct Starter {
  std::string_view language;
  std::string_view gives;
  std::vector<StarterFile> files;
};

const std::vector<Starter>& starters();

}  // namespace rastercheck::cli
