#pragma once

// Describes the causes that a run's counterexamples share, for a terminal.

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

/// "samples are missing where depth is clamped: 12 counterexamples of 7 properties". If the run has
/// several backends, also names those concerned.
std::string cause_line(const records::Run& run, const records::Cause& cause);

/// "it draws as if y points the other way (11 of 12 wrong drawings)"; empty without a hint.
std::string hint_text(const records::Cause& cause);

/// The indices of counterexamples without a cause. Runs from before causes existed have only these.
std::vector<std::size_t> without_cause(const records::Run& run);

using CommandOf = std::function<std::string(const records::Counterexample&)>;

/// Describes all causes, those with the most counterexamples first: a sentence for each, the
/// attempts to explain it, and its smallest counterexample.
std::string causes_text(const records::Run& run, const CommandOf& command_of);

/// The last lines of a run's output: the number of causes, then a line and a command for each.
std::string causes_list(const records::Run& run, const CommandOf& command_of);

}  // namespace rastercheck::reports
