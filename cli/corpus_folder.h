#pragma once

#include <string>

namespace rastercheck::cli {

/// The corpus that comes with the program: beside it where it is installed, else in the sources it
/// was built from.
std::string corpus_folder();

}  // namespace rastercheck::cli
