// A quarter turn turns the picture: if a case is drawn with its clip positions, viewport and
// scissor turned by 90°, and the drawing is turned back, it is right for the original case.
//
//   (u, v) → (H − v, u),   H the framebuffer's height
//
// Why. The turned clip positions and viewport give exactly these window positions
// (internal/quarter_turn.h). M is multiplied by a matrix of determinant 1: facing and 1/w stay, and
// so do the edge functions, clip functionals and values at each sample.
//
// These do not turn with the picture:
//
//   ties         depend on left and right, so the judging contract names no tie rule
//   centroids    may be at the first covered sample, and the turn changes which sample is first:
//                such attributes are evaluated at the fragment's own sample instead
//   the sides    Of two opposite borders, only one belongs to the viewport; cases with a sample
//                exactly on an upper or lower side are left out
//   snapping     turns if H is on the grid: v = n + 1/2 grid units becomes H 2^b − n − 1/2, and
//                even neighbours stay even if H 2^b is even. Rounding half up does not turn, and
//                cases with it are left out
//   the pattern  of samples does not turn, except those of one and of four samples, whose indices
//                are permuted
//   guard band   is centred on the window's origin, which the turn moves by H; so the law assumes a
//                guard band that is narrower by H
//
// Cases whose turned viewport is not float32 are left out: H − y0 − h must be exact.

#include "properties/judged_law.h"
#include "properties/laws/internal/quarter_turn.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/window_symmetry.h"

namespace rastercheck::properties::quarter_turn_turns_law {
namespace {

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  cases::ClipCase clip = c;
  move_centroids_to_samples(clip);
  const std::optional<QuarterTurn> turn = quarter_turn_of(clip);
  if (!turn) return not_applicable("the turned viewport or scissor is not allowed in a case");
  cases::Case changed = turned_window(clip, *turn);
  for (cases::ClipVertex& p : changed.positions) p = turned(p, *turn);
  const auto contract = turned_back(clip, backend.contract(changed));
  if (!contract)
    return not_applicable("the contract does not cover the turned case in the same way");

  const Result<backends::Drawn> drawn = draw_promised(changed, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  Check check = judge_drawn(clip, *contract, turned_back(clip, drawn->fragments, *turn), {}, index);
  add_to_notes(check,
               [&](const records::Violation& violation) { return turned_note(clip, violation); });
  return check;
}

/// Makes cases with one or four samples.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  const bool is_turning = c.framebuffer.samples == 1 || c.framebuffer.samples == 4;
  if (!is_turning) c.framebuffer.samples = draw.one_in(2) ? 1 : 4;
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-quarter-turn-turns-the-picture",
     .sentence = "a quarter turn turns the picture",
     .reason = "Clip positions and viewport that are turned by 90° multiply M by a matrix of "
               "determinant 1.",
     .exceptions = "ties, snapping whose rounding does not turn, patterns of samples that do not, "
                   "cases whose turned viewport is no float32",
     .generate = &generate,
     .check = &check,
     .covers = {cover(12, "clipped"), cover(43, "drawn"), cover(12, "several samples"),
                cover_decided(8, "tie"), cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::quarter_turn_turns_law
