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

/// The folders that a plan means. The second is empty if the plan ignores known defects.
std::string corpus_folder_of(const records::Plan& plan);
std::string known_folder_of(const records::Plan& plan);

}  // namespace rastercheck::cli
