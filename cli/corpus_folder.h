#pragma once

#include <string>

#include "records/plan.h"

namespace rastercheck::cli {

/// The corpus that comes with the program: beside it where it is installed, else in the sources it
/// was built from.
std::string corpus_folder();

/// The lists of known defects that come with it (properties/campaign/known_defects.h), found
/// likewise.
std::string known_folder();

/// Those of a plan. What is known is nothing where the plan ignores it.
std::string corpus_folder_of(const records::Plan& plan);
std::string known_folder_of(const records::Plan& plan);

}  // namespace rastercheck::cli
