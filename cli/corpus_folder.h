#pragma once

#include <string>

#include "properties/campaign/known_defects.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// The corpus that comes with the program: beside it where it is installed, else in the sources it
/// was built from.
std::string corpus_folder();

/// The lists of known defects that come with it (properties/campaign/known_defects.h), found
/// likewise.
std::string known_folder();

/// The folder that a plan means.
std::string corpus_folder_of(const records::Plan& plan);

/// The sources that were given, and known_folder() where no other folder is among them.
properties::KnownSources known_sources_of(const properties::KnownSources& given);
/// The sources that a plan means; none if it ignores known defects.
properties::KnownSources known_sources_of(const records::Plan& plan);

}  // namespace rastercheck::cli
