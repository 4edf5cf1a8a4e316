#include "cases/contract.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "cases/case.h"

namespace rastercheck::cases {

bool Contract::is_affine(Interpolation declared) const {
  return declared == Interpolation::noperspective ||
         (declared == Interpolation::smooth && claims == Claim::affine);
}

double depth_step(DepthFormat format) {
  const auto step = [](double steps) { return 1 / steps * (1 + 0x1p-51); };
  switch (format) {
    case DepthFormat::float32:
    case DepthFormat::float64:
      return 0;
    case DepthFormat::unorm16:
      return step(0x1p16 - 1);
    case DepthFormat::unorm24:
      return step(0x1p24 - 1);
    case DepthFormat::unorm32:
      return step(0x1p32 - 1);
  }
  return 0;
}

double most_growth(const Viewport& viewport, double error) {
  const double size = std::min(std::fabs(viewport.width), std::fabs(viewport.height));
  // If the difference loses digits, it is exact (Sterbenz 1974); two more roundings follow.
  const double least = size - 2 * error;
  return least > 0 ? size / least * (1 + 0x1p-48) : std::numeric_limits<double>::infinity();
}

TrianglePromise promise_of(const Contract& contract, const Case& c, std::size_t triangle) {
  TrianglePromise promise;
  if (contract.triangles.empty()) {
    promise.position_error = contract.coverage ? contract.coverage->position_error : 0;
    promise.clip_tolerance = contract.clip_tolerance;
    promise.clip_error = contract.clip_error;
    promise.bounds = contract.bounds;
  } else {
    promise = contract.triangles[triangle];
  }
  if (contract.has_open_viewport()) {
    promise.is_made =
        promise.is_made && std::isfinite(most_growth(c.viewport, contract.viewport_error));
  }
  if (c.camera) return promise;
  const auto has = [&contract](float number) { return contract.numbers.has(number); };
  for (const std::uint32_t vertex : c.triangles[triangle]) {
    const ClipVertex& p = c.positions[vertex];
    const auto distances = c.clip_distances_of(vertex);
    promise.is_made = promise.is_made && has(p.x) && has(p.y) && has(p.z) && has(p.w) &&
                      std::all_of(distances.begin(), distances.end(), has);
  }
  return promise;
}

bool promises_values_of(const Contract& contract, const Case& c, std::size_t triangle,
                        std::size_t attribute) {
  // Flat attributes are copied, not computed.
  if (c.attributes[attribute].interpolation == Interpolation::flat) return true;
  const Triangle& vertices = c.triangles[triangle];
  return std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t vertex) {
    return contract.numbers.has(c.attributes_of(vertex)[attribute]);
  });
}

bool promises_depth_range_of(const Contract& contract, const Case& c) {
  return contract.numbers.has(c.viewport.min_depth) && contract.numbers.has(c.viewport.max_depth);
}

bool promises_all_of(const Contract& contract, const Case& c) {
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    if (!promise_of(contract, c, t).is_made) return false;
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      if (!promises_values_of(contract, c, t, a)) return false;
    }
  }
  return promises_depth_range_of(contract, c);
}

Contract contract_of(const Case& c) {
  Contract contract;
  contract.coverage = c.coverage;
  contract.basis = c.coverage ? c.basis : Basis::ideal;
  contract.tie_rule = c.fill_rule;
  contract.depth_format = c.depth_format;
  if (c.rules == Rules::d3d) contract.depth_bias.unit = BiasUnit::least_value;
  return contract;
}

}  // namespace rastercheck::cases
