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
  std::optional<records::Run> run = std::nullopt;  ///< nothing of a baseline file
  records::Baseline sections = {};
};

/// Reads a baseline file, a run.json that kept its cases, the folder of such a run, or standard
/// input for "-".
Result<Side> read_side(const std::string& file);
/// Makes a side from a run that is already in memory.
Result<Side> side_of(records::Run run, const std::string& file);

/// Gives the backend of the side another name in its sections; an empty one changes nothing.
/// Refuses sides of several backends.
Result<void> rename_backend(Side& side, const std::string& name);

/// Notes the commit that the side's sections are of.
void set_commit(Side& side, const std::string& commit);

/// The cases that a run has to check to be comparable with a baseline.
struct CaseSet {
  std::string section;  ///< its key, for messages
  records::Plan plan;   ///< frozen()
};

/// The case set of the sections for the backends, on a machine and by a program of that environment
/// (records::Run::environment). Fails where one has no section, where they are of several case
/// sets, or where their records are of another version than this program's.
Result<CaseSet> case_set_for(const Side& baseline, const std::vector<std::string>& backends,
                             const std::map<std::string, std::string>& environment);

}  // namespace rastercheck::gate
