// Computed clip positions against the exact ones (cases::Contract::transform_bound). Positions, and
// the sizes |P| |V| |M| |p| of what they are sums of, are in the ring: nothing is divided.

#include <algorithm>
#include <cmath>

#include "oracle/internal/floating_point.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/transform.h"

namespace rastercheck::oracle {
namespace {

using records::FragmentClass;

/// The same case with the size of every number of camera and positions.
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

/// The exponent of ulp(f), f finite.
int ulp_exponent(float f) { return f == 0 ? -149 : std::max(std::ilogb(f), -126) - 23; }

JudgedCoordinate judge_infinity(const Ring& exact, const Ring& beyond, bool is_negative) {
  // Half an ulp below 2^128: from there on numbers round to infinity.
  const Ring least = Ring(0x1p128) - Ring(0x1p103) - beyond;
  const Ring outwards = is_negative ? Ring(-exact) : exact;
  JudgedCoordinate judged;
  if (outwards < least) judged.fragment_class = FragmentClass::infinite;
  return judged;
}

JudgedCoordinate judge_number(const Ring& exact, const Ring& beyond, float f) {
  const int exponent = ulp_exponent(f);
  const Ring half_ulp(std::ldexp(1.0, exponent - 1));
  const Ring error = exact_ring(f) - exact;
  const Ring allowed = beyond + half_ulp;
  const Ring per_ulp(std::ldexp(1.0, -exponent));
  JudgedCoordinate judged;
  if (allowed < magnitude(error)) judged.fragment_class = FragmentClass::beyond_bound;
  judged.error = enclose(Ring(error * per_ulp));
  judged.bound = enclose(Ring(allowed * per_ulp));
  judged.is_cancelled = half_ulp < beyond;
  return judged;
}

JudgedCoordinate judge_coordinate(const Ring& exact, const Ring& size, float bound, float f) {
  const Ring beyond = exact_ring(bound) * Ring(0x1p-53) * size;
  JudgedCoordinate judged;
  if (std::isnan(f)) {
    judged.fragment_class = FragmentClass::not_a_number;
  } else if (std::isinf(f)) {
    judged = judge_infinity(exact, beyond, std::signbit(f));
  } else {
    judged = judge_number(exact, beyond, f);
  }
  judged.exact = to_rational(Field(exact));
  return judged;
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
      judged[v][k] =
          judge_coordinate(exact[v][axis], sizes[v][axis], transform_bound, coordinates[k]);
    }
  }
  return judged;
}

}  // namespace rastercheck::oracle
