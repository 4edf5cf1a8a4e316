#pragma once

// Reads and writes expectation lists, as drivers' CI keeps them, one name per line:
//
//   NAME-fails.txt    laws expected to fail: a violation is not new; a law that holds is reported
//   NAME-flakes.txt   laws that are sometimes violated
//   NAME-skips.txt    laws that are not checked at all
//
// A name is a law's id or a shell pattern of ids, optionally limited to one backend: BACKEND/LAW.
// "#" at the beginning, or after a space, begins a comment. A status after a comma, as in lists of
// deqp-runner ("name,Fail"), is ignored: the list applies to every violation of the law.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "records/known.h"
#include "records/run.h"

namespace rastercheck::records {

/// Returns the expectation that a file's name implies; empty if the file is not an expectation
/// list.
std::optional<Expected> expected_by(std::string_view file);

/// Parses the names into entries; each entry's id and law pattern are the name. Fails on a
/// duplicate name.
Result<KnownList> parse_expectations(std::string_view text, Expected expected,
                                     const std::string& file);

/// Holds the text of the three lists.
struct ExpectationTexts {
  std::string fails;
  std::string flakes;
  std::string skips;
};

/// Returns the lists that expect exactly what these runs found: laws violated in each run that
/// checked them (fails), laws violated in some (flakes), and laws that were skipped (skips). Names
/// include the backend if the runs have several.
ExpectationTexts expectations_of(const std::vector<Run>& runs);

}  // namespace rastercheck::records
