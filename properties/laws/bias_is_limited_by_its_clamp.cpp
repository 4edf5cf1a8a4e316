// A bias is limited by its clamp, on one side: with a clamp c > 0 a depth d becomes what the bias
// without a clamp makes of it or d + c, whichever is less; with c < 0, whichever is greater.
//
// Why. With o for the offset without a clamp and [l, h] for the depths that are stored, c > 0 gives
//
//   clamp(d + min(o, c), l, h) = min(clamp(d + o, l, h), clamp(d + c, l, h)),
//
// since adding d and clamping are monotone; c < 0 likewise, with max. Three drawings have d, the
// depth with the bias but without its clamp, and the depth with both. Each depth may be off by the
// contract's bound and by storing, and min and max of two numbers are off by no more than one of
// them. Drawings of d itself are clamped as well; depths at the ends are left out.
//
// Samples: those drawn in all three drawings. Contracts that leave positions, m or r open allow
// each drawing another offset: the law does not apply to them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"

namespace rastercheck::properties::bias_is_limited_by_its_clamp_law {
namespace {

/// Clamps for cases whose bias has none.
constexpr std::array kClamps{0x1p-22F, -0x1p-22F, 0x1p-15F, -0x1p-15F,
                             0x1p-8F,  -0x1p-8F,  0.25F,    -0.25F};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_bias(backend)) return not_applicable("the backend has no depth bias");
  if (c.depth_bias.is_none()) return not_applicable("the case has no bias");
  cases::DepthBias bias = c.depth_bias;
  if (bias.clamp == 0) bias.clamp = Choices(choices_of(c)).pick(kClamps);
  const cases::DepthBias unlimited{bias.constant, bias.slope, 0};
  const std::array changed{for_depths(c, {}), for_depths(c, unlimited), for_depths(c, bias)};
  const cases::Contract contract = backend.contract(changed[2]);
  if (!has_one_depth(changed[2], contract)) return not_applicable("the contract allows any offset");
  const auto drawn = draw_all(changed, backend);
  if (!drawn) return tl::unexpected(drawn.error());

  Tally tally(changed[2]);
  const DepthLimits limits = depth_limits(c);
  const double clamp{bias.clamp};
  visit_depths(c, *drawn, [&](const cases::SamplePlace& place, std::span<const double> depths) {
    const double plain = depths[0];
    const double free = depths[1];
    const double limited = depths[2];
    if (!is_unclamped(changed[0], contract, plain)) return;
    const double end = limits.clamped(plain + clamp);
    const double expected = clamp > 0 ? std::min(free, end) : std::max(free, end);
    const double slack = 2 * depth_slack(c, contract, std::max({plain, free, limited}));
    compare_depth(tally, place, limited, expected, slack,
                  "drawn with the clamp; without one, the depth is " +
                      value_text(static_cast<float>(free)) + ", and without a bias " +
                      value_text(static_cast<float>(plain)));
    if (std::abs(free - end) <= slack) return;
    const bool is_cut = (clamp > 0) == (free > end);
    tally.label(is_cut ? "cut by the clamp" : "within the clamp");
    if (!is_cut && (free < plain) == (clamp > 0)) tally.label("beyond the clamp's other side");
  });
  if (cases::unorm_bits(c.depth_format) != 0) tally.label("unorm");
  return tally.finish();
}

const LawRegistration kRegistration(
    {.id = "a-bias-is-limited-by-its-clamp",
     .sentence = "a bias is limited by its clamp, on one side",
     .reason = "d + min(o, c) is the less of d + o and d + c.",
     .exceptions = "depths at the ends of their range; contracts that allow several offsets",
     .generate = &biased_case,
     .check = &check,
     .is_promised = &draws_one_bias,
     .unpromised = kHasNoSingleBias,
     .covers = {cover(10, "cut by the clamp"), cover(20, "beyond the clamp's other side"),
                cover(29, "within the clamp"), cover(29, "unorm")}});

}  // namespace
}  // namespace rastercheck::properties::bias_is_limited_by_its_clamp_law
