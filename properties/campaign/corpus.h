#pragma once

// Cases in folders: the corpus, and the counterexamples that runs have saved.

#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::properties {

/// The case files of a folder (*.json), in the order of their names; a case without a name gets its
/// file's. Fails at the first that cannot be read.
Result<std::vector<cases::Case>> read_corpus(const std::string& directory);

/// Saved counterexamples, and what of their folder could not be read.
struct SavedCases {
  std::vector<cases::Case> cases;
  std::vector<Error> unreadable;
};

/// The case files of a folder that name one of the laws and one of the backends as those that found
/// them; none where there is no such folder.
SavedCases read_saved(const std::string& directory, const std::vector<std::string>& laws,
                      const std::vector<std::string>& backends);

}  // namespace rastercheck::properties
