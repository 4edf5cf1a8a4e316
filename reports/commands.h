#pragma once

// The commands that reports name, as lines for a shell.

#include <string>
#include <vector>

#include "records/run.h"

namespace rastercheck::reports {

/// What does the run again. Of runs from before run.json had "options", with the same backends,
/// cases, seed and scene only.
std::string run_command(const records::Run& run);

/// What checks a counterexample of the run again, which is saved as `file`, in the same way.
std::string replay_command(const records::Run& run, const std::string& file);

/// What looks closely at one sample of a case that is saved as `file`, drawn as in the run.
std::string explain_command(const records::Run& run, const std::string& file,
                            const records::WorstError& place);

/// Any other command: its words as a shell reads them back.
std::string command_line(const std::vector<std::string>& all);

}  // namespace rastercheck::reports
