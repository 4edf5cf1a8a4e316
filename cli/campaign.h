#pragma once

#include "cli/exit_code.h"
#include "cli/run_options.h"

namespace rastercheck::cli {

/// Carries out the campaign that the options ask for, writes and prints its findings, and holds it
/// against a baseline if one is given. Returns the exit code of `rastercheck run`.
ExitCode run_campaign(RunOptions options, const IsGiven& is_given);

}  // namespace rastercheck::cli
