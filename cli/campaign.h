#pragma once

#include "cli/exit_code.h"
#include "cli/run_options.h"

namespace rastercheck::cli {

/// Carries out the campaign that the options ask for, writes and prints its findings, and, if a
/// baseline is given, compares them with the baseline. Returns the exit code of `rastercheck run`.
ExitCode run_campaign(RunOptions options, const IsGiven& is_given);

}  // namespace rastercheck::cli
