#include "records/specimen.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

namespace rastercheck::records {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

float value_of(const Specimen& specimen, std::size_t at) {
  return std::bit_cast<float>(specimen.bits[at]);
}

/// Returns the float32 spacing for each value, depth first, at its largest finite magnitude in
/// either drawing.
std::vector<double> spacings_of(const Specimen& before, const Specimen& after) {
  const std::size_t values = before.values_per_sample();
  std::vector<float> largest(values, 0.0F);
  for (const Specimen* specimen : {&before, &after}) {
    for (std::size_t i = 0; i < specimen->bits.size(); ++i) {
      const float size = std::abs(value_of(*specimen, i));
      if (std::isfinite(size)) largest[i % values] = std::max(largest[i % values], size);
    }
  }
  constexpr int kFractionBits = std::numeric_limits<float>::digits - 1;
  std::vector<double> spacings;
  spacings.reserve(values);
  for (const float size : largest) {
    const int exponent = std::max(size == 0 ? -126 : std::ilogb(size), -126);
    spacings.push_back(std::ldexp(1.0, exponent - kFractionBits));
  }
  return spacings;
}

/// Returns the size of the change of a value whose bits changed.
double size_of(float before, float after, double spacing) {
  if (!std::isfinite(before) || !std::isfinite(after)) return kInfinite;
  return std::abs(static_cast<double>(after) - static_cast<double>(before)) / spacing;
}

}  // namespace

std::optional<std::size_t> Specimen::index_of(std::uint32_t x, std::uint32_t y,
                                              std::uint32_t sample) const {
  const bool is_within = x >= left && x - left < width && y >= top && y - top < height;
  if (!is_within || sample >= samples) return std::nullopt;
  return (std::size_t{y - top} * width + (x - left)) * samples + sample;
}

std::optional<float> Specimen::value_at(std::uint32_t x, std::uint32_t y, std::uint32_t sample,
                                        std::optional<std::uint32_t> attribute) const {
  const std::optional<std::size_t> at = index_of(x, y, sample);
  const std::size_t value = attribute ? std::size_t{1} + *attribute : 0;
  if (!at || !drawn[*at] || value >= values_per_sample()) return std::nullopt;
  return std::bit_cast<float>(bits[*at * values_per_sample() + value]);
}

bool is_same_part(const Specimen& a, const Specimen& b) {
  const auto part_of = [](const Specimen& s) {
    return std::tie(s.key.law, s.key.origin, s.key.index, s.triangle, s.left, s.top, s.width,
                    s.height, s.samples, s.attributes);
  };
  return part_of(a) == part_of(b);
}

std::optional<SpecimenChange> change_of(const Specimen& before, const Specimen& after) {
  const std::size_t values = before.values_per_sample();
  const std::vector<double> spacings = spacings_of(before, after);
  SpecimenChange change;
  change.size = -1;
  const auto keep = [&change](std::size_t at, std::size_t value, double size) {
    if (size <= change.size) return;
    change.at = at;
    change.attribute =
        value == 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(value - 1));
    change.size = size;
  };
  for (std::size_t at = 0; at < before.sample_count(); ++at) {
    bool is_changed = before.drawn[at] != after.drawn[at];
    if (is_changed) keep(at, 0, kInfinite);
    for (std::size_t value = 0; value < values && before.drawn[at] && after.drawn[at]; ++value) {
      const std::size_t i = at * values + value;
      if (before.bits[i] == after.bits[i]) continue;
      is_changed = true;
      keep(at, value, size_of(value_of(before, i), value_of(after, i), spacings[value]));
    }
    if (is_changed) ++change.samples;
  }
  return change.samples > 0 ? std::optional(change) : std::nullopt;
}

}  // namespace rastercheck::records
