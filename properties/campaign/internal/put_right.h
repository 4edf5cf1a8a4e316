#pragma once

// A drawing with part of what is wrong with it put right, so that it can be tried whether that part
// is why a law is violated: if it is, the law holds of what is left.

#include <set>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/fragments.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

using DrawnParts = std::set<records::DrawnPart>;

/// Puts right what the contract does not allow of these parts of a drawing of a case without a
/// camera: samples that must not be drawn are taken out, those that have to be are put in, and
/// wrong numbers become the float32 nearest to the exact ones, or to the middle of what is
/// permitted. Fragments that are put in have derivatives 0.
void put_right(const cases::Case& c, const cases::Contract& contract, const DrawnParts& parts,
               cases::Fragments& drawn);

}  // namespace rastercheck::properties
