#include "rasterizer/internal/point_shape.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {

PointShape::PointShape(const State& state, const WindowColumn& center, int tie_sign)
    : center_(center), near_(center.near()), size_(state.point_size), tie_sign_(tie_sign) {}

/// The sign of |2u w − X| − size · w; sets `side` to the sign of 2u w − X where that is 0.
int PointShape::compare_with_size(std::size_t axis, double position, int& side) const {
  const double away = std::abs(position - near_[axis]) - size_;
  const double error = 0x1p-48 * (std::abs(position) + std::abs(near_[axis]) + size_);
  if (std::abs(away) > error) return away > 0 ? 1 : -1;
  ExactSum offset;
  offset.add_product(center_.w, position);
  offset.add_product(center_.at[axis], -1);
  side = offset.sign();
  ExactSum over;
  over.add_product(offset, side);
  over.add_product(center_.w, -size_);
  return over.sign();
}

bool PointShape::covers(const HalfPixels& p) const {
  int side_x = 0;
  int side_y = 0;
  const int over_x = compare_with_size(0, p[0], side_x);
  const int over_y = compare_with_size(1, p[1], side_y);
  if (over_x > 0 || over_y > 0) return false;
  // The inward normal of a side points against the offset.
  const bool owns_x = over_x < 0 || side_x < 0;
  const bool owns_y = over_y < 0 || tie_sign_ * -side_y > 0;
  return owns_x && owns_y;
}

PixelBox PointShape::box(const PixelBox& bounds) const {
  const auto range = [this](const PixelRange& pixels, std::size_t axis) {
    const double reach = size_ / 2 + 1;
    return pixels_from_through(pixels, 0.5, near_[axis] / 2 - reach, near_[axis] / 2 + reach);
  };
  return {range(bounds.columns, 0), range(bounds.rows, 1)};
}

}  // namespace rastercheck::rasterizer
