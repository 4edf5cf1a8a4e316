// cameras: what programs draw through one: boxes, sheets and shards before and around it,
// perspectives of any field of view and depths up to 10^7 apart, infinite, reversed, oblique and
// orthographic ones, and an eye within the triangles' own planes. The clip positions are those of
// the matrices and object positions, computed exactly and rounded once.

#include <cassert>

#include "oracle/transform.h"
#include "properties/camera_cases.h"
#include "properties/generator.h"

namespace rastercheck::properties::cameras_generator {
namespace {

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 40;  // many of these fill the whole of it, twice over
  const CameraCase made = camera_case(draw, request);
  const Result<cases::ClipCase> clip = oracle::to_clip_case(made.source, "");
  assert(clip.has_value());
  return *clip;
}

const GeneratorRegistration kRegistration(
    {"cameras", "models before perspective, orthographic and oblique cameras, and around them",
     &make});

}  // namespace
}  // namespace rastercheck::properties::cameras_generator
