#include "reports/internal/crop_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include "records/histogram.h"

namespace rastercheck::reports {
namespace {

using records::InspectedSample;
using records::InspectedValue;
using records::Inspection;

/// The largest magnitude of the value at the triangle's vertices, which defines scale ULP.
float magnitude_of(const Inspection& inspection) {
  const cases::Case& c = inspection.source;
  if (!inspection.attribute) {
    return std::max(std::abs(c.viewport.min_depth), std::abs(c.viewport.max_depth));
  }
  float largest = 0;
  if (inspection.place.triangle >= c.triangles.size()) return largest;
  for (const std::uint32_t vertex : c.triangles[inspection.place.triangle]) {
    const std::size_t at = std::size_t{vertex} * c.attributes.size() + *inspection.attribute;
    if (at < c.attribute_values.size()) {
      largest = std::max(largest, std::abs(c.attribute_values[at]));
    }
  }
  return largest;
}

/// The spacing of float32 numbers at a magnitude.
double spacing_at(double magnitude) {
  constexpr int kLeastExponent = -126;
  constexpr int kFractionBits = std::numeric_limits<float>::digits - 1;
  const int exponent =
      magnitude > 0 ? std::max(std::ilogb(magnitude), kLeastExponent) : kLeastExponent;
  return std::ldexp(1.0, exponent - kFractionBits);
}

double distance(double a, double b, double spacing) { return std::abs(a - b) / spacing; }

bool is_same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

std::optional<double> change_of_cell(const CropCell& cell, double spacing) {
  if (!cell.before && !cell.after) return std::nullopt;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!cell.before || !cell.after) return kInfinite;
  if (is_same(*cell.before, *cell.after)) return 0.0;
  if (!std::isfinite(*cell.before) || !std::isfinite(*cell.after)) return kInfinite;
  // Zeros of different sign are different values, although their distance is 0.
  const double size = distance(*cell.before, *cell.after, spacing);
  return size > 0 ? size : std::numeric_limits<double>::denorm_min();
}

/// The inspected value of a sample; nullptr if it has none.
const InspectedValue* value_of(const InspectedSample& sample,
                               std::optional<std::uint32_t> attribute) {
  const std::size_t at = attribute ? std::size_t{1} + *attribute : 0;
  return at < sample.values.size() ? &sample.values[at] : nullptr;
}

CropCell cell_of(const records::CloserLook& look, const InspectedSample& sample, float magnitude) {
  const std::optional<std::uint32_t> attribute = look.inspection.attribute;
  CropCell cell;
  cell.place.x = sample.place.x;
  cell.place.y = sample.place.y;
  cell.place.sample = sample.place.sample;
  if (look.before) {
    cell.before =
        look.before->value_at(sample.place.x, sample.place.y, sample.place.sample, attribute);
  }
  double spacing = spacing_at(magnitude);
  if (const InspectedValue* const value = value_of(sample, attribute)) {
    cell.exact = value->nearest;
    cell.after = value->actual;
    if (value->scale_error) cell.error_after = records::magnitude_bound(*value->scale_error);
    if (cell.exact) spacing = spacing_at(std::max<double>(std::abs(*cell.exact), magnitude));
  }
  if (cell.before && cell.exact && std::isfinite(*cell.before)) {
    // The nearest double is within 2^-53 of the exact value, and so within 2^-29 scale ULP.
    const bool is_unchanged = cell.after && is_same(*cell.before, *cell.after);
    cell.error_before = is_unchanged ? cell.error_after
                                     : std::optional(distance(*cell.before, *cell.exact, spacing));
  }
  if (look.before) cell.change = change_of_cell(cell, spacing);
  return cell;
}

bool is_farther(const CropCell& a, const CropCell& b) {
  const auto rank = [](const CropCell& cell) {
    return std::tuple(cell.change.value_or(-1), cell.error_after.value_or(-1));
  };
  return rank(a) > rank(b);
}

}  // namespace

std::vector<CropCell> crop_cells(const records::CloserLook& look) {
  const float magnitude = magnitude_of(look.inspection);
  std::vector<CropCell> cells;
  for (const InspectedSample& sample : look.inspection.samples) {
    CropCell cell = cell_of(look, sample, magnitude);
    const bool is_same_pixel = !cells.empty() && cells.back().place.x == cell.place.x &&
                               cells.back().place.y == cell.place.y;
    if (!is_same_pixel) {
      cells.push_back(cell);
    } else if (is_farther(cell, cells.back())) {
      cells.back() = cell;
    }
  }
  return cells;
}

}  // namespace rastercheck::reports
