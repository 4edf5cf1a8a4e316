#pragma once

// The rasterizer's traces in the words of records/stage_trace.h.

#include <optional>

#include "cases/error.h"
#include "cases/sample_place.h"
#include "rasterizer/trace.h"
#include "records/stage_trace.h"

namespace rastercheck::backends {

rasterizer::SamplePlace sample_place(const cases::SamplePlace& at);

/// Fails where the rasterizer refused to draw.
Result<std::optional<records::SampleTrace>> traced_sample(const rasterizer::TraceResult& traced);

}  // namespace rastercheck::backends
