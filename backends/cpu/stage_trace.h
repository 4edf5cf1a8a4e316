#pragma once

// The rasterizer's traces in the words of records/stage_trace.h.

#include <optional>

#include "cases/error.h"
#include "rasterizer/trace.h"
#include "records/stage_trace.h"

namespace rastercheck::backends {

rasterizer::SampleAddress sample_address(const records::SampleAddress& at);

/// Fails where the rasterizer refused to draw.
Result<std::optional<records::SampleTrace>> traced_sample(const rasterizer::TraceResult& traced);

}  // namespace rastercheck::backends
