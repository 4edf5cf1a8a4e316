#pragma once

// Adapts random cases to the judged backend: leaves out features that the backend lacks and keeps
// the frequency of all others. If the backend draws everything, no random choice is made and cases
// stay as they are.

#include "cases/capabilities.h"
#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

/// The greatest size within the capabilities that is no larger than the given one; the least that
/// they allow if there is none.
cases::FramebufferSize fitted_size(const cases::Capabilities& has, cases::FramebufferSize size);

/// Returns `chosen` if the backend supports it, else a random supported value.
cases::Rules fitting_rules(Draw& draw, cases::Rules chosen);
int fitting_samples(Draw& draw, int chosen);

/// Removes a feature from a case, or replaces it by one that the backend has; false if neither is
/// possible.
bool leave_out(cases::Case& c, cases::Feature feature, const cases::Capabilities& has);

/// Fits everything except vertices. Generators call this before they place vertices, so that
/// vertices land at their intended window positions.
void fit_state(Draw& draw, cases::Case& c);

/// Fits a whole case: vertices, values, and state changed since fit_state(). Vertices that the
/// backend does not support (behind the eye, beyond a side or a depth plane) are moved into view,
/// and numbers beyond the promised range get an exponent within it.
void fit_case(Draw& draw, cases::Case& c);

}  // namespace rastercheck::properties
