#pragma once

// Reads a backend's known defects and matches violations with them.
//
// An entry applies to some laws, or to the drawing itself. If a case violates a law, its violations
// count as known through the law's entries only if every kept violation (records::kMostViolations)
// matches one of these entries. They count as known through entries for drawings if the law holds
// once the oracle has corrected everything that these entries describe. Any other fault in the case
// is reported as usual.

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

/// Sources of lists. A folder holds drivers' lists as DIRECTORY/DRIVER/known.json. A file is a list
/// for any backend, or an expectation list (records/expectations.h). Without sources, nothing is
/// known. With sources, known.json beside a plugin is read for that plugin, too.
using KnownSources = std::vector<std::string>;

/// An entry of some list, with its case.
struct KnownDefect {
  records::KnownEntry entry;
  /// Its `found` names a law that the case violates. Empty if `entry.expected`.
  std::optional<cases::Case> shown;
  records::Staleness staleness = records::Staleness::waiver;  ///< if the case passes
  bool has_run_out = false;  ///< past its last day; matches nothing
};

/// All lists that apply to a backend.
struct KnownDefects {
  std::vector<records::KnownOfBackend> lists;  ///< with every entry that applies to the backend
  std::vector<KnownDefect> defects;            ///< all entries except those that skip laws

  std::vector<cases::Case> cases() const;  ///< of every entry with a case
  /// True if the lists say to skip the law.
  bool is_skipped(std::string_view law) const;
};

/// Reads all lists of the sources, for any backend; within folders ordered by driver name.
Result<std::vector<records::KnownList>> read_known_lists(const KnownSources& sources);

/// Reads the lists that apply to a backend, with their cases; empty if none applies. Fails if a
/// list or case cannot be read, a folder's list is for another driver, two entries share an id, an
/// entry names no existing law, or a case's `found` differs from its entry in law or verdict.
Result<std::optional<KnownDefects>> read_known_defects(const KnownSources& sources,
                                                       const std::string& specification,
                                                       backends::Backend& backend);

/// The default list that `rastercheck known add` writes for a backend: known.json beside a plugin;
/// empty for other backends.
std::string list_beside(const std::string& specification);
/// Returns the backend's name in entries: its specification, for a plugin without the file's
/// folder.
std::string known_name_of(const std::string& specification);

/// Returns today's date, "2027-01-31", UTC, for comparison with `until`.
std::string today();

using KnownByBackend = std::map<std::string, KnownDefects>;  ///< key: the backend's specification

/// Returns the ids of the law's entries that explain a violation on a case without a camera; empty
/// if the violation is new.
std::vector<std::string> entries_of(const KnownDefects& known, std::string_view law,
                                    const cases::Case& clip, const records::Violation& violation);
/// Returns the ids of entries for drawings that explain `violation`, which the judge found in the
/// drawing itself.
std::vector<std::string> entries_of_drawing(const KnownDefects& known, const cases::Case& clip,
                                            const records::Violation& violation);

/// Returns an amendment that corrects in the backend's drawings everything that entries for
/// drawings explain, and adds their ids to `seen` if given. All three arguments must outlive the
/// amendment.
backends::Backend::Amendment known_amendment(const KnownDefects& known,
                                             const backends::Backend& backend,
                                             std::set<std::string>* seen = nullptr);

/// Adds to `check.known` the expectation-list lines that match a violated check's law.
void tell_expected(const KnownDefects& known, std::string_view law, Check& check);

/// Sets `check.known` to the entries that explain a violated check, if they explain everything.
/// Otherwise keeps only the violations that remain once known faults of drawings are corrected,
/// unexplained ones first. Draws the case again if entries for drawings exist. `index` is the
/// case's index, as for check_law().
void tell_known(const KnownDefects& known, const Law& law, const cases::Case& c,
                backends::Backend& backend, std::uint64_t index, Check& check);

/// Returns the entries whose own cases a run of these laws checks, as indices into `defects`.
std::vector<std::size_t> entries_to_check(const KnownDefects& known,
                                          const std::vector<std::string>& laws);

/// Adds to a complete run an unexpected pass for each law that an expectation list expects to fail
/// but that always held.
void add_unexpected_passes(records::Run& run);

/// Returns a digest of the lists, including drivers and cases; empty without lists.
std::string digest_of_known(const KnownByBackend& known);

}  // namespace rastercheck::properties
