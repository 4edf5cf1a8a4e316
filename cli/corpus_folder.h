#pragma once

#include <string>

namespace rastercheck::cli {

/// The corpus that comes with the program: beside it where it is installed, else in the sources it
/// was built from.
std::string corpus_folder();

/// The lists of known defects that come with it (properties/campaign/known_defects.h), found
/// likewise.
std::string known_folder();

}  // namespace rastercheck::cli
