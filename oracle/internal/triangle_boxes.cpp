#include "oracle/internal/triangle_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "oracle/internal/number.h"

namespace rastercheck::oracle {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();

/// How far from the exact triangle to look for covered samples, in pixels: as far as the contract
/// lets them be, and at least one pixel more.
double spread_of(const SceneTruth& scene, const cases::TrianglePromise& promise) {
  const cases::Contract& contract = scene.contract();
  double spread = 1;  // a margin of one pixel
  if (!contract.coverage) return spread;
  spread += std::ldexp(1 + promise.position_error + promise.clip_tolerance + promise.side_tolerance,
                       -contract.coverage->subpixel_bits);
  if (contract.has_open_viewport()) {
    // The moves of vertices grow with the viewport (TriangleSetup::open_viewport).
    spread = spread * cases::most_growth(scene.source().viewport, contract.viewport_error) +
             contract.viewport_error + 1;
  }
  return spread;
}

/// A box that holds all samples that a triangle may cover.
PixelBox box_of(const SceneTruth& scene, std::size_t triangle,
                const cases::TrianglePromise& promise) {
  const cases::Case& source = scene.source();
  const PixelBox all{0, 0, source.framebuffer.width, source.framebuffer.height};
  if (source.camera) return all;
  const double spread = spread_of(scene, promise);
  const cases::Viewport& viewport = source.viewport;
  // Halves may be negative, as a viewport may be either way round.
  const std::array<double, 2> half{viewport.width / 2.0, viewport.height / 2.0};
  const std::array<double, 2> middle{viewport.x + half[0], viewport.y + half[1]};
  std::array<double, 2> least{kFarAway, kFarAway};
  std::array<double, 2> greatest{-kFarAway, -kFarAway};
  for (const std::uint32_t vertex : source.triangles[triangle]) {
    const cases::ClipVertex& p = source.positions[vertex];
    if (!(exact_double(p.w) > 0)) return all;
    const std::array<double, 2> clip{exact_double(p.x), source.rules == cases::Rules::d3d
                                                            ? -exact_double(p.y)
                                                            : exact_double(p.y)};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double share = clip[axis] / exact_double(p.w) * half[axis];
      // Far more than the roundings can add in any rounding mode.
      const double slack = (std::abs(share) + std::abs(middle[axis])) * 0x1p-40;
      const double at = middle[axis] + share;
      if (!std::isfinite(at)) return all;
      least[axis] = std::min(least[axis], at - slack);
      greatest[axis] = std::max(greatest[axis], at + slack);
    }
  }
  const auto pixel = [](double at, int most) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, static_cast<double>(most)));
  };
  return {pixel(least[0] - spread, all.x1), pixel(least[1] - spread, all.y1),
          pixel(greatest[0] + spread + 1, all.x1), pixel(greatest[1] + spread + 1, all.y1)};
}

}  // namespace

std::vector<PixelBox> boxes_of_triangles(const SceneTruth& scene) {
  const cases::Case& source = scene.source();
  std::vector<PixelBox> boxes;
  boxes.reserve(source.triangles.size());
  for (std::size_t t = 0; t < source.triangles.size(); ++t) {
    const cases::TrianglePromise promise = cases::promise_of(scene.contract(), source, t);
    boxes.push_back(promise.is_made ? box_of(scene, t, promise) : PixelBox{0, 0, 0, 0});
  }
  return boxes;
}

int rows_of_band(const cases::FramebufferSize& size) {
  constexpr int kSamples = 65536;
  return std::clamp(kSamples / (size.width * size.samples), 1, 64);
}

}  // namespace rastercheck::oracle
