#pragma once

// Corrects part of a wrong drawing, to find out whether that part causes a law's violation: if so,
// the law holds for the corrected drawing.

#include <functional>
#include <set>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/fragments.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

using DrawnParts = std::set<records::DrawnPart>;

/// Returns the drawn part to which this kind of attribute belongs.
records::DrawnPart part_of(records::AttributeKind kind);

/// Returns true if a violation of the contract is to be corrected. The violation has class, kind,
/// place and attribute, and error or distance, but no texts.
using IsMeant = std::function<bool(const records::Violation&)>;

/// Corrects the selected violations in the drawing of a case without a camera: removes forbidden
/// samples, adds required ones, and replaces wrong numbers by the float32 nearest to the exact
/// value or to the middle of the permitted range. Added fragments have derivatives 0.
void put_right(const cases::Case& c, const cases::Contract& contract, const IsMeant& is_meant,
               cases::Fragments& drawn);
/// Corrects everything wrong with these parts.
void put_right(const cases::Case& c, const cases::Contract& contract, const DrawnParts& parts,
               cases::Fragments& drawn);

}  // namespace rastercheck::properties
