#include "properties/inspect/case_to_draw.h"

#include "oracle/transform.h"

namespace rastercheck::properties {

Result<cases::ClipCase> case_to_draw(const cases::Case& c) {
  Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (clip) clip->depth_test = cases::DepthTest::none;
  return clip;
}

TracedSample trace_sample(const cases::ClipCase& c, const cases::SamplePlace& at,
                          backends::Backend& backend) {
  backends::Tracer* const tracer = backend.tracer();
  if (tracer == nullptr) return tl::unexpected(Error{"", "", "the backend does not trace"});
  return tracer->trace(c, at);
}

}  // namespace rastercheck::properties
