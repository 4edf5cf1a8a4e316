// A bias moves with the picture: a case with depth bias or a unorm depth, drawn elsewhere in the
// window, mirrored or turned by a quarter, is right for the original case when its drawing is moved
// back.
//
// Why. Whole pixels, mirrors and quarter turns change the derivatives z_x and z_y of depth by
// nothing, a sign or an exchange, none of which changes max(|z_x|, |z_y|) or sqrt(z_x² + z_y²). r
// depends on the format or on the vertices' depths alone, which stay. The properties that move the
// picture of any case say why the rest of it does (whole_pixels_move.cpp, mirror_mirrors.cpp,
// quarter_turn_turns.cpp), and check it here.

#include <array>
#include <string_view>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"
#include "properties/laws/internal/window_symmetry.h"

namespace rastercheck::properties::bias_moves_with_the_picture_law {
namespace {

struct Way {
  std::string_view law;
  std::string_view label;
};
constexpr std::array kWays{Way{"whole-pixels-move-the-picture", "moved"},
                           Way{"a-mirror-mirrors-the-picture", "mirrored"},
                           Way{"a-quarter-turn-turns-the-picture", "turned"}};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  if (!draws_bias_or_unorm(backend)) return not_applicable(kLacksBiasAndUnorm);
  if (c.depth_bias.is_none() && cases::unorm_bits(c.depth_format) == 0) {
    return not_applicable("the case has neither bias nor unorm depths");
  }
  const Way& way = Choices(choices_of(c)).pick(kWays);
  Result<Check> check = find_law(way.law)->check(c, backend, index);
  if (!check || !check->is_applicable) return check;
  add_label(*check, way.label);
  if (c.depth_bias.slope != 0) add_label(*check, "sloped");
  if (cases::unorm_bits(c.depth_format) != 0) add_label(*check, "unorm");
  return check;
}

Generated generate(Draw& draw) {
  Generated made = biased_case(draw);
  cases::Case& c = made.source;
  shorten_viewport(c);
  if (c.framebuffer.samples > 4) c.framebuffer.samples = draw.one_in(2) ? 1 : 4;
  if (draw.one_in(2)) c.depth_bias.slope = draw.uniform(-2, 2);
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-bias-moves-with-the-picture",
     .sentence = "a bias moves with the picture",
     .reason = "Moving, mirroring and turning the window keeps max(|z_x|, |z_y|) and the "
               "vertices' depths.",
     .exceptions = "ties, snapping and patterns of samples that do not move along, cases whose "
                   "moved viewport is no float32",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_bias_or_unorm,
     .unpromised = kLacksBiasAndUnorm,
     .covers = {cover(16, "moved"), cover(16, "mirrored"), cover(16, "turned"), cover(38, "sloped"),
                cover(30, "unorm")}});

}  // namespace
}  // namespace rastercheck::properties::bias_moves_with_the_picture_law
