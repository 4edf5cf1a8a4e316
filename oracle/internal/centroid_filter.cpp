#include "oracle/internal/centroid_filter.h"

#include <algorithm>
#include <cmath>

#include "oracle/internal/triangle_filter.h"

namespace rastercheck::oracle {
namespace {

/// The distance, in bands, by which lines are moved inwards. A line's band is at least 8u of its
/// terms, u = 2^-53. A computed value is off by at most one band, and a cut uses two values. Each
/// of up to kMostLines cuts rounds a position once along each axis, by u of the line's terms. All
/// this adds up to less than 6 bands.
constexpr double kBandsInwards = 16;

double at(const FilterLine& line, const std::array<double, 2>& p) {
  return line.a * p[0] + (line.b * p[1] + line.c);
}

/// True if the line is certainly positive all over the box.
bool is_positive(const Line& line, const PixelBox& box) {
  const std::optional<FilterLine> known = filter_line(line, box);
  const double width = box.x1 - box.x0;
  const double height = box.y1 - box.y0;
  return known && known->c + std::min(known->a * width, 0.0) + std::min(known->b * height, 0.0) >
                      2 * known->band;
}

}  // namespace

std::optional<CentroidFilter> CentroidFilter::make(const TriangleSetup& triangle,
                                                   const ProjectiveMap& map,
                                                   const std::array<FilterLine, 3>& edges,
                                                   const PixelBox& box) {
  // If coverage comes from the snapped vertices and values from the exact ones, a sample without a
  // value may be covered; the centroid of its pixel then has no value either.
  const bool may_lack_value =
      triangle.shape == Shape::placed && triangle.value_map() == &triangle.ideal;
  if (may_lack_value && !is_positive(map.inverse_w(), box)) return std::nullopt;
  CentroidFilter filter(edges, box);
  std::vector<FilterLine>& lines = filter.lines_;
  lines.assign(edges.begin(), edges.end());
  bool are_known = true;
  const auto add = [&](const Line& line) {
    const std::optional<FilterLine> known = filter_line(line, box);
    are_known = are_known && known;
    if (known) lines.push_back(*known);
  };
  if (&map == &triangle.ideal) {
    for (const ClipFunctional& functional : triangle.clip_functionals()) {
      if (functional.is_violated) add(functional.outer);
    }
  }
  if (triangle.value_map() != nullptr) {
    const Scene& scene = *triangle.scene;
    add({Ring(1), Ring(0), -scene.viewport_lo().u});
    add({Ring(-1), Ring(0), scene.viewport_hi().u});
    add({Ring(0), Ring(1), -scene.viewport_lo().v});
    add({Ring(0), Ring(-1), scene.viewport_hi().v});
  }
  if (!are_known || lines.size() > kMostLines) return std::nullopt;
  for (FilterLine& line : lines) line.band *= kBandsInwards;
  return filter;
}

/// Cuts the pixel line by line (Sutherland & Hodgman 1974).
void CentroidFilter::cut_pixel(int x, int y) {
  const double left = x - box_.x0;
  const double top = y - box_.y0;
  Corners corners{{{left, top}, {left + 1, top}, {left + 1, top + 1}, {left, top + 1}}};
  count_ = 4;
  for (const FilterLine& line : lines_) {
    std::array<double, 4 + kMostLines> depths{};
    bool is_cut = false;
    for (std::size_t i = 0; i < count_; ++i) {
      depths[i] = at(line, corners[i]) - line.band;
      is_cut = is_cut || depths[i] < 0;
    }
    if (!is_cut) continue;
    Corners rest{};
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      // Rounded corners need not form a convex polygon, so there may be too many; the pixel is then
      // left open.
      if (kept + 2 > rest.size()) {
        count_ = 0;
        return;
      }
      const std::size_t next = i + 1 == count_ ? 0 : i + 1;
      if (depths[i] >= 0) rest[kept++] = corners[i];
      if ((depths[i] >= 0) == (depths[next] >= 0)) continue;
      const double share = depths[i] / (depths[i] - depths[next]);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double from = corners[i][axis];
        const double to = corners[next][axis];
        rest[kept][axis] =
            std::clamp(from + share * (to - from), std::min(from, to), std::max(from, to));
      }
      ++kept;
    }
    corners = rest;
    count_ = kept;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t k = 0; k < 3; ++k) weights_[i][k] = at(edges_[k], corners[i]);
  }
}

bool CentroidFilter::holds(int x, int y, const ValueFilter& value, double computed) {
  if (!std::isfinite(computed)) return false;
  if (pixel_ != std::array{x, y}) {
    cut_pixel(x, y);
    pixel_ = std::array{x, y};
  }
  std::array<double, 3> g{};
  for (std::size_t k = 0; k < 3; ++k) {
    g[k] = (computed * value.p[k] - value.s[k]) * value.t[k];
  }
  bool some_below = false;
  bool some_above = false;
  for (std::size_t i = 0; i < count_; ++i) {
    double sum = 0;
    double error = 0;  // as in value_errors()
    for (std::size_t k = 0; k < 3; ++k) {
      const double e = weights_[i][k];
      sum += g[k] * e;
      error += std::abs(g[k]) * (value.edge_error[k] + 0x1p-50 * std::abs(e));
    }
    if (error > 0) error += 0x1p-900;
    some_below = some_below || sum >= error;
    some_above = some_above || sum <= -error;
  }
  return some_below && some_above;
}

}  // namespace rastercheck::oracle
