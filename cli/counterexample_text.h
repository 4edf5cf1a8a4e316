#pragma once

#include <string>

#include "records/counterexample.h"

namespace rastercheck::cli {

/// A counterexample for people, over several lines: what failed and where, exact and actual value,
/// the pixels around it, the case's state and vertices, and the command that checks it again.
/// `file` is where it is saved.
std::string counterexample_text(const records::Counterexample& counterexample,
                                const std::string& file);

/// The part of it that shows the case: pixels, state, vertices, triangles; indented lines.
std::string case_text(const cases::Case& c);

}  // namespace rastercheck::cli
