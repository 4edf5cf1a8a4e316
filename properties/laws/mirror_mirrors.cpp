// A mirror mirrors the picture: if a case is drawn with its clip positions, viewport and scissor
// mirrored, and the drawing is mirrored back, it is right for the original case.
//
//   left and right   (u, v) → (W − u, v)        up and down   (u, v) → (u, H − v)
//
// where W × H is the framebuffer's size. One mirror or both are chosen at random (choices.h).
//
// Why. Since u = x0 + w/2 + x/w w/2, the viewport at W − x0 − w and the clip position (−x, y, z, w)
// give exactly the mirrored window position. v is mirrored in the same way or, under Vulkan's
// rules, by a viewport of height −h that begins at H − y0. M is multiplied by a matrix of
// determinant −1, so det M and the edge functions change their signs. After multiplication by sign
// det M (RULES §2), edge functions are unchanged, and so are clip functionals and values. Only
// facing is reversed: one mirror turns counter-clockwise into clockwise, so either the orientation
// of front faces or the order of vertices is reversed; the provoking vertex keeps its position in
// the order.
//
// Not mirrored exactly:
//
//   ties         A_i changes its sign if left and right are mirrored. The mirror image of a tie
//                rule is then not a rule of any API, so the judging contract names no tie rule. If
//                only up and down are mirrored, B_i changes its sign, and top-left becomes
//                bottom-left; the mirrored case is drawn by that rule
//   the sides    Of two opposite borders, only one belongs to the viewport; cases with a sample
//                exactly on a mirrored side are left out
//   snapping     u = n + 1/2 grid units becomes W 2^b − n − 1/2: rounding to even is mirrored if
//                W 2^b is even, rounding half up never is
//   the pattern  Both mirrors together map the patterns of two and of four samples to themselves,
//                with other indices: such cases get both. Larger patterns cannot be mirrored
//   centroids    may be at the first covered sample; with several samples per pixel, values are
//                taken at the sample instead, under all rules
//   guard band   is centred on the window's origin, which the mirror moves by W or H; so the law
//                assumes a guard band that is narrower by that much
//
// Cases whose mirrored viewport is not float32 are left out: W − x0 − w must be exact.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "properties/choices.h"
#include "properties/exact_sum.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/changed_drawing.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/window_symmetry.h"

namespace rastercheck::properties::mirror_mirrors_law {
namespace {

using oracle::WindowAxis;

/// How a case is mirrored.
struct Mirror {
  bool is_in_x = false;
  bool is_in_y = false;
  bool swaps_vertices = false;       ///< else reverses the orientation of front faces
  bool has_negative_height = false;  ///< mirrors up and down by the viewport, not by clip y
  std::vector<std::uint8_t> samples;

  bool turns_faces() const { return is_in_x != is_in_y; }
};

/// Chooses how to mirror a case; nothing if the sample pattern cannot be mirrored.
std::optional<Mirror> mirror_of(const cases::Case& c) {
  Choices choices(choices_of(c));
  Mirror mirror;
  const std::size_t axes = c.framebuffer.samples == 1 ? choices.below(5) : 4;
  mirror.is_in_x = axes <= 1 || axes == 4;
  mirror.is_in_y = axes >= 2;
  mirror.swaps_vertices = choices.below(2) == 0;
  mirror.has_negative_height = c.rules == cases::Rules::vulkan && choices.below(2) == 0;
  const auto samples =
      c.framebuffer.samples == 1
          ? std::vector<std::uint8_t>{0}
          : carried_samples(c.framebuffer.samples, [](const cases::SamplePosition& position) {
              return cases::SamplePosition{16 - position.x, 16 - position.y};
            });
  if (!samples) return std::nullopt;
  mirror.samples = *samples;
  return mirror;
}

/// The beginning of a mirrored side of the viewport; empty if that is not float32, or if a sample
/// lies exactly on one of the side's borders.
std::optional<float> mirrored_begin(WindowAxis axis, const WindowSide& side, float size,
                                    const cases::FramebufferSize& framebuffer) {
  if (is_at_samples(axis, side.begin, framebuffer) || is_at_samples(axis, side.end, framebuffer)) {
    return std::nullopt;
  }
  const int pixels = axis == WindowAxis::x ? framebuffer.width : framebuffer.height;
  // The size keeps its sign, so the new viewport begins at the image of the old end.
  const auto begin = exact_sum(pixels, -(size > 0 ? side.end : side.begin));
  if (!begin || !is_float(*begin)) return std::nullopt;
  return static_cast<float>(*begin);
}

bool mirror_viewport(const cases::Case& c, const Mirror& mirror, cases::Case& changed) {
  const std::optional<WindowSide> across = side_of(c.viewport.x, c.viewport.width);
  const std::optional<WindowSide> down = side_of(c.viewport.y, c.viewport.height);
  if (!across || !down) return false;
  if (mirror.is_in_x) {
    const auto x = mirrored_begin(WindowAxis::x, *across, c.viewport.width, c.framebuffer);
    if (!x) return false;
    changed.viewport.x = *x;
    for (cases::ClipVertex& p : changed.positions) p.x = -p.x;
  }
  if (!mirror.is_in_y) return true;
  const auto y = mirrored_begin(WindowAxis::y, *down, c.viewport.height, c.framebuffer);
  if (!y) return false;
  if (mirror.has_negative_height) {
    const auto other = exact_sum(c.framebuffer.height, -double{c.viewport.y});
    if (!other || !is_float(*other)) return false;
    changed.viewport.y = static_cast<float>(*other);
    changed.viewport.height = -c.viewport.height;
  } else {
    changed.viewport.y = *y;
    for (cases::ClipVertex& p : changed.positions) p.y = -p.y;
  }
  return true;
}

/// Restores the facing that the mirror reversed.
void turn_faces_back(const Mirror& mirror, cases::Case& changed) {
  if (!mirror.swaps_vertices) {
    changed.front_face =
        changed.front_face == cases::FrontFace::ccw ? cases::FrontFace::cw : cases::FrontFace::ccw;
    return;
  }
  for (auto& [first, second, third] : changed.triangles) {
    if (changed.rules == cases::Rules::opengl) {
      std::swap(first, second);
    } else {
      std::swap(second, third);
    }
  }
}

/// Top-left upside down is bottom-left. Of a mirror image in x, nothing is claimed about edges.
cases::TieRule mirrored(cases::TieRule rule, const Mirror& mirror) {
  using cases::TieRule;
  if (rule == TieRule::all || rule == TieRule::none) return rule;
  if (!mirror.is_in_x && rule == TieRule::top_left) return TieRule::bottom_left;
  if (!mirror.is_in_x && rule == TieRule::bottom_left) return TieRule::top_left;
  return TieRule::unspecified;
}

PixelSpan mirrored(const PixelSpan& span, int pixels) {
  return {pixels - span.last, pixels - span.first};
}

std::optional<cases::Case> mirrored_case(const cases::Case& c, const Mirror& mirror) {
  cases::Case changed = c;
  if (!mirror_viewport(c, mirror, changed)) return std::nullopt;
  if (mirror.turns_faces()) turn_faces_back(mirror, changed);
  if (!mirror.is_in_x) changed.fill_rule = mirrored(c.fill_rule, mirror);
  if (c.scissor) {
    PixelSpan columns = scissor_columns(c);
    PixelSpan rows = scissor_rows(c);
    if (mirror.is_in_x) columns = mirrored(columns, c.framebuffer.width);
    if (mirror.is_in_y) rows = mirrored(rows, c.framebuffer.height);
    changed.scissor = rectangle(columns, rows);
  }
  return changed;
}

/// Maps fragments of the mirrored case to their places in the original case. A fragment outside the
/// mirrored case stays outside the original one.
cases::Fragments mirrored_back(const cases::Case& c, const cases::Fragments& drawn,
                               const Mirror& mirror) {
  const auto back = [](std::uint16_t at, int pixels) {
    constexpr std::uint16_t kNowhere = std::numeric_limits<std::uint16_t>::max();
    return std::cmp_less(at, pixels) ? static_cast<std::uint16_t>(pixels - 1 - at) : kNowhere;
  };
  cases::Fragments result = drawn;
  result.derivatives.clear();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (mirror.is_in_x) result.x[i] = back(drawn.x[i], c.framebuffer.width);
    if (mirror.is_in_y) result.y[i] = back(drawn.y[i], c.framebuffer.height);
    result.sample[i] = carried_back(mirror.samples, drawn.sample[i]);
  }
  return result;
}

/// The promise that the backend's contract for the mirrored case makes for the original case; empty
/// if the contract's rounding is not mirrored.
std::optional<cases::Contract> mirrored_back(const cases::Case& c, const cases::Contract& contract,
                                             const Mirror& mirror) {
  if (contract.sample_position || contract.culls != cases::Winding::none) return std::nullopt;
  cases::Contract result = contract;
  result.tie_rule = mirrored(contract.tie_rule, mirror);
  if (!contract.coverage) return result;
  const cases::Snapping& grid = *contract.coverage;
  const int width = mirror.is_in_x ? c.framebuffer.width : 0;
  const int height = mirror.is_in_y ? c.framebuffer.height : 0;
  if (!is_symmetric(grid)) return std::nullopt;
  if (!keeps_even_points(grid, width) || !keeps_even_points(grid, height)) return std::nullopt;
  return with_origin_away(result, std::max(width, height));
}

std::string_view name_of(const Mirror& mirror) {
  if (mirror.is_in_x && mirror.is_in_y) return "both mirrored";
  return mirror.is_in_x ? "left and right mirrored" : "up and down mirrored";
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  cases::ClipCase clip = c;
  if (clip.framebuffer.samples > 1) move_centroids_to_samples(clip);
  const std::optional<Mirror> mirror = mirror_of(clip);
  if (!mirror) return not_applicable("the mirrored viewport or scissor is not allowed in a case");
  const std::optional<cases::Case> changed = mirrored_case(clip, *mirror);
  if (!changed) return not_applicable("the mirrored viewport or scissor is not allowed in a case");
  const auto contract = mirrored_back(clip, backend.contract(*changed), *mirror);
  if (!contract)
    return not_applicable("the contract does not cover the mirrored case in the same way");

  const Result<backends::Drawn> before = draw_promised(clip, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(*changed, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  Check check = judge_changed(clip, *contract, before->fragments,
                              mirrored_back(clip, drawn->fragments, *mirror), index);
  add_to_notes(check, "drawn with " + std::string(name_of(*mirror)));
  add_label(check, name_of(*mirror));
  if (clip.cull != cases::Cull::none && mirror->turns_faces()) {
    add_label(check, "faces turned round");
  }
  return check;
}

/// Makes cases with one, two or four samples, which cull faces more often than other cases.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  if (c.framebuffer.samples > 4) c.framebuffer.samples = draw.one_in(2) ? 2 : 4;
  shorten_viewport(c);
  if (c.cull == cases::Cull::none && draw.one_in(4)) {
    c.cull = draw.pick(std::array{cases::Cull::back, cases::Cull::front});
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-mirror-mirrors-the-picture",
     .sentence = "a mirror mirrors the picture",
     .reason = "Mirrored clip positions and viewports change the sign of det M and of all edge "
               "functions, which their product does not show.",
     .exceptions =
         "ties where left and right are mirrored, snapping whose rounding is not, patterns "
         "of eight and sixteen samples, cases whose mirrored viewport is no float32",
     .generate = &generate,
     .check = &check,
     .covers = {cover(10, "left and right mirrored"), cover(10, "up and down mirrored"),
                cover(20, "both mirrored"), cover(7, "faces turned round"), cover(10, "snapped"),
                cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::mirror_mirrors_law
