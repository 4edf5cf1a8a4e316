#pragma once

// Says what is wrong with a drawing, where, and how badly, in units that readers know.

#include <string>

#include "cases/case.h"
#include "records/counterexample.h"
#include "records/judgement.h"

namespace rastercheck::reports {

/// "attribute 'u'", "attribute 1", "depth": the violation's value.
std::string finding_value(const records::Violation& violation, const cases::Case& source);

/// "pixel (3, 5) of triangle 0"; names the sample if there are several.
std::string finding_place(const records::Violation& violation, const cases::Case& source);

/// Says what was drawn and what must be drawn: "attribute 'u' was drawn as 0.143 and must be 0.161
/// to 0.164", "the sample is not drawn and must be". Numbers have just enough digits to tell them
/// apart. If nothing was drawn, says why.
std::string finding_fault(const records::Violation& violation, const cases::Case& source);

/// How bad the fault is: "off by 1/18 of the attribute's range (2.3 million scale ULP, 0.5
/// allowed)", "0.25 pixels from the boundary". Empty if unknown.
std::string finding_severity(const records::Violation& violation, const cases::Case& source);

/// Place, fault, severity and the law's note, if any, as a sentence without a full stop. Only the
/// fault if the violation has no place.
std::string finding_text(const records::Violation& violation, const cases::Case& source);

}  // namespace rastercheck::reports
