#pragma once

// What is known to be wrong with a backend's driver, and whether a violation is of it.
//
// A violating case is known only if every violation that was kept of it (records::kMostViolations)
// is of some entry: of its laws and verdicts, and with every condition met. Whatever else is wrong
// with a case stands out as ever.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/law.h"
#include "records/counterexample.h"
#include "records/known.h"

namespace rastercheck::properties {

/// A driver's list with its cases, and the driver that is here.
struct KnownDefects {
  records::KnownList list;
  std::vector<cases::Case> cases;  ///< of each entry; `found` names the law that it violates
  backends::Driver driver;

  bool is_same_version() const { return list.version == driver.version; }
};

/// The lists of a folder, DRIVER/known.json, in the order of the drivers' names; none of one that
/// is not there.
Result<std::vector<records::KnownList>> read_known_lists(const std::string& directory);

/// The list of a backend's driver: DIRECTORY/DRIVER/known.json and its cases. Nothing where the
/// backend is no driver, there is no such list, or the folder is "". Fails where the list or a case
/// cannot be read, is another driver's, names no law that there is, or where a case is found by
/// another law or verdict than the entry's.
Result<std::optional<KnownDefects>> read_known_defects(const std::string& directory,
                                                       backends::Backend& backend);

using KnownByBackend = std::map<std::string, KnownDefects>;  ///< by specification

/// The entries that explain a violation of a law on a case without a camera, by id; none where it
/// is new.
std::vector<std::string> entries_of(const KnownDefects& known, std::string_view law,
                                    const cases::Case& clip, const records::Violation& violation);

/// Puts violations that are of no entry first, so that these are what the check is about. Where
/// there are none, it names in `check.known` the entries that the violations are of.
void tell_known(const KnownDefects& known, const Law& law, const cases::Case& c, Check& check);

/// The entries of a list whose own cases a run of these laws checks, by index.
std::vector<std::size_t> entries_to_check(const KnownDefects& known,
                                          const std::vector<std::string>& laws);

/// A word that tells lists apart, drivers and cases included; empty where there are none.
std::string digest_of_known(const KnownByBackend& known);

}  // namespace rastercheck::properties
