#include "oracle/internal/depth_filter.h"

#include <algorithm>
#include <limits>

namespace rastercheck::oracle {

DepthFilter::DepthFilter(const TriangleSetup& triangle, const TriangleFilter& coverage)
    : box_(coverage.box()) {
  const ProjectiveMap* map = triangle.value_map();
  // Else samples may be covered that lie outside the map's triangle, where a depth may be
  // undefined.
  if (map == nullptr || coverage.edges_of(map) == nullptr) return;
  const Scene& scene = *triangle.scene;
  // Sums of the line are multiples of 2^-656 (triangle_filter.cpp), their band is at least 2^-651
  // or 0: within these limits both stay normal doubles when divided.
  constexpr double kLeast = 0x1p-300;
  constexpr double kMost = 0x1p300;
  const double determinant = near_double(map->determinant());
  if (determinant <= kLeast || determinant >= kMost) return;
  line_ = filter_line(map->combine({scene.depth_numerator(triangle.indices[0]),
                                    scene.depth_numerator(triangle.indices[1]),
                                    scene.depth_numerator(triangle.indices[2])}),
                      box_);
  if (!line_) return;
  // The line's value is off by the band at most; what near_double, the reciprocal, the product and
  // the ends' rounding add is less than another one (proofs/depth.g).
  reciprocal_ = 1 / determinant;
  radius_ = 2 * line_->band * reciprocal_;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  range_ = {-kInfinity, kInfinity};
  if (scene.clamps_depth()) {
    range_ = {scene.least_depth().to_double(), scene.greatest_depth().to_double()};  // float32
  }
}

std::optional<records::Enclosure> DepthFilter::at(int x, int y,
                                                  const cases::SamplePosition& sample) const {
  if (!line_) return std::nullopt;
  const double u = x - box_.x0 + sample.x / 16.0;
  const double v = y - box_.y0 + sample.y / 16.0;
  const double depth = (line_->a * u + (line_->b * v + line_->c)) * reciprocal_;
  return records::Enclosure{std::clamp(depth - radius_, range_.lo, range_.hi),
                            std::clamp(depth + radius_, range_.lo, range_.hi)};
}

}  // namespace rastercheck::oracle
