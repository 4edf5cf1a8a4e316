// Depths are biased and stored as the contract says: of cases with depth bias, and with depths in
// unorm formats, coverage, depths and attributes are right, and a depth test leaves what it has to.
//
// Why. With o = m · slope + r · constant, limited by the bias's clamp, the depth of a sample is
// z/w mapped to the depth range, plus o, then clamped and stored (RULES §8). m and r are exact
// numbers, and where a contract allows several, an interval of each. The oracle decides each depth
// and each order of two depths without rounding.

#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"

namespace rastercheck::properties::depths_are_biased_and_stored_law {
namespace {

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  if (!draws_bias_or_unorm(backend)) return not_applicable(kLacksBiasAndUnorm);
  if (c.depth_bias.is_none() && cases::unorm_bits(c.depth_format) == 0) {
    return not_applicable("the case has neither bias nor unorm depths");
  }
  Result<Check> check = check_judged(c, backend, {}, index);
  if (!check) return check;
  if (!c.depth_bias.is_none()) add_label(*check, "biased");
  if (c.depth_bias.slope != 0) add_label(*check, "sloped");
  if (!c.depth_bias.is_none() && c.depth_bias.clamp != 0) add_label(*check, "clamped bias");
  if (cases::unorm_bits(c.depth_format) != 0) add_label(*check, "unorm");
  return check;
}

const LawRegistration kRegistration(
    {.id = "depths-are-biased-and-stored-as-promised",
     .sentence = "depths are biased and stored as promised",
     .reason = "m, r and the biased depth are exact numbers, or intervals where the contract "
               "leaves them open (RULES §8).",
     .exceptions = "cases with neither; values that the contract leaves free",
     .generate = &biased_case,
     .check = &check,
     .is_promised = &draws_bias_or_unorm,
     .unpromised = kLacksBiasAndUnorm,
     .covers = {cover(44, "biased"), cover(27, "sloped"), cover(14, "clamped bias"),
                cover(31, "unorm"), cover(13, "depth test"), cover(15, "several samples"),
                cover(10, "clipped")}});

}  // namespace
}  // namespace rastercheck::properties::depths_are_biased_and_stored_law
