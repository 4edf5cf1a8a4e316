#include "properties/probing/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace rastercheck::properties {
namespace {

/// Triangles per case; there is one case per size of move.
constexpr int kTriangles = 64;

constexpr std::array kRoundings{GridRounding::nearest_even, GridRounding::half_up,
                                GridRounding::half_down, GridRounding::down, GridRounding::up};

const char* name_of(GridRounding rounding) {
  switch (rounding) {
    case GridRounding::nearest_even:
      return "nearest_even";
    case GridRounding::half_up:
      return "half_up";
    case GridRounding::half_down:
      return "half_down";
    case GridRounding::down:
      return "down";
    case GridRounding::up:
      break;
  }
  return "up";
}

/// A triangle with an edge through a sample, whose vertices are then moved by a few units of 2^-k
/// pixels; not moved if k is 0.
FineTriangle near_sample(Draw& draw, int k) {
  const std::int64_t sample_x = draw.between(20, 43) * kFinePixel + kFinePixel / 2;
  const std::int64_t sample_y = draw.between(20, 43) * kFinePixel + kFinePixel / 2;
  // A quarter of the edges are vertical or horizontal: ties on such edges are a special case.
  const bool is_along = draw.one_in(4);
  const bool is_level = draw.one_in(2);
  int along_x = draw.between(-4, 4);
  int along_y = draw.between(-4, 4);
  if (is_along) (is_level ? along_y : along_x) = 0;
  if (along_x == 0 && along_y == 0) (is_level ? along_x : along_y) = 3;
  const std::int64_t before = draw.between(1, 3);
  const std::int64_t beyond = draw.between(1, 3);
  const std::int64_t away = draw.one_in(2) ? 1 : -1;
  const std::int64_t slide = draw.between(-3, 3);
  FineTriangle triangle;
  triangle.x = {sample_x + before * along_x * kFinePixel, sample_x - beyond * along_x * kFinePixel,
                sample_x + (slide - 2 * away * along_y) * kFinePixel};
  triangle.y = {sample_y + before * along_y * kFinePixel, sample_y - beyond * along_y * kFinePixel,
                sample_y + (slide + 2 * away * along_x) * kFinePixel};
  const std::int64_t unit = k == 0 ? 0 : kFinePixel >> k;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.x[i] += draw.between(-7, 7) * unit;
    triangle.y[i] += draw.between(-7, 7) * unit;
  }
  return triangle;
}

/// Returns how far an edge has to move for the sample's answer to change, in pixels per axis.
double move_of(const FineEdges& edges, int x, int y, bool is_drawn) {
  double outside = 0;
  double inside = std::numeric_limits<double>::max();
  for (const FineEdge& edge : edges) {
    const auto slope = static_cast<double>(std::abs(edge.a) + std::abs(edge.b));
    if (slope == 0) continue;
    const double distance =
        static_cast<double>(edge.at(x, y)) / slope / static_cast<double>(kFinePixel);
    outside = std::max(outside, -distance);
    inside = std::min(inside, distance);
  }
  return is_drawn ? outside : inside;
}

void compare(const FineTriangle& placed, const FineRows& rows, GridFit& fit) {
  const bool is_flat = area_of(placed) == 0;
  const FineEdges edges = edges_of(placed);
  const auto [x0, x1] = pixel_range(placed.x);
  const auto [y0, y1] = pixel_range(placed.y);
  for (int y = 0; y < kFineSide; ++y) {
    const std::uint64_t row = rows[static_cast<std::size_t>(y)];
    if (y < y0 || y >= y1) {
      fit.mismatches += row == 0 ? 0 : 1;
      continue;
    }
    for (int x = x0; x < x1; ++x) {
      std::int64_t least = edges[0].at(x, y);
      for (const FineEdge& edge : {edges[1], edges[2]}) least = std::min(least, edge.at(x, y));
      if (least == 0 && !is_flat) continue;  // a tie
      const bool is_inside = least > 0 && !is_flat;
      const bool is_drawn = ((row >> static_cast<unsigned>(x)) & 1U) != 0;
      ++fit.samples;
      if (is_inside == is_drawn) continue;
      ++fit.mismatches;
      fit.farthest = std::max(fit.farthest, move_of(edges, x, y, is_drawn));
    }
  }
}

/// Compares a grid's predictions with what was drawn; stops once there are more than `most`
/// mismatches.
GridFit fit_of(const MeasuredGrid& grid, const std::vector<FineDrawing>& drawings,
               std::uint64_t most) {
  GridFit fit{grid};
  for (const FineDrawing& drawing : drawings) {
    for (std::size_t i = 0; i < drawing.triangles.size(); ++i) {
      compare(rounded(drawing.triangles[i], grid), drawing.rows[i], fit);
      if (fit.mismatches > most) return fit;
    }
  }
  return fit;
}

}  // namespace

std::int64_t rounded(std::int64_t fine, int bits, GridRounding rounding) {
  const int shift = kFineBits - bits;
  if (shift == 0) return fine;
  const std::int64_t unit = std::int64_t{1} << shift;
  const std::int64_t below = fine >> shift;  // towards −∞
  const std::int64_t rest = 2 * (fine - below * unit);
  bool goes_up = rest > unit;
  if (rounding == GridRounding::down) goes_up = false;
  if (rounding == GridRounding::up) goes_up = rest > 0;
  if (rest == unit && rounding == GridRounding::nearest_even) goes_up = below % 2 != 0;
  if (rest == unit && rounding == GridRounding::half_up) goes_up = true;
  return (below + (goes_up ? 1 : 0)) * unit;
}

FineTriangle rounded(const FineTriangle& triangle, const MeasuredGrid& grid) {
  FineTriangle placed;
  for (std::size_t i = 0; i < 3; ++i) {
    placed.x[i] = rounded(triangle.x[i], grid.bits, grid.x);
    placed.y[i] = rounded(triangle.y[i], grid.bits, grid.y);
  }
  return placed;
}

std::vector<FineDrawing> draw_grid_cases(Subject& subject) {
  std::vector<FineDrawing> drawings;
  for (int k = 0; k <= kFineBits; ++k) {  // 0: nothing is moved
    MeasureDraw draw(subject, "grid", static_cast<std::uint64_t>(k));
    std::vector<FineTriangle> triangles;
    triangles.reserve(kTriangles);
    for (int i = 0; i < kTriangles; ++i) {
      triangles.push_back(near_sample(draw, k));
    }
    if (auto drawing = draw_fine(subject, triangles)) drawings.push_back(*std::move(drawing));
  }
  return drawings;
}

GridFit fit_grid(const std::vector<FineDrawing>& drawings) {
  GridFit best = fit_of({}, drawings, std::numeric_limits<std::uint64_t>::max());
  const auto consider = [&](const MeasuredGrid& grid) {
    const GridFit fit = fit_of(grid, drawings, best.mismatches);
    if (fit.mismatches < best.mismatches) best = fit;
  };
  for (int bits = 0; bits <= cases::kMaxSubpixelBits; ++bits) {
    for (const GridRounding rounding : kRoundings) consider({bits, rounding, rounding});
  }
  if (best.grid.is_none()) return best;
  // The axes may differ, for example if window y is flipped before it is rounded.
  const int bits = best.grid.bits;
  for (int near = std::max(bits - 1, 0); near <= std::min(bits + 1, cases::kMaxSubpixelBits);
       ++near) {
    for (const GridRounding x : kRoundings) {
      for (const GridRounding y : kRoundings) consider({near, x, y});
    }
  }
  return best;
}

std::string to_string(const MeasuredGrid& grid) {
  if (grid.is_none()) return "none: positions are not rounded";
  const std::string x = name_of(grid.x);
  const std::string y = name_of(grid.y);
  return fmt::format("{} bits, {}", grid.bits, x == y ? x : x + " in x, " + y + " in y");
}

}  // namespace rastercheck::properties
