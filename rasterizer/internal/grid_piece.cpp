#include "rasterizer/internal/grid_piece.h"

#include <algorithm>

namespace rastercheck::rasterizer {
namespace {

/// `value` clamped to the range.
int held_to(const PixelRange& range, Wide value) {
  if (value <= range.begin) return range.begin;
  if (value >= range.end) return range.end;
  return static_cast<int>(value);
}

}  // namespace

void grid_pieces(std::span<const GridCorner> corners, std::vector<GridPiece>& out) {
  out.clear();
  for (std::size_t k = 2; k < corners.size(); ++k) {
    GridPiece piece;
    piece.corners = {0, k - 1, k};
    const auto point = [&](std::size_t i) { return corners[piece.corners[i % 3]].at; };
    const Wide area = grid_line(point(1), point(2), 1).at(point(0));
    if (area == 0) continue;
    piece.turn = sign(area);
    piece.area = piece.turn * area;
    for (std::size_t i = 0; i < 3; ++i) {
      piece.edges[i] = grid_line(point(i + 1), point(i + 2), piece.turn);
    }
    out.push_back(piece);
  }
}

Wide signed_area(std::span<const GridPiece> pieces) {
  Wide area = 0;
  for (const GridPiece& piece : pieces) area += piece.turn * piece.area;
  return area;
}

GridPoint grid_sample(int x, int y, const SampleOffset& offset, int unit_bits) {
  const auto units = [unit_bits](int pixel, double part) {
    constexpr int kPatternBits = 4;  // offsets are sixteenths of a pixel
    const auto sixteenths = static_cast<std::int64_t>(part * (1 << kPatternBits));
    return (std::int64_t{pixel} << unit_bits) + (sixteenths << (unit_bits - kPatternBits));
  };
  return {units(x, offset.x), units(y, offset.y)};
}

PixelRange covered_pixels(const GridPiece& piece, const PixelRange& columns, int y,
                          const SampleOffset& offset, int unit_bits, int tie_sign) {
  PixelRange covered = columns;
  const GridPoint first = grid_sample(0, y, offset, unit_bits);
  for (const GridLine& edge : piece.edges) {
    const Wide at_first = edge.at(first);
    const std::int64_t step = edge.a * (std::int64_t{1} << unit_bits);
    if (step > 0) {  // at_first + step · x >= 0
      covered.begin = held_to(covered, ceiling_quotient(-at_first, step));
    } else if (step < 0) {  // at_first + step · x > 0
      covered.end = held_to(covered, ceiling_quotient(at_first, -step));
    } else if (at_first < 0 || (at_first == 0 && tie_sign * edge.b < 0)) {
      covered.end = covered.begin;
    }
  }
  return covered;
}

PixelBox touched_pixels(std::span<const GridCorner> corners, int unit_bits,
                        const PixelBox& within) {
  const auto range = [&](auto coordinate, const PixelRange& most) {
    std::int64_t low = corners[0].at.*coordinate;
    std::int64_t high = low;
    for (const GridCorner& corner : corners) {
      low = std::min(low, corner.at.*coordinate);
      high = std::max(high, corner.at.*coordinate);
    }
    // Samples lie in [i, i + 1) pixels; a right shift rounds down.
    return PixelRange{held_to(most, low >> unit_bits), held_to(most, (high >> unit_bits) + 1)};
  };
  return {range(&GridPoint::x, within.columns), range(&GridPoint::y, within.rows)};
}

}  // namespace rastercheck::rasterizer
