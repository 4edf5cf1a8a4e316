#pragma once

// Translates the rasterizer's traces into records/stage_trace.h.

#include <optional>

#include "cases/error.h"
#include "cases/sample_place.h"
#include "rasterizer/trace.h"
#include "records/stage_trace.h"

namespace rastercheck::backends {

rasterizer::SamplePlace sample_place(const cases::SamplePlace& at);

/// Translates a trace. Fails if the rasterizer refused to draw.
Result<std::optional<records::SampleTrace>> traced_sample(const rasterizer::TraceResult& traced);

}  // namespace rastercheck::backends
