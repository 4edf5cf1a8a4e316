#include "rasterizer/internal/weights.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

constexpr double kUnit = 0x1p-53;

/// |det (x, y, w)|. The six triple products are summed without rounding; the sum is rounded once.
double determinant(const std::array<glm::vec4, 3>& p) {
  ExactSum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& q = p[(i + 1) % 3];
    const glm::vec4& r = p[(i + 2) % 3];
    sum.add_product(double{q.y} * double{r.w}, p[i].x);
    sum.add_product(-double{r.y} * double{q.w}, p[i].x);
  }
  return std::abs(sum.nearest());
}

/// |det (x, y, w)|, computed in double; 0 if double does not suffice.
double certain_determinant(const std::array<glm::vec4, 3>& p, const EdgeFunctions& edges) {
  const double first = p[0].w * edges[0].c.value;
  const double second = p[1].w * edges[1].c.value;
  const double third = p[2].w * edges[2].c.value;
  const double sum = (first + second) + third;
  const double size = (std::abs(first) + std::abs(second)) + std::abs(third);
  return sum > size * (1 / kCertainDeterminant) ? sum : 0;
}

AxisFrame grid_axis(const PixelRange& pixels, int unit_bits) {
  AxisFrame axis;
  axis.scale = std::ldexp(1.0, unit_bits - 1);
  axis.is_exact = true;
  axis.greatest = std::ldexp(static_cast<double>(std::max(pixels.end, 1)), unit_bits);
  return axis;
}

/// The exact product of a line's value, which is below 2^66 in size, and two doubles.
ExactSum exact_product(Wide line, double first, double second) {
  const auto high = static_cast<double>(line);
  const auto low = static_cast<double>(line - static_cast<Wide>(high));
  const double factor = first * second;
  const double rest = std::fma(first, second, -factor);
  ExactSum sum;
  for (const double part : {high, low}) {
    sum.add_product(part, factor);
    if (rest != 0) sum.add_product(part, rest);
  }
  return sum;
}

}  // namespace

SampleFrame grid_frame(const DrawBounds& bounds, int unit_bits) {
  SampleFrame frame;
  frame.u = grid_axis(bounds.columns, unit_bits);
  frame.v = grid_axis(bounds.rows, unit_bits);
  frame.t = 1;
  return frame;
}

void Weights::set_ideal(const std::array<glm::vec4, 3>& corners, const EdgeFunctions& of_corners,
                        const SampleFrame& of_draw) {
  edges = of_corners;
  frame = &of_draw;
  placed_.reset();
  corners_ = corners;
  det_t = certain_determinant(corners, edges) * of_draw.t;
  if (det_t == 0) det_t = exact_det_t();
}

void Weights::set_placed(const GridPiece& piece, std::span<const GridCorner> corners,
                         const SampleFrame& of_grid) {
  frame = &of_grid;
  PlacedWeights& placed = placed_.emplace();
  placed.lines = piece.edges;
  for (std::size_t i = 0; i < 3; ++i) placed.w[i] = corners[piece.corners[i]].w;
  det_t = static_cast<double>(piece.area);
  for (std::size_t i = 0; i < 3; ++i) {
    const GridLine& line = piece.edges[i];
    const double share = 1 / placed.w[i];
    EdgeFunction edge;
    edge.a.value = static_cast<double>(line.a) * share;
    edge.b.value = static_cast<double>(line.b) * share;
    edge.c.value = static_cast<double>(line.c) * share;
    edge.greatest = std::abs(edge.a.value) * of_grid.u.greatest +
                    std::abs(edge.b.value) * of_grid.v.greatest + std::abs(edge.c.value);
    edge.plane_band = 10 * kUnit * edge.greatest;
    edges[i] = edge;
  }
  widen_bands();
}

std::array<double, 3> Weights::at(double u, double v) const {
  std::array<double, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) e[i] = edges[i].at(*frame, u, edges[i].row(*frame, v));
  return e;
}

std::array<ExactSum, 3> Weights::exact_at(double u, double v) const {
  std::array<ExactSum, 3> e;
  if (!placed_) {
    for (std::size_t i = 0; i < 3; ++i) e[i] = exact_edge(edges[i], *frame, u, v);
    return e;
  }
  // Samples and centres are grid points.
  const GridPoint p{static_cast<std::int64_t>(frame->u.at(u)),
                    static_cast<std::int64_t>(frame->v.at(v))};
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = exact_product(placed_->lines[i].at(p), placed_->w[(i + 1) % 3], placed_->w[(i + 2) % 3]);
  }
  return e;
}

double Weights::exact_det_t() const {
  if (!placed_) return determinant(corners_) * frame->t;
  return det_t * placed_->w[0] * placed_->w[1] * placed_->w[2];
}

void Weights::widen_bands() {
  for (EdgeFunction& edge : edges) edge.band = std::max(edge.band, 8 * kUnit * edge.greatest);
}

}  // namespace rastercheck::rasterizer
