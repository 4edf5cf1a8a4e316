#include "properties/laws/internal/biased_depths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cases/capabilities.h"
#include "properties/float_numbers.h"
#include "properties/generator.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/close_drawings.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/random_state.h"

namespace rastercheck::properties {
namespace {

/// The laws add and compare a few depths in double, each off by at most 2^-53 of numbers below 2.
constexpr double kRounding = 0x1p-48;

/// The spacing of a unorm format's numbers; 0 for float32.
double step_of(const cases::Case& c) {
  const int bits = cases::unorm_bits(c.depth_format);
  return bits == 0 ? 0 : 1 / (power_of_two(bits) - 1);
}

}  // namespace

Generated biased_case(Draw& draw) {
  if (!draw.one_in(4)) {
    const Generator* borders = find_generator("depth-borders");
    return {borders->make(draw), std::string(borders->name)};
  }
  Generated made = generate_any(draw);
  set_depth_storage(draw, made.source);
  return made;
}

bool draws_bias(backends::Backend& backend) {
  return capabilities_of(backend).has(cases::Feature::depth_bias);
}

bool draws_bias_or_unorm(backends::Backend& backend) {
  const cases::Capabilities has = capabilities_of(backend);
  return has.has(cases::Feature::depth_bias) || has.has(cases::Feature::unorm_depth);
}

bool draws_one_bias(backends::Backend& backend) {
  cases::Case biased;
  biased.depth_bias.slope = 1;
  return draws_bias(backend) && has_one_depth(biased, backend.contract(biased));
}

cases::Case for_depths(const cases::Case& c, const cases::DepthBias& bias) {
  cases::Case changed = c;
  changed.depth_test = cases::DepthTest::none;
  changed.depth_clear.reset();
  changed.depth_bias = bias;
  changed.attributes.clear();
  changed.attribute_values.clear();
  return changed;
}

bool has_one_depth(const cases::Case& c, const cases::Contract& contract) {
  if (contract.is_unspecified() || contract.depth_error != cases::DepthError::either_side) {
    return false;
  }
  const cases::BiasPromise& promise = contract.depth_bias;
  if (c.depth_bias.slope != 0 && promise.slope == cases::BiasSlope::between) return false;
  if (c.depth_bias.constant == 0) return true;
  if (cases::unorm_bits(c.depth_format) == 0) {
    return promise.exponent == cases::BiasExponent::vertices;
  }
  return promise.unit != cases::BiasUnit::either_power && promise.unit != cases::BiasUnit::open;
}

double DepthLimits::clamped(double depth) const { return std::clamp(depth, least, greatest); }

DepthLimits depth_limits(const cases::Case& c) {
  if (c.rules != cases::Rules::d3d && !c.depth_clamp) return {};
  return {double{std::min(c.viewport.min_depth, c.viewport.max_depth)},
          double{std::max(c.viewport.min_depth, c.viewport.max_depth)}};
}

double depth_slack(const cases::Case& c, const cases::Contract& contract, double depth) {
  const double before = greatest_difference(depth_allowance(c, contract), depth, depth);
  return before + cases::reach_of(contract.depth_store) * step_of(c) + kRounding;
}

bool is_unclamped(const cases::Case& c, const cases::Contract& contract, double depth) {
  const double slack = depth_slack(c, contract, depth);
  const DepthLimits limits = depth_limits(c);
  const double least{std::min(c.viewport.min_depth, c.viewport.max_depth)};
  const double greatest{std::max(c.viewport.min_depth, c.viewport.max_depth)};
  // Without bias, snapping may leave a depth at the end of the depth range.
  const bool is_biased = !c.depth_bias.is_none();
  return depth - slack > (is_biased ? limits.least : least) &&
         depth + slack < (is_biased ? limits.greatest : greatest);
}

double least_bias_unit(const cases::Case& c, const cases::Contract& contract, double depth) {
  const int bits = cases::unorm_bits(c.depth_format);
  if (bits != 0) {
    switch (contract.depth_bias.unit) {
      case cases::BiasUnit::open:
        return 0;
      case cases::BiasUnit::double_power:
        return power_of_two(1 - bits);
      default:
        return power_of_two(-bits);  // 1/(2^b − 1) is greater, even as float32
    }
  }
  // A depth drawn too far may have the exponent above that of the exact one.
  return depth <= 0 ? 0 : ulp_of(depth) / 2;
}

bool is_level(const cases::Case& c, const cases::Triangle& triangle) {
  const cases::ClipVertex& a = c.positions[triangle[0]];
  return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t index) {
    const cases::ClipVertex& b = c.positions[index];
    // Doubles hold products of two floats.
    return b.w != 0 && double{a.z} * double{b.w} == double{b.z} * double{a.w};
  });
}

bool has_unit_of_plane(const cases::Case& c, const cases::Triangle& triangle) {
  if (c.depth_bias.constant == 0 || cases::unorm_bits(c.depth_format) != 0) return true;
  return std::all_of(triangle.begin(), triangle.end(),
                     [&c](std::uint32_t index) { return c.positions[index].w > 0; });
}

void visit_depths(const cases::Case& c, std::span<const cases::Fragments> drawings,
                  const std::function<void(const cases::SamplePlace& place,
                                           std::span<const double> depths)>& see) {
  std::vector<FragmentMap> places;
  for (const cases::Fragments& drawn : drawings) places.push_back(fragments_by_place(drawn));
  std::vector<double> depths(drawings.size());
  for (const auto& [place, index] : places.front()) {
    if (!is_of_case(c, place)) continue;
    bool is_in_all = true;
    for (std::size_t d = 0; d < drawings.size(); ++d) {
      const auto found = places[d].find(place);
      is_in_all = is_in_all && found != places[d].end();
      if (is_in_all) depths[d] = double{drawings[d].depth[found->second]};
    }
    if (is_in_all) see(place, depths);
  }
}

void compare_depth(Tally& tally, const cases::SamplePlace& place, double actual, double expected,
                   double slack, const std::string& note) {
  tally.pass_required(place.triangle);
  if (std::abs(actual - expected) <= slack) {  // false for NaN
    tally.pass(records::AttributeKind::depth);
    return;
  }
  const auto drawn = static_cast<float>(actual);
  tally.report(violation_at(
      place, class_of_wrong(drawn, records::FragmentClass::beyond_bound),
      fmt::format("at most {:.3g} from {}", slack, value_text(static_cast<float>(expected))), note,
      {records::AttributeKind::depth, std::nullopt, drawn}));
}

Result<std::vector<cases::Fragments>> draw_all(std::span<const cases::Case> cases,
                                               backends::Backend& backend) {
  std::vector<cases::Fragments> all;
  for (const cases::Case& c : cases) {
    Result<backends::Drawn> drawn = draw_promised(c, backend);
    if (!drawn) return tl::unexpected(drawn.error());
    all.push_back(std::move(drawn->fragments));
  }
  return all;
}

}  // namespace rastercheck::properties
