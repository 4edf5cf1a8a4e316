#pragma once

// Random cases made for who is judged: what a backend does not draw is not asked of it, and what it
// draws keeps its frequency. Of a backend that draws everything no choice is made here, so that its
// cases are what they are without it.

#include "cases/capabilities.h"
#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

/// Rules, or a number of samples, that the backend has: what was chosen, else another one.
cases::Rules fitting_rules(Draw& draw, cases::Rules chosen);
int fitting_samples(Draw& draw, int chosen);

/// Leaves a feature out of a case, or replaces it by what a backend has; false where that would be
/// another picture.
bool leave_out(cases::Case& c, cases::Feature feature, const cases::Capabilities& has);

/// Fits what a case has besides vertices. Where generators call it, vertices still come out where
/// they are meant to be of the window.
void fit_state(Draw& draw, cases::Case& c);

/// Fits a whole case: state that was changed since, vertices and values. Vertices behind the eye or
/// beyond a depth plane that may not be there come before it, and numbers beyond what is promised
/// get an exponent within it.
void fit_case(Draw& draw, cases::Case& c);

}  // namespace rastercheck::properties
