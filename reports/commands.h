#pragma once

// The shell commands that reports show.

#include <string>
#include <vector>

#include "records/run.h"

namespace rastercheck::reports {

/// The command that repeats the run. A run.json written before "options" existed gives only the
/// same backends, cases, seed and scene.
std::string run_command(const records::Run& run);

/// The command that checks a counterexample of the run again, in the same way as the run. The
/// counterexample must be saved as `file`.
std::string replay_command(const records::Run& run, const std::string& file);

/// The command that checks a case of the run on a backend, in the same way as the run. The case
/// must be saved as `file`.
std::string replay_command(const records::Run& run, const std::string& file,
                           const std::string& backend);

/// The command that explains one sample of a case, drawn as in the run. The case must be saved as
/// `file`.
std::string explain_command(const records::Run& run, const std::string& file,
                            const records::WorstError& place);

/// Joins the words of any other command, quoted for a shell.
std::string command_line(const std::vector<std::string>& all);

}  // namespace rastercheck::reports
