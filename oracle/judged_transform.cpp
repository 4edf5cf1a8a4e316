// Judges computed clip positions (cases::Contract::transform_bound). Positions and the sizes |P|
// |V| |M| |p| of their terms are in the ring: nothing is divided.

#include "oracle/judged_transform.h"

#include <cmath>

#include "oracle/internal/floating_point.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"

namespace rastercheck::oracle {
namespace {

/// Returns the camera and positions of `c` with every number replaced by its magnitude.
cases::Case with_magnitudes(const cases::Case& c) {
  cases::Case sizes;
  sizes.camera = c.camera;
  sizes.positions = c.positions;
  if (sizes.camera) {
    for (cases::Matrix4* matrix :
         {&sizes.camera->model, &sizes.camera->view, &sizes.camera->projection}) {
      for (float& number : *matrix) number = std::fabs(number);
    }
  }
  for (cases::ClipVertex& p : sizes.positions) {
    p = {std::fabs(p.x), std::fabs(p.y), std::fabs(p.z), std::fabs(p.w)};
  }
  return sizes;
}

}  // namespace

std::vector<JudgedPosition> judge_transform(const cases::Case& c,
                                            std::span<const cases::ClipVertex> computed,
                                            float transform_bound) {
  const DefaultFloatingPoint modes;
  const std::vector<RingVector4> exact = clip_positions(c);
  const std::vector<RingVector4> sizes = clip_positions(with_magnitudes(c));
  std::vector<JudgedPosition> judged(computed.size());
  for (std::size_t v = 0; v < computed.size(); ++v) {
    const cases::ClipVertex& p = computed[v];
    const std::array<float, 4> coordinates{p.x, p.y, p.z, p.w};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const Field allowed(exact_ring(transform_bound) * Ring(0x1p-53) * sizes[v][axis]);
      judged[v][k] =
          judge_number(to_rational(Field(exact[v][axis])), to_rational(allowed), coordinates[k]);
    }
  }
  return judged;
}

}  // namespace rastercheck::oracle
