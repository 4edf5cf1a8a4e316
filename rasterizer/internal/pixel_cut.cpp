#include "rasterizer/internal/pixel_cut.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/internal/exact_sum.h"

namespace rastercheck::rasterizer {
namespace {

constexpr std::array<std::array<std::size_t, 3>, 3> kEven{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}};
constexpr std::array<std::array<std::size_t, 3>, 3> kOdd{{{0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

}  // namespace

void PixelCut::Number::add(double term) {
  if (term == 0) return;
  terms[size++] = term;
  value += term;
  magnitude += std::abs(term);
}

/// sign · (x_i W + w_i (2 x0 + W − twice_at)) along axis 0, likewise along axis 1; every product of
/// two floats, and of a float and a pixel's number, is exact.
PixelCut::Condition PixelCut::side_of(int axis, double sign, double twice_at) const {
  const AxisFrame& frame = axis == 0 ? setting_.frame.u : setting_.frame.v;
  const bool is_turned = axis == 1 && setting_.state.convention == Convention::d3d;
  Condition condition;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& p = corners_[i];
    const double w = sign * double{p.w};
    const double coordinate = (is_turned ? -sign : sign) * double{axis == 0 ? p.x : p.y};
    condition[i].add(coordinate * double{frame.size});
    condition[i].add(w * (2 * double{frame.origin}));
    condition[i].add(w * double{frame.size});
    condition[i].add(-w * twice_at);
  }
  return condition;
}

/// The viewport's sides are NDC −1 and 1: w + x >= 0 and w − x >= 0.
PixelCut::Condition PixelCut::viewport_side(int axis, bool is_far) const {
  Condition condition;
  for (std::size_t i = 0; i < 3; ++i) {
    const double coordinate = axis == 0 ? corners_[i].x : corners_[i].y;
    condition[i].add(corners_[i].w);
    condition[i].add(is_far ? -coordinate : coordinate);
  }
  return condition;
}

int PixelCut::determinant_sign(const Condition& a, const Condition& b, const Condition& c) {
  double value = 0;
  double size = 0;
  for (const auto& [i, j, k] : kEven) {
    value += a[i].value * b[j].value * c[k].value;
    size += a[i].magnitude * b[j].magnitude * c[k].magnitude;
  }
  for (const auto& [i, j, k] : kOdd) {
    value -= a[i].value * b[j].value * c[k].value;
    size += a[i].magnitude * b[j].magnitude * c[k].magnitude;
  }
  const double error = 0x1p-48 * size;
  if (value > error) return 1;
  if (value < -error) return -1;
  if (size == 0) return 0;

  ExactSum sum;
  const auto add = [&](const std::array<std::size_t, 3>& at, double sign) {
    for (std::size_t i = 0; i < a[at[0]].size; ++i) {
      for (std::size_t j = 0; j < b[at[1]].size; ++j) {
        const double first = sign * a[at[0]].terms[i];
        const double high = first * b[at[1]].terms[j];
        const double low = std::fma(first, b[at[1]].terms[j], -high);
        for (std::size_t k = 0; k < c[at[2]].size; ++k) {
          sum.add_product(high, c[at[2]].terms[k]);
          sum.add_product(low, c[at[2]].terms[k]);
        }
      }
    }
  };
  for (const auto& at : kEven) add(at, 1);
  for (const auto& at : kOdd) add(at, -1);
  return sum.sign();
}

/// The corner where two conditions are zero. The polygon lies where Σ λ_i > 0, which gives the sign
/// of the cross product.
PixelCut::Corner PixelCut::corner_of(std::size_t first, std::size_t second,
                                     std::size_t side) const {
  Condition all;
  for (Number& number : all) number.add(1);
  return {first, second, side,
          determinant_sign(conditions_[first], conditions_[second], all) < 0 ? -1 : 1};
}

bool PixelCut::cut(const Condition& condition) {
  at_.clear();
  bool is_cut = false;
  bool has_inner = false;
  for (const Corner& corner : polygon_) {
    const int side = corner.sign * determinant_sign(conditions_[corner.first],
                                                    conditions_[corner.second], condition);
    at_.push_back(side);
    is_cut = is_cut || side < 0;
    has_inner = has_inner || side > 0;
  }
  if (!has_inner) return false;
  if (!is_cut) return true;
  const std::size_t index = conditions_.size();
  conditions_.push_back(condition);
  kept_.clear();
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const int at_next = at_[(i + 1) % polygon_.size()];
    const Corner& corner = polygon_[i];
    if (at_[i] >= 0) {
      kept_.push_back(corner);
      // The polygon leaves the half-plane at this corner, which lies on the new side.
      if (at_[i] == 0 && at_next < 0) kept_.back().side = index;
    }
    if (at_[i] * at_next < 0) {
      kept_.push_back(corner_of(corner.side, index, at_next < 0 ? index : corner.side));
    }
  }
  polygon_.swap(kept_);
  return true;
}

bool PixelCut::set_up(const std::array<glm::vec4, 3>& corners, const ClipFunctionals& clips) {
  corners_ = corners;
  conditions_.assign(3, Condition());
  for (std::size_t i = 0; i < 3; ++i) conditions_[i][i].add(1);
  polygon_.clear();
  // Corner i is vertex i, where the other two weights are zero. The side from vertex i to vertex
  // i + 1 is where the third weight is zero.
  for (std::size_t i = 0; i < 3; ++i) {
    polygon_.push_back(corner_of((i + 1) % 3, (i + 2) % 3, (i + 2) % 3));
  }
  for (const ClipFunctional& clip : clips.all) {
    const bool may_cut =
        std::any_of(clip.g.begin(), clip.g.end(), [](const Coefficient& g) { return g.value < 0; });
    if (!may_cut) continue;
    Condition condition;
    for (std::size_t i = 0; i < 3; ++i) {
      condition[i].add(clip.g[i].value);
      condition[i].add(clip.g[i].tail);
    }
    if (!cut(condition)) return false;
  }
  first_conditions_ = conditions_;
  first_polygon_ = polygon_;
  return true;
}

bool PixelCut::meets(int x, int y) {
  conditions_ = first_conditions_;
  polygon_ = first_polygon_;
  const double left = 2.0 * x;
  const double low = 2.0 * y;
  if (!cut(side_of(0, 1, left)) || !cut(side_of(0, -1, left + 2)) || !cut(side_of(1, 1, low)) ||
      !cut(side_of(1, -1, low + 2))) {
    return false;
  }
  if (!setting_.bounds.whole_columns.contains(x) &&
      (!cut(viewport_side(0, false)) || !cut(viewport_side(0, true)))) {
    return false;
  }
  return setting_.bounds.whole_rows.contains(y) ||
         (cut(viewport_side(1, false)) && cut(viewport_side(1, true)));
}

}  // namespace rastercheck::rasterizer
