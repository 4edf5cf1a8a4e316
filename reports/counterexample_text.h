#pragma once

// Counterexamples for people, on a terminal.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "records/counterexample.h"

namespace rastercheck::reports {

/// A counterexample over several lines: what failed and where, exact and actual value, the pixels
/// around it, the case's state and vertices, and the command that checks it again (commands.h).
std::string counterexample_text(const records::Counterexample& counterexample,
                                const std::string& command);

/// The part of it that shows the case: pixels, state, vertices, triangles; indented lines.
std::string case_text(const cases::Case& c);

/// Its first line: the pixels, and of the state what is not as a case file has it by default.
std::string state_text(const cases::Case& c);

/// Where a vertex is seen, x and y: pixels, or, where it is snapped, units of the subpixel grid;
/// "-" where w <= 0. In double: to look at.
std::pair<std::string, std::string> window_text(const cases::Case& c, const cases::ClipVertex& p);

/// Violations as a table (text_table), indented; `all` is how many there are, of which these are
/// the first.
std::string violations_text(std::span<const records::Violation> violations, std::uint64_t all,
                            std::optional<std::size_t> columns);

}  // namespace rastercheck::reports
