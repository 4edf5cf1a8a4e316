// Cutting a triangle keeps the bias of the rest: the depths that a user clip distance leaves are
// those of the whole triangle; and depths that depth clamp leaves within the depth range are those
// drawn without it, clamped.
//
// Why. m is the steepness of the triangle's plane, which no cut changes. r is that of the format
// or, in float32, of the greatest depth of the given vertices, not of those that a cut makes (the
// contract's exponent `vertices`). So o is the same, and so is the depth before it is clamped to
// [0, 1], to the depth range or, of a biased depth with depth clamp, to that range alone:
//
//   the depth with depth clamp = clamp(the depth without it, least, greatest end of the range).
//
// The near and far planes cut only the case without depth clamp. Each depth is off by the
// contract's bound and by storing.
//
// Samples: those that both drawings have. Contracts that leave positions, m or r open allow each
// drawing another offset, and those that take values from snapped positions give the pieces of a
// cut triangle planes of their own: the law does not apply to them.

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/capabilities.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"

namespace rastercheck::properties::cutting_keeps_the_bias_law {
namespace {

/// The case with one more clip distance, of either sign at the vertices.
cases::Case with_cut(const cases::Case& c, Choices& choices) {
  constexpr std::array kDistances{1.0F, -1.0F, 0.5F, -0.25F, 2.0F};
  cases::Case cut = c;
  cut.clip_distances.clear();
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    for (const float distance : c.clip_distances_of(v)) cut.clip_distances.push_back(distance);
    cut.clip_distances.push_back(choices.pick(kDistances));
  }
  ++cut.clip_distance_count;
  return cut;
}

/// The size of the depths, for their slack; at least that of the range.
double larger(std::span<const double> depths) { return std::max(depths[0], depths[1]); }

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_bias(backend)) return not_applicable("the backend has no depth bias");
  const cases::Capabilities has = capabilities_of(backend);
  cases::Case whole = for_depths(c, c.depth_bias);
  Choices choices(choices_of(c));
  const bool can_clamp = has.has(cases::Feature::depth_clamp) || c.depth_clamp;
  const bool clamps = choices.below(3) == 0 && can_clamp;
  const bool can_cut =
      c.clip_distance_count < has.max_clip_distances && has.has(cases::Feature::clip_distances);
  if (!clamps && !can_cut) return not_applicable("the backend has neither cut");
  if (clamps) whole.depth_clamp = false;
  cases::Case part = clamps ? whole : with_cut(whole, choices);
  if (clamps) part.depth_clamp = true;
  const cases::Contract contract = backend.contract(part);
  const bool is_exact = has_one_depth(whole, backend.contract(whole)) &&
                        has_one_depth(part, contract) &&
                        (!contract.coverage || contract.basis == cases::Basis::ideal);
  if (!is_exact) return not_applicable("the contract allows a cut triangle other depths");
  const auto drawn = draw_all(std::array{whole, part}, backend);
  if (!drawn) return tl::unexpected(drawn.error());

  Tally tally(whole);
  DepthLimits range{-1, 2};  // beyond all depths
  if (clamps) range = depth_limits(part);
  visit_depths(c, *drawn, [&](const cases::SamplePlace& place, std::span<const double> depths) {
    const double slack = 2 * depth_slack(c, contract, larger(depths));
    compare_depth(tally, place, depths[1], range.clamped(depths[0]), slack,
                  clamps ? "drawn with depth clamp; expected from the drawing without it"
                         : "drawn with another clip distance; expected from the drawing without");
  });
  if (drawn->front().size() != drawn->back().size()) tally.label(clamps ? "clamped" : "cut");
  if (!c.depth_bias.is_none()) tally.label("biased");
  if (cases::unorm_bits(c.depth_format) != 0) tally.label("unorm");
  return tally.finish();
}

/// Gives vertices depths of several exponents, and some beyond the depth range.
Generated generate(Draw& draw) {
  Generated made = biased_case(draw);
  cases::Case& c = made.source;
  if (draw.one_in(2)) return made;
  c.depth_format = draw.one_in(3) ? cases::DepthFormat::unorm16 : cases::DepthFormat::float32;
  const int whole = draw.between(-4096, 4096);
  c.depth_bias.constant = static_cast<float>(whole);
  for (cases::ClipVertex& p : c.positions) {
    const float share = draw.pick(std::array{0.125F, 0.25F, 0.5F, 0.75F, 1.0F, 1.5F, -0.5F});
    p.z = share * p.w;
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "cutting-a-triangle-keeps-its-bias",
     .sentence = "cutting a triangle keeps the bias of the rest",
     .reason = "A cut changes neither the plane of a triangle nor its given vertices.",
     .exceptions = "contracts that allow several offsets, or take values from snapped positions",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_one_bias,
     .unpromised = kHasNoSingleBias,
     .excludes_outer = true,
     .covers = {cover(19, "cut"), cover(5, "clamped"), cover(45, "biased"), cover(22, "unorm")}});

}  // namespace
}  // namespace rastercheck::properties::cutting_keeps_the_bias_law
