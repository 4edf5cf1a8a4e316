#include "oracle/internal/placement_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/internal/triangle_filter.h"

namespace rastercheck::oracle {
namespace {

using records::Enclosure;

/// More than the relative error of several dozen roundings, each of at most 2^-51.
constexpr double kRounding = 0x1p-40;
constexpr double kUp = 1 + kRounding;

/// The greatest ρ that is accepted: the vertices' move as a fraction of the triangle's height. Few
/// triangles exceed it, and the filter could seldom decide those.
constexpr double kMostMoved = 0.25;

/// The near_double() of a number, rounded away from zero.
double upper(const Ring& value) { return near_double(value) * kUp; }

using Vectors = std::array<std::array<double, 2>, 3>;  ///< [vertex][axis]

/// The moves of vertices to their first and to their last candidate along each axis, times w; empty
/// if doubles cannot hold them.
std::optional<std::array<Vectors, 2>> moves_of(const TriangleSetup& triangle) {
  const double unit = triangle.scene->grid_unit();
  std::array<Vectors, 2> moves{};
  for (std::size_t i = 0; i < 3; ++i) {
    const SnappedVertex& vertex = *triangle.snapped[i];
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const GridRange& candidates = axis == 0 ? vertex.x : vertex.y;
      const Ring& position = triangle.columns[i][static_cast<Eigen::Index>(axis)];
      for (const bool is_last : {false, true}) {
        const long coordinate = is_last ? candidates.last : candidates.first;
        const Ring move = window_of(coordinate, unit) * vertex.w - position;
        const double near = near_double(move);
        if (!has_normal_products(near, move)) return std::nullopt;
        moves[is_last ? 1 : 0][i][axis] = near;
      }
    }
  }
  return moves;
}

/// δ'_i w_i/|det M| of a placement, from δ_i w_i.
Shift shift_of(const Vectors& moves, const std::array<FilterLine, 3>& edges, double determinant) {
  double xx = 1;  // 1 + A
  double xy = 0;
  double yx = 0;
  double yy = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = moves[i][0] / determinant;
    const double y = moves[i][1] / determinant;
    xx += x * edges[i].a;
    xy += x * edges[i].b;
    yx += y * edges[i].a;
    yy += y * edges[i].b;
  }
  const double divisor = (xx * yy - xy * yx) * determinant;
  Shift shift;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [x, y] = moves[i];
    shift.per_weight_x[i] = (yy * x - xy * y) / divisor;
    shift.per_weight_y[i] = (xx * y - yx * x) / divisor;
  }
  return shift;
}

/// Adds a guard: samples must lie inside the line by more than its own error plus `more`. Returns
/// false if doubles cannot hold the line.
bool add_guard(const Line& line, double more, const PixelBox& box,
               std::vector<FilterLine>& guards) {
  std::optional<FilterLine> guard = filter_line(line, box);
  if (!guard) return false;
  guard->band = (guard->band + more) * kUp;
  guards.push_back(*guard);
  return true;
}

std::optional<PlacementFilter> filter_of_placed(const TriangleSetup& triangle,
                                                const std::array<FilterLine, 3>& edges,
                                                const PixelBox& box, bool at_center) {
  const Ring& exact_determinant = triangle.ideal.determinant();
  const double determinant = near_double(exact_determinant);
  if (determinant == 0 || !has_normal_products(determinant, exact_determinant)) {
    return std::nullopt;
  }
  double moved = 0;       // ρ
  double edge_share = 0;  // effect of the edge functions' errors on p − q, as a share of reach
  std::array<double, 3> bands{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double w = upper(triangle.columns[i][2]);
    bands[i] = upper(triangle.edge_bands[i]);
    moved += w * bands[i] / determinant * kUp;
    edge_share += w * edges[i].band / determinant * kUp;
  }
  const double reach = near_double(triangle.reach);
  if (!(moved <= kMostMoved) || !(edge_share <= kMostMoved) || !(reach > 0)) return std::nullopt;
  const auto moves = moves_of(triangle);
  if (!moves) return std::nullopt;

  PlacementFilter filter;
  for (std::size_t k = 0; k < kShifts; ++k) {
    Vectors placed{};
    for (std::size_t i = 0; i < 3; ++i) placed[i] = {(*moves)[k % 2][i][0], (*moves)[k / 2][i][1]};
    filter.shifts[k] = shift_of(placed, edges, determinant);
  }
  const double negative = 2 * moved * (at_center ? 1 + 0.5 / reach * kUp : 1) * kUp;  // S − 1
  const double weights = (1 + negative) * kUp;                                        // S
  const double shifted = weights / (1 - moved) * kUp;  // |p − q|, as a share of reach
  for (std::size_t i = 0; i < 3; ++i) {
    const double of_shift = bands[i] * shifted * (edge_share + kRounding);
    filter.edge_error[i] = (edges[i].band + of_shift) * kUp;
    filter.edge_change[i] = bands[i] * (2 * moved * shifted + negative) * kUp;
    filter.least_weight[i] = (bands[i] * shifted + edges[i].band) * kUp;
  }
  const Line& inverse_w = triangle.ideal.inverse_w();
  filter.divisor_change = upper(band_of(inverse_w, triangle.reach)) * shifted * kUp;
  // At a centre, no value is defined if some placement has 1/w <= 0.
  if (at_center && !add_guard(inverse_w, filter.divisor_change, box, filter.guards)) {
    return std::nullopt;
  }
  return filter;
}

std::optional<PlacementFilter> filter_of_cut(const TriangleSetup& triangle,
                                             const std::array<FilterLine, 3>& edges,
                                             const PixelBox& box) {
  PlacementFilter filter;
  const double reach = near_double(triangle.reach);
  for (std::size_t k = 0; k < kShifts; ++k) {
    filter.shifts[k].fixed_x = k % 2 == 0 ? -reach : reach;
    filter.shifts[k].fixed_y = k / 2 == 0 ? -reach : reach;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double band = upper(triangle.edge_bands[i]);
    filter.edge_error[i] = (edges[i].band + band * kRounding) * kUp;
    filter.guards.push_back(edges[i]);
    filter.guards.back().band = (edges[i].band + band) * kUp;
  }
  filter.divisor_change = upper(band_of(triangle.ideal.inverse_w(), triangle.reach));
  for (const ClipFunctional& functional : triangle.clip_functionals()) {
    if (!functional.is_violated) continue;
    const double band = upper(band_of(functional.outer, triangle.reach));
    if (!add_guard(functional.outer, band, box, filter.guards)) return std::nullopt;
  }
  return filter;
}

/// Widens an interval by more than a few roundings.
Enclosure widened(double lo, double hi) {
  return {lo - std::abs(lo) * kRounding, hi + std::abs(hi) * kRounding};
}

Enclosure negated(const Enclosure& e) { return {-e.hi, -e.lo}; }
Enclosure least_of(const Enclosure& a, const Enclosure& b) {
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}
Enclosure greatest_of(const Enclosure& a, const Enclosure& b) {
  return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// The least G of all placements if every G is positive, or the least −G if every G is negative.
struct NearestSum {
  Enclosure size;
  bool is_above = false;
};

NearestSum nearest_sum(const PlacementFilter& filter, const ValueFilter& value,
                       const ShiftedReadings& readings, const BatchWeights& weights,
                       const BatchShifts& shifts, std::size_t lane, double computed) {
  double here = 0;
  double along_x = 0;
  double along_y = 0;
  double error = 0x1p-900;  // for products that underflow, as in the kernel
  double change = 0;
  bool is_deep = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const double e = weights.e[i][lane];
    const double g = (computed * value.p[i] - value.s[i]) * value.t[i];
    here += g * e;
    along_x += g * readings.edges[i].a;
    along_y += g * readings.edges[i].b;
    error += std::abs(g) * (readings.edge_error[i] + 0x1p-49 * std::abs(e));
    change += std::abs(g) * filter.edge_change[i];
    is_deep = is_deep && e > filter.least_weight[i];
  }
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (std::size_t k = 0; k < kShifts; ++k) {
    const double there = here - along_x * shifts.x[k][lane] - along_y * shifts.y[k][lane];
    least = std::min(least, there);
    greatest = std::max(greatest, there);
  }
  const bool is_above = least > 0;
  const double nearest = is_above ? least : -greatest;
  return {{nearest - error * kUp - (is_deep ? 0 : change * kUp), nearest + error * kUp}, is_above};
}

}  // namespace

std::optional<PlacementFilter> placement_filter(const TriangleSetup& triangle,
                                                const std::array<FilterLine, 3>& edges,
                                                const PixelBox& box, bool at_center) {
  if (triangle.shape == Shape::placed) return filter_of_placed(triangle, edges, box, at_center);
  // Centres outside the polygon are left to the exact level.
  if (triangle.shape == Shape::cut && !at_center) return filter_of_cut(triangle, edges, box);
  return std::nullopt;
}

std::optional<Enclosure> excess_of(const PlacementFilter& filter, const ValueFilter& value,
                                   const ShiftedReadings& readings, const BatchWeights& weights,
                                   const BatchShifts& shifts, std::size_t lane, double computed,
                                   const Enclosure& ideal) {
  if (std::isnan(shifts.x[0][lane])) return std::nullopt;
  const NearestSum sum = nearest_sum(filter, value, readings, weights, shifts, lane, computed);
  const double weight = weights.e[0][lane] + weights.e[1][lane] + weights.e[2][lane];
  const double weight_error = (weights.error[lane] + filter.divisor_change) * kUp;
  // If this fails, some placement may have no value here. Written so that NaN fails.
  const bool is_known = sum.size.lo > 0 && weight > weight_error * kUp;
  if (!is_known) return std::nullopt;
  const double divisor = value.is_perspective ? weight : value.determinant;
  const double divisor_error = value.is_perspective ? weight_error : value.determinant_error;

  // If the value lies below the range, all signs are reversed.
  Enclosure excess = widened(sum.size.lo / (divisor + divisor_error) * value.units,
                             sum.size.hi / (divisor - divisor_error) * value.units);
  const Enclosure end = sum.is_above ? readings.greatest_end : negated(readings.least_end);
  if (end.hi < ShiftedReadings::kUnbounded) {
    const double size = sum.is_above ? computed : -computed;
    excess =
        greatest_of(excess, widened((size - end.hi) * value.units, (size - end.lo) * value.units));
  }
  if (readings.has_unshifted) excess = least_of(excess, sum.is_above ? ideal : negated(ideal));
  if (!(excess.lo > 0) || !(excess.hi >= excess.lo)) return std::nullopt;
  return sum.is_above ? excess : negated(excess);
}

}  // namespace rastercheck::oracle
