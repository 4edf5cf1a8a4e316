#pragma once

// Cases in folders: the corpus, and the counterexamples that runs have saved.

#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "records/plan.h"

namespace rastercheck::properties {

/// Reads a folder's case files (*.json), ordered by name; a case without a name gets its file's.
/// Fails at the first unreadable file.
Result<std::vector<cases::Case>> read_corpus(const std::string& directory);

/// Returns a plan's corpus: the cases of the folder, then the worst cases of hunts.
Result<std::vector<cases::Case>> corpus_of(const records::Plan& plan, const std::string& directory);

/// Saved counterexamples, and errors for unreadable files.
struct SavedCases {
  std::vector<cases::Case> cases;
  std::vector<Error> unreadable;
};

/// Reads those case files of a folder that one of the laws found on one of the backends. Returns
/// none if the folder does not exist.
SavedCases read_saved(const std::string& directory, const std::vector<std::string>& laws,
                      const std::vector<std::string>& backends);

}  // namespace rastercheck::properties
