#pragma once

// What the counterexamples of a run have in common, for a terminal.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "records/cause.h"
#include "records/counterexample.h"
#include "records/run.h"

namespace rastercheck::reports {

/// "35 counterexamples, 8 causes"; "1 counterexample, 1 cause".
std::string cause_counts(const records::Run& run);

/// "samples are missing where depth is clamped: 12 counterexamples of 7 properties"; of a run of
/// several backends on which.
std::string cause_line(const records::Run& run, const records::Cause& cause);

/// Places of counterexamples that are of no cause, as in runs of before there were any.
std::vector<std::size_t> without_cause(const records::Run& run);

using CommandOf = std::function<std::string(const records::Counterexample&)>;

/// All causes, those of most counterexamples first: each in a sentence, with what was tried of it
/// and its smallest counterexample.
std::string causes_text(const records::Run& run, const CommandOf& command_of);

/// The last lines of a run: how many there are, and a line and a command of each.
std::string causes_list(const records::Run& run, const CommandOf& command_of);

}  // namespace rastercheck::reports
