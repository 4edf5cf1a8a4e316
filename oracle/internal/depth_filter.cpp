#include "oracle/internal/depth_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/internal/next_double.h"

namespace rastercheck::oracle {

std::optional<double> placement_turn(const TriangleSetup& triangle) {
  constexpr double kUp = 1 + 0x1p-40;  // for roundings
  const double determinant = near_double(triangle.ideal.determinant());
  if (!(determinant > 0)) return std::nullopt;
  double rho = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double w = near_double(triangle.columns[i][2]);
    rho += w * triangle.edge_bands[i].to_interval().second / determinant;
  }
  rho *= kUp;
  return rho < 0.5 ? std::optional(rho) : std::nullopt;
}

std::optional<double> placement_radius(const TriangleSetup& triangle) {
  constexpr double kUp = 1 + 0x1p-40;  // for roundings
  const double reach = triangle.reach.to_interval().second;
  if (triangle.shape == Shape::cut) return reach;
  if (!triangle.is_triangle()) return std::nullopt;
  const std::optional<double> rho = placement_turn(triangle);
  if (!rho) return std::nullopt;
  double least_w = std::numeric_limits<double>::infinity();
  double greatest_w = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double w = near_double(triangle.columns[i][2]);
    least_w = std::min(least_w, w);
    greatest_w = std::max(greatest_w, w);
  }
  if (!(*rho * greatest_w * kUp < least_w)) return std::nullopt;
  return reach * (1 + 2 * *rho) / (1 - *rho) * kUp;
}

namespace {

/// Encloses the depths of a triangle's vertices, all of which have w > 0.
records::Enclosure vertex_depths(const TriangleSetup& triangle) {
  records::Enclosure depths{std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < 3; ++i) {
    const double depth = near_double(triangle.scene->depth_numerator(triangle.indices[i])) /
                         near_double(triangle.columns[i][2]);
    const double slack = std::abs(depth) * 0x1p-48;  // errors of two near_double() and a quotient
    depths.lo = std::min(depths.lo, depth - slack);
    depths.hi = std::max(depths.hi, depth + slack);
  }
  return depths;
}

}  // namespace

DepthFilter::DepthFilter(const TriangleSetup& triangle, const TriangleFilter& coverage)
    : box_(coverage.box()) {
  const ProjectiveMap* map = triangle.value_map();
  // Requires that this map's edges decide coverage: if they do not, covered samples may lie outside
  // its triangle, where a depth may be undefined.
  if (map != nullptr) {
    if (coverage.edges_of(map) != nullptr) set_line(triangle, *map, 0);
    return;
  }
  // Under conservative coverage, samples may lie outside every placement.
  const bool is_open = !triangle.scene->contract().conservative && triangle.promise.is_made &&
                       triangle.shape != Shape::exact && triangle.ideal.orientation() != 0 &&
                       coverage.has_first_level();
  if (!is_open) return;
  if (const std::optional<double> moved = placement_radius(triangle)) {
    set_line(triangle, triangle.ideal, *moved);
  } else if (triangle.shape == Shape::placed) {
    set_line(triangle, triangle.ideal, 0);
    if (line_) vertices_ = vertex_depths(triangle);
  }
}

/// Sets the line for a map's depths at points up to `moved` pixels from a sample.
void DepthFilter::set_line(const TriangleSetup& triangle, const ProjectiveMap& map, double moved) {
  const Scene& scene = *triangle.scene;
  // Sums of the line are multiples of 2^-656 (triangle_filter.cpp), and their band is at least
  // 2^-651 or 0. Within these limits of |det M|, both stay normal doubles when divided by it.
  constexpr double kLeast = 0x1p-300;
  constexpr double kMost = 0x1p300;
  const double determinant = near_double(map.determinant());
  if (determinant <= kLeast || determinant >= kMost) return;
  line_ = filter_line(map.combine({scene.depth_numerator(triangle.indices[0]),
                                   scene.depth_numerator(triangle.indices[1]),
                                   scene.depth_numerator(triangle.indices[2])}),
                      box_);
  if (!line_) return;
  // The line's value is off by the band at most. near_double, the reciprocal, the product and the
  // rounding of the ends add less than another band (proofs/depth.g).
  reciprocal_ = 1 / determinant;
  radius_ = 2 * line_->band * reciprocal_;
  if (moved > 0) {
    const double slope = (std::abs(line_->a) + std::abs(line_->b)) * reciprocal_;
    radius_ = (radius_ + moved * slope) * (1 + 0x1p-40);
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  range_ = {-kInfinity, kInfinity};
  if (scene.clamps_depth()) {
    range_ = {scene.clamp_least().to_double(), scene.clamp_greatest().to_double()};  // float32
  }
  if (scene.has_depth_bias()) {
    const std::optional<DepthOffset>& offset = triangle.depth_offset();
    offset_ = offset ? offset->near : records::Enclosure{-kInfinity, kInfinity};
  }
}

std::optional<records::Enclosure> DepthFilter::at(int x, int y,
                                                  const cases::SamplePosition& sample) const {
  if (!line_) return std::nullopt;
  const double u = x - box_.x0 + sample.x / 16.0;
  const double v = y - box_.y0 + sample.y / 16.0;
  const double depth = (line_->a * u + (line_->b * v + line_->c)) * reciprocal_;
  records::Enclosure depths{depth - radius_, depth + radius_};
  if (vertices_) {
    depths = {std::min(depths.lo, vertices_->lo), std::max(depths.hi, vertices_->hi)};
  }
  if (offset_.lo != 0 || offset_.hi != 0) {
    depths = {next_below(depths.lo + offset_.lo), next_above(depths.hi + offset_.hi)};
  }
  return records::Enclosure{std::clamp(depths.lo, range_.lo, range_.hi),
                            std::clamp(depths.hi, range_.lo, range_.hi)};
}

}  // namespace rastercheck::oracle
