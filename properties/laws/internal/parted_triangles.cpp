#include "properties/laws/internal/parted_triangles.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "properties/judged_law.h"
#include "properties/laws/internal/close_drawings.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using records::Verdict;

/// Rounds the same number of three vertices as with_short_vertices() does.
void shorten(float& first, float& second, float& third) {
  const std::array<float*, 3> numbers{&first, &second, &third};
  float greatest = 0;
  for (const float* number : numbers) greatest = std::max(greatest, std::abs(*number));
  if (greatest == 0) return;
  const double grain = std::ldexp(1.0, std::max(std::ilogb(greatest) - 12, -147));
  // The greatest multiple of the grain that is a float; rounding alone could reach 2^128.
  const double most = std::floor(0x1.fffffep127 / grain) * grain;
  for (float* number : numbers) {
    const double rounded = std::floor(double{*number} / grain + 0.5) * grain;
    *number = static_cast<float>(std::clamp(rounded, -most, most));
  }
}

void shorten(std::span<float> numbers, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    shorten(numbers[i], numbers[count + i], numbers[2 * count + i]);
  }
}

/// Returns Σ quarters_i numbers_i / 4, which cannot overflow and is exact for numbers from
/// with_short_vertices().
float mixed(const std::array<float, 3>& numbers, const std::array<int, 3>& quarters) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += quarters[i] * double{numbers[i]};
  return static_cast<float>(sum / 4);
}

void append_mixed(std::vector<float>& numbers, std::size_t count,
                  const std::array<std::uint32_t, 3>& vertices,
                  const std::array<int, 3>& quarters) {
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(mixed({numbers[vertices[0] * count + i], numbers[vertices[1] * count + i],
                             numbers[vertices[2] * count + i]},
                            quarters));
  }
}

/// Tells which samples the contract leaves open (check_parted).
class OpenSamples {
 public:
  OpenSamples(const Parted& parted, const cases::Contract& of_whole,
              const cases::Contract& of_parts)
      : parted_(&parted),
        contract_(of_parts),
        whole_(parted.whole, of_whole),
        parts_(parted.parts, of_parts) {
    if (!of_parts.coverage) return;
    const double tolerance = std::max(of_parts.clip_tolerance, of_whole.clip_tolerance);
    const double of_cut =
        (tolerance + double{of_parts.coverage->position_error}) / of_parts.coverage->steps();
    margin_ = 3 * std::max(placement_reach(*of_parts.coverage), of_cut);
    if (of_parts.has_open_viewport()) {
      margin_ *= cases::most_growth(parted.whole.viewport, of_parts.viewport_error);
      margin_ += of_parts.viewport_error;
    }
  }

  bool holds(const cases::SamplePlace& place) {
    if (parted_->is_exempt && parted_->is_exempt(place)) return true;
    if (whole_.judge(place.triangle, place).verdict == Verdict::permitted) return true;
    if (contract_.coverage && is_near(place)) return true;
    const bool is_strict = contract_.has_one_owner_of_ties() && contract_.is_on_grid;
    for (std::uint32_t part = 0; part < parted_->triangle_of.size(); ++part) {
      if (parted_->triangle_of[part] != place.triangle) continue;
      if (contract_.coverage && !parts_.truth(part).has_certain_orientation()) return true;
      if (!is_strict && parts_.judge(part, place).verdict == Verdict::permitted) return true;
    }
    return false;
  }

  Verdicts& whole() { return whole_; }

 private:
  bool is_near(const cases::SamplePlace& place) {
    const auto distance = whole_.truth(place.triangle)
                              .distance(static_cast<int>(place.x), static_cast<int>(place.y),
                                        static_cast<int>(place.sample));
    return !distance || (distance->lo <= margin_ && distance->hi >= -margin_);
  }

  const Parted* parted_;
  cases::Contract contract_;
  Verdicts whole_;
  Verdicts parts_;
  double margin_ = 0;  ///< pixels
};

bool takes_exact_positions(const cases::Contract& contract) {
  return !contract.coverage || contract.basis == cases::Basis::ideal;
}

}  // namespace

cases::Case with_short_vertices(const cases::Case& c) {
  cases::Case result = c;
  result.depth_test = cases::DepthTest::none;
  for (cases::Attribute& attribute : result.attributes) {
    attribute.interpolation = cases::Interpolation::smooth;
    attribute.location = cases::Location::sample;
  }
  result.positions.clear();
  result.attribute_values.clear();
  result.clip_distances.clear();
  result.triangles.clear();
  for (const cases::Triangle& triangle : c.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const std::uint32_t vertex : triangle) {
      result.positions.push_back(c.positions[vertex]);
      const auto attributes = c.attributes_of(vertex);
      result.attribute_values.insert(result.attribute_values.end(), attributes.begin(),
                                     attributes.end());
      const auto distances = c.clip_distances_of(vertex);
      result.clip_distances.insert(result.clip_distances.end(), distances.begin(), distances.end());
    }
    shorten_positions(std::span(result.positions).subspan(first).first<3>());
    const std::size_t count = c.attributes.size();
    shorten(std::span(result.attribute_values).subspan(first * count), count);
    shorten(std::span(result.clip_distances).subspan(first * c.clip_distance_count),
            c.clip_distance_count);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

void shorten_positions(std::span<cases::ClipVertex, 3> positions) {
  for (float cases::ClipVertex::*part : {&cases::ClipVertex::x, &cases::ClipVertex::y,
                                         &cases::ClipVertex::z, &cases::ClipVertex::w}) {
    shorten(positions[0].*part, positions[1].*part, positions[2].*part);
  }
}

std::uint32_t add_mixed(cases::Case& c, const std::array<std::uint32_t, 3>& vertices,
                        const std::array<int, 3>& quarters) {
  const cases::ClipVertex p = c.positions[vertices[0]];
  const cases::ClipVertex q = c.positions[vertices[1]];
  const cases::ClipVertex r = c.positions[vertices[2]];
  append_mixed(c.attribute_values, c.attributes.size(), vertices, quarters);
  append_mixed(c.clip_distances, c.clip_distance_count, vertices, quarters);
  return add_vertex(c, {mixed({p.x, q.x, r.x}, quarters), mixed({p.y, q.y, r.y}, quarters),
                        mixed({p.z, q.z, r.z}, quarters), mixed({p.w, q.w, r.w}, quarters)});
}

Result<Check> check_parted(const Parted& parted, backends::Backend& backend) {
  const Result<backends::Drawn> whole = draw_promised(parted.whole, backend);
  if (!whole) return tl::unexpected(whole.error());
  Result<backends::Drawn> parts = draw_promised(parted.parts, backend);
  if (!parts) return tl::unexpected(parts.error());
  // Replaces the parts' triangle numbers by the whole's. An invalid number stays invalid.
  const auto nowhere = static_cast<std::uint32_t>(parted.whole.triangles.size());
  for (std::uint32_t& triangle : parts->fragments.triangle) {
    triangle = triangle < parted.triangle_of.size() ? parted.triangle_of[triangle] : nowhere;
  }

  const cases::Contract of_whole = whole->contract;
  const cases::Contract of_parts = parts->contract;
  OpenSamples open(parted, of_whole, of_parts);
  Closeness closeness;
  closeness.note = parted.note;
  closeness.is_open = [&open](const cases::SamplePlace& place) { return open.holds(place); };
  closeness.is_undefined = [&open](const cases::SamplePlace& place,
                                   std::optional<std::uint32_t> attribute) {
    return open.whole().is_undefined(place, attribute);
  };
  closeness.allowed = [&](std::uint32_t triangle,
                          std::optional<std::uint32_t> attribute) -> std::optional<ValueAllowance> {
    if (!takes_exact_positions(of_whole) || !takes_exact_positions(of_parts)) return std::nullopt;
    ValueAllowance both;
    for (const cases::Contract* contract : {&of_whole, &of_parts}) {
      const std::optional<ValueAllowance> one =
          attribute ? value_allowance(parted.whole, *contract, parted.whole.triangles[triangle],
                                      *attribute)
                    : std::optional(depth_allowance(parted.whole, *contract));
      if (!one) return std::nullopt;
      both = {both.units + one->units, one->magnitude};
    }
    return both;
  };
  Check check = compare_close(parted.whole, whole->fragments, parts->fragments, closeness);
  if (of_parts.coverage) add_label(check, "snapped");
  return check;
}

}  // namespace rastercheck::properties
