#pragma once

// How a case is drawn to be inspected.

#include <optional>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/clip_case.h"
#include "cases/error.h"
#include "cases/sample_place.h"
#include "records/stage_trace.h"

namespace rastercheck::properties {

/// Returns the case with its clip positions (oracle/transform.h) and without the depth test, which
/// does not affect how a single triangle is drawn. Fails if a clip position overflows.
Result<cases::ClipCase> case_to_draw(const cases::Case& c);

/// The trace of a sample (backends::Tracer); an error if the backend has none.
using TracedSample = Result<std::optional<records::SampleTrace>>;
TracedSample trace_sample(const cases::ClipCase& c, const cases::SamplePlace& at,
                          backends::Backend& backend);

}  // namespace rastercheck::properties
