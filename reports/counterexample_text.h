#pragma once

// Describes counterexamples, for a terminal.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "records/counterexample.h"

namespace rastercheck::reports {

/// Describes a counterexample over several lines: what failed and where, the exact and the actual
/// value, the surrounding pixels, the case's state and vertices, and the command that checks it
/// again (commands.h).
std::string counterexample_text(const records::Counterexample& counterexample,
                                const std::string& command);

/// The indented lines that show the case: pixels, state, vertices and triangles.
std::string case_text(const cases::Case& c);

/// The first line of case_text(): the pixels, and the state that differs from the defaults of a
/// case file.
std::string state_text(const cases::Case& c);

/// The x and y at which a vertex is seen, in pixels, or in units of the subpixel grid if the case
/// is snapped; "-" if w <= 0. Computed in double, for display only.
std::pair<std::string, std::string> window_text(const cases::Case& c, const cases::ClipVertex& p);

/// Lists violations as an indented table (text_table()). `violations` are the first of `all`.
std::string violations_text(std::span<const records::Violation> violations, std::uint64_t all,
                            std::optional<std::size_t> columns);

}  // namespace rastercheck::reports
