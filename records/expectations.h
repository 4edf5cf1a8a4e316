#pragma once

// The expectation lists that CI of drivers keeps, one name a line, as entries of what is known:
//
//   NAME-fails.txt    laws that are violated: no violation is new, and one that holds is told of
//   NAME-flakes.txt   laws that are violated at times
//   NAME-skips.txt    laws that are not checked at all
//
// A name is a law's id, a pattern of ids as of the shell, or either of one backend, BACKEND/LAW.
// "#" at the beginning, or after a space, begins a comment. A status after a comma, as lists of
// deqp-runner have it ("name,Fail"), is read over: what it says of a test is said of all its
// violations here.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "records/known.h"
#include "records/run.h"

namespace rastercheck::records {

/// Tells by a file's name what it expects of the laws in it; nothing where it is no expectation
/// list.
std::optional<Expected> expected_by(std::string_view file);

/// The names as entries, each of its own law, whose id is the name. Fails where a name is there
/// twice.
Result<KnownList> parse_expectations(std::string_view text, Expected expected,
                                     const std::string& file);

/// Holds the text of the three lists.
struct ExpectationTexts {
  std::string fails;
  std::string flakes;
  std::string skips;
};

/// The lists that would expect what these runs found: laws that were violated in each run that
/// checked them, laws that were in some, and laws that one was told to skip. Names have their
/// backend where the runs are of several.
ExpectationTexts expectations_of(const std::vector<Run>& runs);

}  // namespace rastercheck::records
