#include "rasterizer/internal/certificates.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

constexpr double kUnit = 0x1p-53;

double size_of(const std::array<double, 3>& e) {
  return std::abs(e[0]) + std::abs(e[1]) + std::abs(e[2]);
}

}  // namespace

bool Certificates::is_smooth_certain(const std::array<double, 3>& e) const {
  const double sum = e[0] + e[1] + e[2];
  return sum > 0x1p32 * (band_sum + 8 * kUnit * size_of(e));
}

bool Certificates::is_affine_certain(const std::array<double, 3>& e, double det_t) const {
  const bool is_covered = size_of(e) == e[0] + e[1] + e[2];
  return affine_is_certain && is_covered && affine_error * 0x1p32 <= det_t;
}

Certificates certify(const Weights& weights, const std::array<double, 3>& w,
                     const std::array<double, 3>& z) {
  Certificates certificates;
  double plane_band_sum = 0;
  double depth_error = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeFunction& edge = weights.edges[i];
    certificates.band_sum += edge.band;
    plane_band_sum += edge.plane_band;
    certificates.affine_error += std::abs(w[i]) * edge.plane_band;
    depth_error += std::abs(z[i]) * edge.plane_band;
  }
  certificates.least_sum = kSmoothCertainty * plane_band_sum;
  // If all w > 0, the w_i E_i are >= 0 inside the triangle and sum to |det| T, so nothing cancels.
  // Otherwise values linear in the window get no certificate.
  const bool all_in_front =
      std::all_of(w.begin(), w.end(), [](double weight) { return weight > 0; });
  certificates.affine_is_certain =
      all_in_front && certificates.affine_error * kAffineCertainty <= weights.det_t;
  certificates.depth_is_certain = depth_error * kDepthCertainty <= weights.det_t;
  return certificates;
}

}  // namespace rastercheck::rasterizer
