#include "rasterizer/internal/line_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rastercheck::rasterizer {
namespace {

ExactSum negative(const ExactSum& sum) {
  ExactSum turned;
  turned.add_product(sum, -1);
  return turned;
}

/// a b − c d.
ExactSum difference_of_products(const ExactSum& a, const ExactSum& b, const ExactSum& c,
                                const ExactSum& d) {
  ExactSum sum;
  sum.add_product(a, b);
  sum.add_product(negative(c), d);
  return sum;
}

std::array<ExactSum, 2> direction_of(const std::array<WindowColumn, 2>& ends) {
  const auto& [a, b] = ends;
  return {difference_of_products(a.w, b.at[0], b.w, a.at[0]),
          difference_of_products(a.w, b.at[1], b.w, a.at[1])};
}

std::size_t major_axis(const std::array<ExactSum, 2>& direction) {
  ExactSum difference;  // |d_x| − |d_y|
  difference.add_product(direction[0], direction[0].sign());
  difference.add_product(direction[1], -direction[1].sign());
  return difference.sign() < 0 ? 1 : 0;
}

/// The nearest whole number of pixels to a width, at least 1; beyond every framebuffer, any.
int whole_width(float width) {
  return static_cast<int>(std::clamp(std::floor(double{width} + 0.5), 1.0, 4.0 * kMaxSize));
}

double nearest(ExactSum sum) { return sum.nearest(); }

/// A sum times 2^exponent.
ExactSum scaled(const ExactSum& sum, int exponent) {
  ExactSum result;
  for (const double component : sum.components()) result.add(std::ldexp(component, exponent));
  return result;
}

}  // namespace

LineWeights line_weights(const std::array<WindowColumn, 2>& ends, LineMode mode) {
  LineWeights weights;
  weights.direction = direction_of(ends);
  if (mode == LineMode::parallelogram) {
    weights.direction[1 - major_axis(weights.direction)] = ExactSum();
  }
  const auto& n = weights.direction;
  // g_k times `sign`
  const auto functional = [&n](const WindowColumn& end, double sign) {
    std::array<ExactSum, 3> sums;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      ExactSum turned;
      turned.add_product(n[axis], sign);
      sums[axis].add_product(turned, end.w);
      sums[2].add_product(negative(turned), end.at[axis]);
    }
    return ExactPlane(sums[0], sums[1], sums[2]);
  };
  weights.e = {functional(ends[1], -1), functional(ends[0], 1)};
  return weights;
}

LineShape::LineShape(const State& state, const std::array<WindowColumn, 2>& ends, int tie_sign)
    : state_(state),
      tie_sign_(tie_sign),
      ends_(ends),
      weights_(line_weights(ends, state.line_mode)),
      direction_(direction_of(ends)),
      major_(major_axis(direction_)),
      copies_(whole_width(state.line_width)) {
  const auto& [a, b] = ends_;
  // M's coefficients are the cross product of the columns.
  middle_ = ExactPlane(difference_of_products(a.at[1], b.w, b.at[1], a.w),
                       difference_of_products(b.at[0], a.w, a.at[0], b.w),
                       difference_of_products(a.at[0], b.at[1], b.at[0], a.at[1]));
  for (std::size_t i = 0; i < 2; ++i) {
    w_signs_[i] = ends_[i].w.sign();
    if (w_signs_[i] > 0) near_[i] = ends_[i].near();
    signs_[i] = direction_[i].sign();
    near_direction_[i] = nearest(direction_[i]);
  }
  const bool is_rectangular = state.line_mode == LineMode::rectangular;
  const double length = is_rectangular ? std::hypot(near_direction_[0], near_direction_[1])
                                       : std::abs(near_direction_[major_]);
  const double width = state.line_mode == LineMode::bresenham ? copies_ + 2.0 : state.line_width;
  reach_ = width * length * (1 + 0x1p-40);
}

/// True if an edge with this inward normal owns the samples on it.
bool LineShape::owns(int normal_x, int normal_y) const {
  return normal_x != 0 ? normal_x > 0 : tie_sign_ * normal_y > 0;
}

/// The sign of |M| − width |d| (of d's major part for a parallelogram), in half pixels.
int LineShape::compare_with_width(const HalfPixels& p) const {
  const NearValue middle = middle_.near(p);
  const bool is_rectangular = state_.line_mode == LineMode::rectangular;
  const double length = is_rectangular ? std::hypot(near_direction_[0], near_direction_[1])
                                       : std::abs(near_direction_[major_]);
  const double limit = double{state_.line_width} * length;
  const double difference = std::abs(middle.value) - limit;
  if (std::abs(difference) > middle.error + 0x1p-48 * limit) return difference > 0 ? 1 : -1;
  return compare_exactly_with_width(p);
}

int LineShape::compare_exactly_with_width(const HalfPixels& p) const {
  const ExactSum middle = middle_.exact(p);
  const double width = state_.line_width;
  if (state_.line_mode != LineMode::rectangular) {
    ExactSum difference;
    difference.add_product(middle, middle.sign());
    difference.add_product(direction_[major_], -width * signs_[major_]);
    return difference.sign();
  }
  std::array<ExactSum, 2> along;
  for (std::size_t i = 0; i < 2; ++i) along[i].add_product(direction_[i], width);
  const int exponent = -std::ilogb(nearest(along[major_]));
  ExactSum difference;
  const ExactSum across = scaled(middle, exponent);
  difference.add_product(across, across);
  for (const ExactSum& part : along) {
    const ExactSum of_about_one = scaled(part, exponent);
    difference.add_product(negative(of_about_one), of_about_one);
  }
  return difference.sign();
}

bool LineShape::covers(const HalfPixels& p) const {
  for (std::size_t end = 0; end < 2; ++end) {
    const int side = weights_.e[end].sign(p);
    if (side < 0) return false;
    if (side > 0) continue;
    // E_a grows along −w_b n, E_b along w_a n.
    const int along = end == 0 ? -w_signs_[1] : w_signs_[0];
    if (!owns(along * weights_.direction[0].sign(), along * weights_.direction[1].sign())) {
      return false;
    }
  }
  const int beside = compare_with_width(p);
  if (beside != 0) return beside < 0;
  const int turn = -middle_.sign(p);  // towards the middle
  return owns(turn * middle_.coefficients()[0].sign(), turn * middle_.coefficients()[1].sign());
}

// --- Bresenham's lines ---------------------------------------------------------------------------

/// True if the line, moved for its width, crosses the middle of a pixel's column (or row, if y is
/// the major axis) in the pixel.
bool LineShape::is_crossed_in(int x, int y) const {
  const std::size_t minor = 1 - major_;
  const std::array<int, 2> pixel{x, y};
  // The line crosses at a place p_minor. M grows with p_minor if its coefficient is positive, and
  // is 0 there.
  const int growth = middle_.coefficients()[minor].sign();
  const auto compare_with = [&](int border) {  // sign of the place − border, in pixels
    HalfPixels p{};
    p[major_] = 2.0 * pixel[major_] + 1;
    p[minor] = 2.0 * border + (copies_ - 1);  // moves the border instead of the line
    return -growth * middle_.sign(p);
  };
  // A place on a border belongs to the pixel after it only if the line was moved there.
  const bool rises = signs_[0] * signs_[1] > 0;
  const bool goes_up = state_.convention != Convention::d3d && major_ == 0 && rises;
  const int at_first = compare_with(pixel[minor]);
  const int at_last = compare_with(pixel[minor] + 1);
  return (at_first > 0 || (at_first == 0 && goes_up)) &&
         (at_last < 0 || (at_last == 0 && !goes_up));
}

/// Whether a point on a diamond's border, past its middle along the major axis or beside it, is
/// past the diamond. `from_middle`: the signs of its position minus the middle's.
bool LineShape::is_past_on_the_border(const std::array<int, 2>& from_middle) const {
  if (state_.convention == Convention::d3d) {
    // Lower edges (window y is down) with the bottom corner, and the right corner of y-major lines.
    const bool is_right_corner = major_ == 1 && from_middle[1] == 0 && from_middle[0] > 0;
    return from_middle[1] <= 0 && !is_right_corner;
  }
  // The move by −ε along x decides: it leads out of the diamond on the left.
  return major_ == 0 ? signs_[0] < 0 : from_middle[0] <= 0;
}

/// True if an end is past the diamond of a pixel that the line crosses. Behind the eye, the first
/// end is infinitely far back, and the second one infinitely far ahead.
bool LineShape::is_past(std::size_t end, int x, int y) const {
  if (w_signs_[end] <= 0) return end == 1;
  const std::size_t minor = 1 - major_;
  const std::array<int, 2> pixel{x, y};
  const double turn = signs_[major_];
  const double near_along = turn * (near_[end][major_] - (2.0 * pixel[major_] + 1));
  // Far enough for any rounding: positions near the framebuffer are known to 2^-30.
  constexpr double kFar = 3;
  if (std::abs(near_along) > kFar) return near_along > 0;
  const WindowColumn& column = ends_[end];
  ExactSum along;
  along.add_product(column.at[major_], turn);
  along.add_product(column.w, -turn * (2.0 * pixel[major_] + 1));
  if (along.sign() < 0) return false;
  ExactSum beside = column.at[minor];
  beside.add_product(column.w, -(2.0 * pixel[minor] + copies_));  // 2 pixel + 1, moved
  ExactSum over = along;  // along + beside − 1/2, in half pixels times w
  over.add_product(beside, beside.sign());
  over.add_product(column.w, -1);
  if (over.sign() != 0) return over.sign() > 0 && along.sign() > 0;
  std::array<int, 2> from_middle{};
  from_middle[major_] = along.sign() * signs_[major_];
  from_middle[minor] = beside.sign();
  return is_past_on_the_border(from_middle);
}

bool LineShape::selects(int x, int y) const {
  // Where the line crosses the pixel's column, to the nearest pixel and a half.
  const std::size_t minor = 1 - major_;
  const std::array<int, 2> pixel{x, y};
  const auto& m = middle_.near_coefficients();
  const double crossing =
      (-(m[major_] * (2.0 * pixel[major_] + 1) + m[2]) / m[minor] - (copies_ - 1)) / 2;
  const double first = pixel[minor] - (copies_ - 1);
  const bool is_near = crossing > first - 2 && crossing < pixel[minor] + 3.0;
  if (!is_near) return false;
  for (int step = -1; step <= 1; ++step) {
    std::array<int, 2> crossed = pixel;
    crossed[minor] = static_cast<int>(std::floor(crossing)) + step;
    const int copy = pixel[minor] - crossed[minor];
    if (copy < 0 || copy >= copies_) continue;
    if (!is_crossed_in(crossed[0], crossed[1])) continue;
    return is_past(1, crossed[0], crossed[1]) && !is_past(0, crossed[0], crossed[1]);
  }
  return false;
}

// --- Bounds --------------------------------------------------------------------------------------

PixelBox LineShape::box(const PixelBox& bounds) const {
  if (w_signs_[0] <= 0 || w_signs_[1] <= 0) return bounds;
  const double reach = state_.line_width + 3.0;
  const auto range = [&](const PixelRange& pixels, std::size_t axis) {
    const double low = std::min(near_[0][axis], near_[1][axis]) / 2;
    const double high = std::max(near_[0][axis], near_[1][axis]) / 2;
    return pixels_from_through(pixels, 0.5, low - reach, high + reach);
  };
  return {range(bounds.columns, 0), range(bounds.rows, 1)};
}

PixelRange LineShape::span(const PixelRange& columns, int y) const {
  const auto& m = middle_.near_coefficients();
  if (m[0] == 0) return columns;
  // |M| <= reach: 2u between (−row ± reach)/m_0, with a pixel and half a row to each side.
  const double row = m[1] * (2.0 * y + 1) + m[2];
  const double off = 0x1p-49 * (std::abs(m[1]) * (2.0 * y + 1) + std::abs(m[2]));
  const double away = (reach_ + std::abs(m[1]) + off) / std::abs(m[0]);
  const double center = -row / m[0];
  const double low = (center - away) / 2 - 2;
  const double high = (center + away) / 2 + 2;
  return pixels_from_through(columns, 0.5, low, high);
}

}  // namespace rastercheck::rasterizer
