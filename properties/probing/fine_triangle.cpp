#include "properties/probing/fine_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rastercheck::properties {
namespace {

/// Returns the pixels that have these coordinates, and one more on either side.
std::pair<int, int> pixels_near(const std::array<std::int64_t, 3>& coordinates,
                                std::int64_t pixel) {
  const auto [least, most] = std::minmax_element(coordinates.begin(), coordinates.end());
  const auto begin = static_cast<int>(*least / pixel) - 1;
  const auto end = static_cast<int>(*most / pixel) + 2;
  return {std::clamp(begin, 0, kFineSide), std::clamp(end, 0, kFineSide)};
}

}  // namespace

FineScale scale_of(const cases::PixelFraction& sample, std::int64_t parts) {
  const std::int64_t pixel = parts * kFinePixel;
  const std::int64_t of = sample.parts;
  const auto units = [&](std::int64_t numerator) {
    return (2 * numerator * pixel + of) / (2 * of);
  };
  return {pixel, units(sample.x), units(sample.y)};
}

std::int64_t area_of(const FineTriangle& t) {
  return (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.y[1] - t.y[0]) * (t.x[2] - t.x[0]);
}

double FineEdge::distance(int pixel_x, int pixel_y) const {
  const auto slope = static_cast<double>(std::abs(a) + std::abs(b));
  if (slope == 0) return 0;
  return static_cast<double>(at(pixel_x, pixel_y)) / slope / static_cast<double>(pixel);
}

FineEdges edges_of(const FineTriangle& t) {
  const std::int64_t sign = area_of(t) < 0 ? -1 : 1;
  FineEdges edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    edges[i] = {-sign * (t.y[j] - t.y[i]), sign * (t.x[j] - t.x[i]), t.x[i] - t.scale.sample_x,
                t.y[i] - t.scale.sample_y, t.scale.pixel};
  }
  return edges;
}

double depth_inside(const FineEdges& edges, int x, int y) {
  double least = std::numeric_limits<double>::max();
  for (const FineEdge& edge : edges) least = std::min(least, edge.distance(x, y));
  return least;
}

std::pair<int, int> columns_of(const FineTriangle& t) { return pixels_near(t.x, t.scale.pixel); }
std::pair<int, int> lines_of(const FineTriangle& t) { return pixels_near(t.y, t.scale.pixel); }

FinePlace place_in(const FineTriangle& triangle, int x, int y) {
  FinePlace place;
  if (area_of(triangle) == 0) return place;
  place.is_inside = true;
  for (const FineEdge& edge : edges_of(triangle)) {
    const std::int64_t value = edge.at(x, y);
    if (value < 0) place.is_inside = false;
    if (value != 0) continue;
    ++place.zero_edges;
    place.normal_x = edge.a;
    place.normal_y = edge.b;
  }
  return place;
}

bool is_empty(const FineRows& rows) {
  return std::all_of(rows.begin(), rows.end(), [](std::uint64_t row) { return row == 0; });
}

cases::ClipVertex fine_vertex(const cases::Case& c, std::int64_t x, std::int64_t y, float depth) {
  const auto pixels = [](std::int64_t fine) {
    return static_cast<double>(fine) / static_cast<double>(kFinePixel);
  };
  return at_window(c, {pixels(x), pixels(y)}, depth, 1);
}

FineTriangle about_samples(const Subject& subject, FineTriangle triangle) {
  triangle.scale = scale_of(subject.sample());
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.x[i] += triangle.scale.sample_x - kFinePixel / 2;
    triangle.y[i] += triangle.scale.sample_y - kFinePixel / 2;
  }
  return triangle;
}

std::optional<FineDrawing> draw_fine(Subject& subject, const std::vector<FineTriangle>& triangles) {
  cases::Case c = subject.base();
  for (const FineTriangle& t : triangles) {
    const auto vertex = [&](std::size_t i) { return fine_vertex(c, t.x[i], t.y[i], 0.5F); };
    const cases::ClipVertex first = vertex(0);
    const cases::ClipVertex second = vertex(1);
    add_triangle(c, first, second, vertex(2));
  }
  return draw_fine(subject, triangles, std::move(c));
}

std::optional<FineDrawing> draw_fine(Subject& subject, std::vector<FineTriangle> triangles,
                                     cases::Case source) {
  std::optional<DrawnCase> drawn = subject.drawn(std::move(source));
  if (!drawn) return std::nullopt;
  FineDrawing drawing{std::move(triangles), {}, *std::move(drawn)};
  drawing.rows.resize(drawing.triangles.size());
  const cases::Fragments& fragments = drawing.drawn.fragments;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (fragments.triangle[i] >= drawing.rows.size() || fragments.x[i] >= kFineSide ||
        fragments.y[i] >= kFineSide) {
      continue;
    }
    drawing.rows[fragments.triangle[i]][fragments.y[i]] |= std::uint64_t{1} << fragments.x[i];
  }
  return drawing;
}

}  // namespace rastercheck::properties
