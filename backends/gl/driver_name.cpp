#include "backends/gl/driver_name.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace rastercheck::backends::gl {
namespace {

void skip(std::string_view& text, std::string_view prefix) {
  if (text.starts_with(prefix)) text.remove_prefix(prefix.size());
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Returns the letters and digits at the start of a text, in lower case.
std::string first_word(std::string_view text) {
  std::string word;
  for (const char c : text) {
    if (!is_letter(c) && (word.empty() || std::isdigit(static_cast<unsigned char>(c)) == 0)) break;
    word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return word;
}

/// GL_VERSION without the text that the API prescribes before the driver's own version.
std::string_view own_part(std::string_view version) {
  std::string_view rest = version;
  skip(rest, "OpenGL ES ");
  rest.remove_prefix(std::min(rest.size(), rest.find_first_of(' ')));
  skip(rest, " ");
  skip(rest, "(Core Profile) ");
  return rest.empty() ? version : rest;
}

}  // namespace

Driver driver_of(std::string_view renderer, std::string_view version) {
  std::string_view own = own_part(version);
  std::string name;
  if (own.starts_with("NVIDIA ")) {
    name = "nvidia";
    skip(own, "NVIDIA ");  // Vulkan reports only the number; one list serves both APIs
  } else if (renderer.find("(radeonsi") != std::string_view::npos) {
    name = "radeonsi";
  } else {
    skip(renderer, "Mesa ");
    name = first_word(renderer);
  }
  return {name.empty() ? "unknown" : name, std::string(own)};
}

}  // namespace rastercheck::backends::gl
