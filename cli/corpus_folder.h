#pragma once

#include <string>

#include "properties/campaign/known_defects.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// Returns the folder of the corpus that comes with the program: next to an installed program, else
/// in the sources from which it was built.
std::string corpus_folder();

/// Returns the folder of the known-defect lists that come with the program
/// (properties/campaign/known_defects.h), found the same way.
std::string known_folder();

/// Returns the folder of the accuracy table that comes with the program, found the same way.
std::string accuracy_folder();

/// Returns the corpus folder that a plan uses.
std::string corpus_folder_of(const records::Plan& plan);

/// Returns the given sources, plus known_folder() if they include no other folder.
properties::KnownSources known_sources_of(const properties::KnownSources& given);
/// Returns the sources that a plan uses; none if it ignores known defects.
properties::KnownSources known_sources_of(const records::Plan& plan);

}  // namespace rastercheck::cli
