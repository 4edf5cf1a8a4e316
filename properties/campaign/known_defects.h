#pragma once

// Reads what is known to be wrong with a backend, and tells whether a violation is of it.
//
// An entry is of some laws, or of what is drawn. A violating case is known by entries of its law
// only if every violation that was kept of it (records::kMostViolations) is of some entry. By
// entries of what is drawn it is known if the law holds once all that they say is put right in its
// drawings, by the oracle. Whatever else is wrong with a case stands out as ever.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/law.h"
#include "records/counterexample.h"
#include "records/known.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Where lists are: folders of lists of drivers, DIRECTORY/DRIVER/known.json, and files, which are
/// lists of any backend or expectation lists (records/expectations.h). None: nothing is known. If
/// there are some, known.json beside a plugin is read for it, too.
using KnownSources = std::vector<std::string>;

/// An entry of some list, with its case.
struct KnownDefect {
  records::KnownEntry entry;
  std::optional<cases::Case> shown;  ///< `found` names a law that it violates; none where expected
  records::Staleness staleness = records::Staleness::waiver;  ///< where its case passes
  bool has_run_out = false;  ///< its last day is over, and nothing is known by it
};

/// All lists that are of a backend.
struct KnownDefects {
  std::vector<records::KnownOfBackend> lists;  ///< whole, as far as they are of the backend
  std::vector<KnownDefect> defects;            ///< all entries but those that skip laws

  std::vector<cases::Case> cases() const;  ///< of all entries that have one
  /// Whether a law is not to be checked.
  bool is_skipped(std::string_view law) const;
};

/// The lists of sources, whatever backend they are of: in folders in the order of the drivers'
/// names.
Result<std::vector<records::KnownList>> read_known_lists(const KnownSources& sources);

/// The lists that are of a backend, with their cases; nothing where there is none. Fails where a
/// list or a case cannot be read, a folder's list is another driver's, two entries have one id, one
/// names no law that there is, or a case is found by another law or verdict than its entry's.
Result<std::optional<KnownDefects>> read_known_defects(const KnownSources& sources,
                                                       const std::string& specification,
                                                       backends::Backend& backend);

/// The list that `rastercheck known add` writes for a backend unless told otherwise: known.json
/// beside a plugin. Empty: there is no such place.
std::string list_beside(const std::string& specification);
/// Gives the name that entries call a backend by: its specification, of a plugin without the folder
/// of its file.
std::string known_name_of(const std::string& specification);

/// Gives today, "2027-01-31", UTC: what `until` is held against.
std::string today();

using KnownByBackend = std::map<std::string, KnownDefects>;  ///< by specification

/// The entries of its law that explain a violation on a case without a camera, by id; none where it
/// is new.
std::vector<std::string> entries_of(const KnownDefects& known, std::string_view law,
                                    const cases::Case& clip, const records::Violation& violation);
/// Gives those of what is drawn; `violation` is the judge's, of the drawing itself.
std::vector<std::string> entries_of_drawing(const KnownDefects& known, const cases::Case& clip,
                                            const records::Violation& violation);

/// Puts right in what a backend draws all that entries of drawings explain, and notes their ids in
/// `seen` if that is given. All three have to outlive it.
backends::Backend::Amendment known_amendment(const KnownDefects& known,
                                             const backends::Backend& backend,
                                             std::set<std::string>* seen = nullptr);

/// Names in `check.known` the lines of expectation lists that a violated check's law is of.
void tell_expected(const KnownDefects& known, std::string_view law, Check& check);

/// Names in `check.known` the entries that a violated check is of, if nothing else is wrong. Else
/// leaves in it what is violated once known faults of drawings are put right, and puts violations
/// that are of no entry first, so that these are what the check is about. Draws the case again
/// where there are entries of drawings. `index` is the case's, as of check_law().
void tell_known(const KnownDefects& known, const Law& law, const cases::Case& c,
                backends::Backend& backend, std::uint64_t index, Check& check);

/// The entries whose own cases a run of these laws checks, by index in `defects`.
std::vector<std::size_t> entries_to_check(const KnownDefects& known,
                                          const std::vector<std::string>& laws);

/// Adds to a whole run that laws which expectation lists have fail held whenever they were checked.
void add_unexpected_passes(records::Run& run);

/// A word that tells lists apart, drivers and cases included; empty where there are none.
std::string digest_of_known(const KnownByBackend& known);

}  // namespace rastercheck::properties
