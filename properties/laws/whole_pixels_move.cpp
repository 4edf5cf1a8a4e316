// Whole pixels move the picture: if a case is drawn with its viewport and scissor moved by (du, dv)
// whole pixels, and the drawing is moved back, it is right for the original case.
//
// Why. Since u = x0 + W/2 + x/w W/2 and v = y0 + h/2 ± y/w h/2 (RULES §1), a viewport at (x0 + du,
// y0 + dv) moves every window position by (du, dv), exactly. M is multiplied by a matrix of
// determinant 1, and samples lie at the same places of every pixel: at a moved sample, edge
// functions, their normals, clip functionals, 1/w and values are the same. Ties go to the same
// triangles.
//
//   snapping     every grid contains all whole pixels. v = n + 1/2 grid units moves to another
//                midpoint, and even neighbours stay even if dv 2^b is even; with b = 0, the case is
//                moved by even numbers of pixels
//   guard band   is centred on the window's origin, which does not move with the picture; so the
//                law assumes a guard band that is narrower by the greater of |du| and |dv|
//   the window   grows if the picture moves towards greater x or y. If it moves towards smaller x
//                or y, a part of the picture leaves the window. A scissor removes this part from
//                the original case, too, and removes from the moved case what enters the window.
//                Nothing else about a fragment depends on the scissor
//
// A pseudorandom number of the case (choices.h) chooses the distance: a few pixels, even or odd, or
// more than the blocks and tiles into which a rasterizer divides its window. Cases whose moved
// viewport is not float32 are left out.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "properties/choices.h"
#include "properties/exact_sum.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/changed_drawing.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/window_symmetry.h"

namespace rastercheck::properties::whole_pixels_move_law {
namespace {

/// A move in pixels.
struct Move {
  int du = 0;
  int dv = 0;
};

/// A move along a side of `size` pixels: forward, or back by at most half the side.
int steps_along(Choices& choices, int size) {
  constexpr std::array kUp{0, 1, 2, 3, 4, 5, 7, 8, 11, 16};
  if (choices.below(3) > 0) return choices.pick(kUp);
  return -1 - static_cast<int>(choices.below(static_cast<std::size_t>(size / 2)));
}

Move move_of(const cases::Case& c) {
  Choices choices(choices_of(c));
  Move move;
  move.du = steps_along(choices, std::max(c.framebuffer.width, 2));
  move.dv = steps_along(choices, std::max(c.framebuffer.height, 2));
  if (choices.below(3) == 0 && c.framebuffer.samples == 1) {
    constexpr std::array kFar{64, 65, 127, 256, 257, 300};
    (choices.below(2) == 0 ? move.du : move.dv) = choices.pick(kFar);
  }
  if (move.du == 0 && move.dv == 0) move.du = 1;
  const bool is_even = !c.coverage || (keeps_even_points(*c.coverage, move.du) &&
                                       keeps_even_points(*c.coverage, move.dv));
  if (is_even) return move;
  return {2 * (move.du / 2), 2 * (move.dv / 2)};
}

/// The pixels of `span` that stay in the window after a move; empty if none do.
PixelSpan staying(const PixelSpan& span, int by) {
  return {std::min(std::max(span.first, -by), span.last), span.last};
}

/// The case without the part that leaves the window, and the moved case.
struct Moved {
  cases::Case before;
  cases::Case after;
};

std::optional<Moved> moved_by(const cases::Case& c, const Move& move) {
  const auto x = exact_sum(double{c.viewport.x}, move.du);
  const auto y = exact_sum(double{c.viewport.y}, move.dv);
  if (!x || !y || !is_float(*x) || !is_float(*y)) return std::nullopt;
  Moved both{c, c};
  both.before.scissor =
      rectangle(staying(scissor_columns(c), move.du), staying(scissor_rows(c), move.dv));
  both.after.viewport.x = static_cast<float>(*x);
  both.after.viewport.y = static_cast<float>(*y);
  both.after.framebuffer.width += std::max(move.du, 0);
  both.after.framebuffer.height += std::max(move.dv, 0);
  if (both.after.framebuffer.width > cases::kMaxSize ||
      both.after.framebuffer.height > cases::kMaxSize) {
    return std::nullopt;
  }
  // The corner of an empty scissor may be beyond the window.
  cases::Scissor& scissor = both.after.scissor.emplace(*both.before.scissor);
  scissor.x += move.du;
  scissor.y += move.dv;
  return both;
}

/// The original place of a moved pixel; if there is none, a place that no case has.
std::uint16_t moved_back(std::uint16_t at, int by) {
  constexpr std::uint16_t kNowhere = std::numeric_limits<std::uint16_t>::max();
  const int was = int{at} - by;
  return was >= 0 ? static_cast<std::uint16_t>(was) : kNowhere;
}

std::string note_of(const Move& move) {
  return "drawn " + std::to_string(move.du) + " columns and " + std::to_string(move.dv) +
         " rows further on";
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend, std::uint64_t index) {
  const Move move = move_of(clip);
  const std::optional<Moved> moved = moved_by(clip, move);
  if (!moved) return not_applicable("the case cannot be moved by whole pixels");
  const cases::Contract contract = backend.contract(moved->after);
  if (contract.coverage && !(is_the_same_everywhere(*contract.coverage) &&
                             keeps_even_points(*contract.coverage, move.du) &&
                             keeps_even_points(*contract.coverage, move.dv))) {
    return not_applicable("the contract rounds moved positions differently");
  }

  const Result<backends::Drawn> before = draw_promised(moved->before, backend);
  if (!before) return tl::unexpected(before.error());
  Result<backends::Drawn> drawn = draw_promised(moved->after, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  for (std::uint16_t& x : drawn->fragments.x) x = moved_back(x, move.du);
  for (std::uint16_t& y : drawn->fragments.y) y = moved_back(y, move.dv);
  Check check = judge_changed(
      moved->before, with_origin_away(contract, std::max(std::abs(move.du), std::abs(move.dv))),
      before->fragments, drawn->fragments, index);
  add_to_notes(check, note_of(move));
  if (move.du < 0 || move.dv < 0) add_label(check, "partly out of the window");
  if (move.du % 2 != 0 || move.dv % 2 != 0) add_label(check, "odd");
  if (move.du > 16 || move.dv > 16) add_label(check, "far");
  return check;
}

Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  shorten_viewport(made.source);
  return made;
}

const LawRegistration kRegistration(
    {.id = "whole-pixels-move-the-picture",
     .sentence = "whole pixels move the picture",
     .reason = "A viewport at (x0 + du, y0 + dv) adds (du, dv) to every window position, and the "
               "samples of all pixels lie alike.",
     .exceptions = "cases whose moved viewport is no float32; what leaves the window",
     .generate = &generate,
     .check = &check,
     .takes_lines_and_points = true,
     .covers = {cover(25, "partly out of the window"), cover(30, "odd"), cover(7, "far"),
                cover(10, "snapped")}});

}  // namespace
}  // namespace rastercheck::properties::whole_pixels_move_law
