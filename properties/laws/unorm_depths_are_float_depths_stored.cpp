// Unorm depths are float depths, stored: in a unorm format of b bits each depth is the float32
// nearest to some k/(2^b − 1), and that number is as near to the same sample's depth in float32 as
// the contract stores depths. So depths that differ by more than a step are stored in their order.
//
// Why. A format of depth changes neither positions nor planes: without a bias, whose unit depends
// on the format, both drawings have the same exact depth d. float32 gives d within the contract's
// bound, and the unorm format clamp(d, 0, 1) within the bound and what storing adds (1/2 of a step,
// or up to 0.6 or 1). Their difference is at most the sum, and if two floats are farther apart than
// that on both sides and a step, k differs and is in order.
//
// Samples: those drawn in both drawings; of contracts that leave positions open, those of planes of
// equal depth, where positions do not matter.

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/capabilities.h"
#include "properties/float_numbers.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/random_state.h"

namespace rastercheck::properties::unorm_depths_law {
namespace {

using records::FragmentClass;

/// True for the float32 nearest to a number of the format. The quotient is rounded twice, which
/// gives the nearest float32, as the binary digits of k/(2^b − 1) repeat k.
bool is_of_format(double depth, double steps) {
  const double k = std::round(depth * steps);
  return k >= 0 && k <= steps && static_cast<double>(static_cast<float>(k / steps)) == depth;
}

bool is_promised(backends::Backend& backend) {
  return capabilities_of(backend).has(cases::Feature::unorm_depth);
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  const int bits = cases::unorm_bits(c.depth_format);
  if (bits == 0) return not_applicable("the case stores floats");
  if (!is_promised(backend)) return not_applicable("the backend has no unorm depths");
  std::array changed{for_depths(c, {}), for_depths(c, {})};
  changed[1].depth_format = cases::DepthFormat::float32;
  const cases::Contract contract = backend.contract(changed[0]);
  const cases::Contract of_floats = backend.contract(changed[1]);
  const auto drawn = draw_all(changed, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  const bool is_open =
      !has_one_depth(changed[0], contract) || !has_one_depth(changed[1], of_floats);

  Tally tally(changed[0]);
  const double steps = power_of_two(bits) - 1;
  visit_depths(c, *drawn, [&](const cases::SamplePlace& place, std::span<const double> depths) {
    if (!is_of_format(depths[0], steps)) {
      tally.report(violation_at(
          place, FragmentClass::beyond_bound, "k/(2^" + std::to_string(bits) + " − 1)",
          "no number of the format",
          {records::AttributeKind::depth, std::nullopt, static_cast<float>(depths[0])}));
      return;
    }
    if (is_open && !is_level(c, c.triangles[place.triangle])) return;
    const double expected = std::clamp(depths[1], 0.0, 1.0);
    const double slack = depth_slack(changed[0], contract, depths[0]) +
                         depth_slack(changed[1], of_floats, depths[1]);
    compare_depth(tally, place, depths[0], expected, slack,
                  "drawn in " + std::to_string(bits) + " bits; expected from float32");
    const double share = expected * steps - std::floor(expected * steps);
    if (std::abs(share - 0.5) < 0x1p-5) tally.label("about midway");
    if (depths[0] == 1 || depths[0] == 0) tally.label("at an end");
  });
  if (c.viewport.min_depth > c.viewport.max_depth) tally.label("reversed");
  tally.label(bits == 16 ? "16 bits" : "24 bits");
  return tally.finish();
}

Generated generate(Draw& draw) {
  Generated made = biased_case(draw);
  if (cases::unorm_bits(made.source.depth_format) == 0) {
    made.source.depth_format =
        draw.one_in(3) ? cases::DepthFormat::unorm24 : cases::DepthFormat::unorm16;
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "unorm-depths-are-float-depths-stored",
     .sentence = "unorm depths are float depths, stored",
     .reason = "The format of depth changes no depth before it is stored, and storing moves it by "
               "less than a step.",
     .exceptions = "where a contract leaves positions open, planes that are not of equal depth",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend lacks depths in unorm formats",
     .covers = {cover(24, "about midway"), cover(7, "at an end"), cover(10, "reversed"),
                cover(33, "16 bits"), cover(16, "24 bits")}});

}  // namespace
}  // namespace rastercheck::properties::unorm_depths_law
