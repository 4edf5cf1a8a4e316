#pragma once

// Groups counterexamples by fault. One wrong line of a rasterizer breaks a dozen laws, each under
// several conditions; the developer wants to see one cause.
//
// Two counterexamples share a cause if, according to their explanations (records::Explanation),
// both conditions hold:
//
//   1. Their laws hold once the same part of the drawing (coverage, depth or values) is corrected.
//      If no such part exists, each must violate the other's law, too; the fault is then before or
//      after the fragments, not in them.
//   2. They do not need different features. Two sets of counterexamples have different causes if
//      each set needs a feature that the other does without, or if only one of them needs a feature
//      that can be removed without moving a vertex, such as a scissor. A counterexample moves to
//      another set if it needs what that set needs, but not what its own set needs.
//
// Two sets also share a cause, whatever part is wrong, if one simple change ("the scissor's ends
// are drawn, too") makes at least half of the wrong drawings of each set right. Counterexamples
// that did not fail again form one cause. A few counterexamples join a larger set if they need
// everything that most of that set needs. Features that follow from a counterexample's condition
// (internal/failure.h) do not show that two causes differ: shrinking keeps the condition, and so
// these features.
//
// So two faults in the same part are told apart only if they need different features. If both break
// that part of every case, they count as one cause. docs/when-it-fails.md says how often the
// grouping is right.

#include <vector>

#include "records/cause.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// Returns the causes of a run's counterexamples (each must have `found`), largest group first,
/// wrong signs of zeros last. Counterexamples without an explanation are grouped by how they fail.
std::vector<records::Cause> causes_of(const std::vector<records::Counterexample>& all);

}  // namespace rastercheck::properties
