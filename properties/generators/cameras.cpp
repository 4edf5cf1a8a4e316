// cameras: scenes as real programs draw them, with boxes, sheets and shards in front of a camera
// and around it. Projections are perspectives of any field of view with depth ratios up to 10^7,
// and infinite, reversed, oblique and orthographic ones. Some eyes lie in the planes of the
// triangles. The clip positions are computed exactly from the matrices and object positions, and
// rounded once.

#include <cassert>

#include "oracle/transform.h"
#include "properties/camera_cases.h"
#include "properties/generator.h"

namespace rastercheck::properties::cameras_generator {
namespace {

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 40;  // many scenes fill the framebuffer twice over
  const CameraCase made = camera_case(draw, request);
  const Result<cases::ClipCase> clip = oracle::to_clip_case(made.source, "");
  assert(clip.has_value());
  return *clip;
}

const GeneratorRegistration kRegistration(
    {"cameras", "models in front of and around perspective, orthographic and oblique cameras",
     &make});

}  // namespace
}  // namespace rastercheck::properties::cameras_generator
