#pragma once

// Reads the two sides of a comparison: baseline files, or runs that kept their cases.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/error.h"
#include "records/baseline.h"
#include "records/run.h"

namespace rastercheck::gate {

/// One side of a comparison.
struct Side {
  std::string file;                                ///< as the user named it
  std::optional<records::Run> run = std::nullopt;  ///< empty for a baseline file
  records::Baseline sections = {};
};

/// Reads a baseline file, a run.json that kept its cases, the folder of such a run, or standard
/// input for "-".
Result<Side> read_side(const std::string& file);
/// Makes a side from a run that is already in memory.
Result<Side> side_of(records::Run run, const std::string& file);

/// Renames the side's backend in its sections; an empty name changes nothing. Refuses a side with
/// several backends.
Result<void> rename_backend(Side& side, const std::string& name);

/// Sets the commit of the side's sections.
void set_commit(Side& side, const std::string& commit);

/// The cases that a run must check to be comparable with a baseline.
struct CaseSet {
  std::string section;  ///< the section's key, for messages
  records::Plan plan;   ///< frozen()
};

/// Returns the common case set of the backends' sections, for a machine and program with that
/// environment (records::Run::environment). Fails if a backend has no section, if the sections'
/// case sets differ, or if their records have another version than this program's.
Result<CaseSet> case_set_for(const Side& baseline, const std::vector<std::string>& backends,
                             const std::map<std::string, std::string>& environment);

}  // namespace rastercheck::gate
