#pragma once

// A drawing with part of what is wrong with it put right, so that it can be tried whether that part
// is why a law is violated: if it is, the law holds of what is left.

#include <functional>
#include <set>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/fragments.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

using DrawnParts = std::set<records::DrawnPart>;

/// The part that a violation of the contract is of.
records::DrawnPart part_of(records::AttributeKind kind);

/// Asked of a violation of the contract whether it is to be put right. It has class, kind, place
/// and attribute, and error or distance; no words.
using IsMeant = std::function<bool(const records::Violation&)>;

/// Puts right what the contract does not allow of a drawing of a case without a camera, as far as
/// it is meant: samples that must not be drawn are taken out, those that have to be are put in, and
/// wrong numbers become the float32 nearest to the exact ones, or to the middle of what is
/// permitted. Fragments that are put in have derivatives 0.
void put_right(const cases::Case& c, const cases::Contract& contract, const IsMeant& is_meant,
               cases::Fragments& drawn);
/// Puts right all that is wrong with these parts.
void put_right(const cases::Case& c, const cases::Contract& contract, const DrawnParts& parts,
               cases::Fragments& drawn);

}  // namespace rastercheck::properties
