#pragma once

// The rasterizer's traces in the words of records/stage_trace.h.

#include "rasterizer/trace.h"
#include "records/stage_trace.h"

namespace rastercheck::backends {

records::SampleTrace sample_trace(const rasterizer::Trace& trace);

}  // namespace rastercheck::backends
