#pragma once

// The regression gate, as `rastercheck compare` and `rastercheck run --baseline` use it.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/error.h"
#include "cli/exit_code.h"
#include "records/run.h"
#include "reports/baseline.h"
#include "reports/policy.h"

namespace rastercheck::cli {

/// One side of a comparison.
struct GateSide {
  std::string file;                                ///< as the user named it
  std::optional<records::Run> run = std::nullopt;  ///< nothing of a baseline file
  reports::Baseline sections = {};
};

/// Reads a baseline file, a run.json that kept its cases, the folder of such a run, or standard
/// input for "-".
Result<GateSide> read_side(const std::string& file);
/// The same of a run that is at hand.
Result<GateSide> side_of(records::Run run, const std::string& file);

/// Gives the backend of the side another name in its sections; an empty one changes nothing.
/// Refuses sides of several backends.
Result<void> rename_backend(GateSide& side, const std::string& name);

/// Notes the commit that the side's sections are of.
void set_commit(GateSide& side, const std::string& commit);

struct GateOptions {
  reports::Policy policy;
  std::string output;  ///< folder for what compare_format.h lists; empty: none
  bool json = false;   ///< prints compare.json instead of text
  bool quiet = false;
  bool prints = true;
};

/// The policy of a file; of none, which has no name, one that allows nothing.
Result<reports::Policy> read_policy(const std::string& file);

/// Refuses a folder (GateOptions::output) where a file of the comparison would be written over one
/// of the files that it is made from.
Result<void> check_comparison_files(const std::string& folder, std::span<const std::string> inputs);

/// Compares, writes and prints, and tells GitHub; `regression` where an entry is worse that the
/// policy does not allow.
ExitCode hold_against(const GateSide& baseline, const GateSide& current,
                      const GateOptions& options);

/// What a run has to be, to be held against a baseline.
struct CaseSet {
  std::string section;  ///< its key, for messages
  std::uint64_t seed = 0;
  std::uint64_t cases_per_law = 0;
  std::vector<std::string> options;                             ///< reports::frozen_options
  std::optional<std::uint64_t> contract_digest = std::nullopt;  ///< as of sections
};

/// The case set of the sections for the backends, on a machine and by a program of that environment
/// (records::Run::environment). Fails where one has no section, where they are of several case
/// sets, or where their records are of another version than this program's.
Result<CaseSet> case_set_for(const GateSide& baseline, const std::vector<std::string>& backends,
                             const std::map<std::string, std::string>& environment);

/// Which of two outcomes a command ends with (CONTRACT, exit codes).
ExitCode first_of(ExitCode a, ExitCode b);

}  // namespace rastercheck::cli
