// A bias of zero changes nothing: a case whose bias has the constant ±0, the slope ±0 and any clamp
// is drawn like the case without a bias.
//
// Why. o = m · 0 + r · 0 = 0 for all m and r. A clamp c > 0 makes it min(0, c) = 0, and c < 0 makes
// it max(0, c) = 0. Then d + o = d. Depths without a bias lie in the range that biased ones are
// clamped to, unless vertices are snapped: only the depths of a bias that is none are not clamped.
// So the drawing must be right for the case without the bias.

#include <array>
#include <string>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"
#include "properties/laws/internal/changed_drawing.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::zero_bias_changes_nothing_law {
namespace {

/// Clamps of either sign, from less than a step of any format to more than all depths.
constexpr std::array kClamps{0.0F,   0x1p-30F, -0x1p-30F, 0x1p-16F, -0x1p-16F, 0.25F,
                             -0.25F, 2.0F,     -2.0F,     0x1p127F, -0x1p127F, 1.0F};
constexpr std::array kZeros{0.0F, -0.0F};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  if (!draws_bias_or_unorm(backend)) return not_applicable(kLacksBiasAndUnorm);
  cases::Case plain = c;
  plain.depth_bias = {};
  cases::Case zero = c;
  Choices choices(choices_of(c));
  zero.depth_bias.constant = choices.pick(kZeros);
  zero.depth_bias.slope = choices.pick(kZeros);
  zero.depth_bias.clamp = choices.pick(kClamps);
  const Result<backends::Drawn> before = draw_promised(plain, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(zero, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  Check check = judge_changed(plain, before->contract, before->fragments, drawn->fragments, index);
  add_to_notes(check,
               "drawn with a bias of zero and the clamp " + value_text(zero.depth_bias.clamp));
  if (zero.depth_bias.clamp != 0) add_label(check, "clamped bias");
  if (cases::unorm_bits(c.depth_format) != 0) add_label(check, "unorm");
  return check;
}

const LawRegistration kRegistration({.id = "a-bias-of-zero-changes-nothing",
                                     .sentence = "a bias of zero changes nothing",
                                     .reason = "m · 0 + r · 0 is 0, which no clamp changes.",
                                     .exceptions = "values that the contract leaves free",
                                     .generate = &biased_case,
                                     .check = &check,
                                     .is_promised = &draws_bias_or_unorm,
                                     .unpromised = kLacksBiasAndUnorm,
                                     .covers = {cover(45, "clamped bias"), cover(29, "unorm"),
                                                cover(13, "depth test")}});

}  // namespace
}  // namespace rastercheck::properties::zero_bias_changes_nothing_law
