// The parts of a bias add up: with slope and constant together, a depth is moved by what the slope
// moves it alone plus what the constant moves it alone; and with both doubled, by twice as much.
//
// Why. o = m · slope + r · constant is linear in slope and constant, as m and r depend on the
// triangle and the format alone. With d without a bias, s with the slope, k with the constant and b
// with both, all without a clamp of the bias,
//
//   b = s + k − d,      2 b − d = the depth with both doubled,
//
// where neither d, s, k nor b is clamped at an end; the result may be, and is clamped here too. The
// terms are off by the contract's bound and by storing each: four times that in all.
//
// Samples: those drawn in all five drawings. Contracts that leave positions, m or r open allow each
// drawing another offset: the law does not apply to them.

#include <algorithm>
#include <array>
#include <cmath>

#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"

namespace rastercheck::properties::parts_of_a_bias_add_up_law {
namespace {

/// Beyond all depths, however level a plane is; doubled, it is still a float.
constexpr float kMostSize = 0x1p100F;

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_bias(backend)) return not_applicable("the backend has no depth bias");
  cases::DepthBias bias = c.depth_bias;
  if (bias.is_none()) return not_applicable("the case has no bias");
  if (std::abs(bias.slope) > kMostSize || std::abs(bias.constant) > kMostSize) {
    return not_applicable("the bias is beyond all depths");
  }
  bias.clamp = 0;
  const std::array changed{for_depths(c, {}), for_depths(c, {0, bias.slope, 0}),
                           for_depths(c, {bias.constant, 0, 0}), for_depths(c, bias),
                           for_depths(c, {2 * bias.constant, 2 * bias.slope, 0})};
  const cases::Contract contract = backend.contract(changed[3]);
  if (!has_one_depth(changed[3], contract)) return not_applicable("the contract allows any offset");
  const auto drawn = draw_all(changed, backend);
  if (!drawn) return tl::unexpected(drawn.error());

  Tally tally(changed[3]);
  const DepthLimits limits = depth_limits(c);
  visit_depths(c, *drawn, [&](const cases::SamplePlace& place, std::span<const double> depths) {
    const auto is_free = [&](std::size_t i) {
      return is_unclamped(changed[i], contract, depths[i]);
    };
    const double slack =
        4 * depth_slack(c, contract, *std::max_element(depths.begin(), depths.end()));
    if (is_free(0) && is_free(1) && is_free(2)) {
      compare_depth(tally, place, depths[3], limits.clamped(depths[1] + depths[2] - depths[0]),
                    slack, "drawn with slope and constant; expected from drawings with one each");
      if (std::abs(depths[3] - depths[0]) > slack) tally.label("moved");
      if (bias.slope != 0 && bias.constant != 0) tally.label("both");
    }
    if (is_free(0) && is_free(3)) {
      compare_depth(tally, place, depths[4], limits.clamped(2 * depths[3] - depths[0]), slack,
                    "drawn with twice the bias; expected from the drawing with the bias");
      tally.label("doubled");
    }
  });
  if (cases::unorm_bits(c.depth_format) != 0) tally.label("unorm");
  return tally.finish();
}

const LawRegistration kRegistration(
    {.id = "the-parts-of-a-bias-add-up",
     .sentence = "the parts of a bias add up",
     .reason = "m · slope + r · constant is linear in slope and constant.",
     .exceptions = "depths at the ends of their range; contracts that allow several offsets",
     .generate = &biased_case,
     .check = &check,
     .is_promised = &draws_one_bias,
     .unpromised = kHasNoSingleBias,
     .covers = {cover(23, "moved"), cover(15, "both"), cover(31, "doubled"), cover(29, "unorm")}});

}  // namespace
}  // namespace rastercheck::properties::parts_of_a_bias_add_up_law
