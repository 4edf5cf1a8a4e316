#pragma once

// Which of many counterexamples are of one fault. One wrong line of a rasterizer breaks a dozen
// laws under several conditions each; whoever mends it wants to be told of one thing.
//
// What was tried of each (records::Explanation) decides. Counterexamples are of one cause if
//
//   1. the same part of drawings has to be put right for their laws to hold (coverage, depth,
//      values); or none does, and each violates the other's law, too: what is wrong is then not in
//      fragments, but in what is made of them, or in what they are made of;
//   2. they do not need different things. Two sets of which each needs something that the other
//   does
//      without are two causes; so are a set that needs a scissor, or anything else that moves no
//      vertex, and a set that does without.
//
// A condition that a counterexample was kept for does not count as a need. A few counterexamples
// that need all that most of a larger set need are added to that set. So faults are told apart
// where they need different things, and only there: two that are wrong in the same part of every
// case are one cause. docs/when-it-fails.md says how often this is right.

#include <vector>

#include "records/cause.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// The causes of a run's counterexamples, each of which has `found`: those of most first; of wrong
/// signs of zeros last. One that nothing was tried of is told apart by the way in which it fails.
std::vector<records::Cause> causes_of(const std::vector<records::Counterexample>& all);

}  // namespace rastercheck::properties
