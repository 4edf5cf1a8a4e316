// A quarter turn turns the picture: what is drawn of a case whose clip positions, viewport and
// scissor are turned by 90° is, turned back, right for the case as it was.
//
//   (u, v) → (H − v, u),   H the framebuffer's height          pixel (i, j) → (H − 1 − j, i)
//
// Why. With u = x0 + W/2 + x/w W/2 and v = y0 + h/2 ± y/w h/2 (− for D3D), a viewport of the sizes
// h × W at (H − y0 − h, x0) and the clip position (∓y, ±x, z, w) give just these window positions,
// exactly. M is multiplied by a matrix of determinant 1: facing and 1/w stay, and so do the edge
// functions, clip functionals and values at each sample. A negative height (or width) is taken for
// a positive one from the other end, which only changes the clip coordinate's sign, so that no
// turned viewport has a negative width.
//
// What does not turn with the picture:
//
//   ties         go by a rule of left and right: the contract that judges names none
//   centroids    of D3D are at the first covered sample: they are moved to the sample
//   the sides    of a viewport, one of which has its border inside: cases with a sample exactly on
//                an upper or lower one are left out
//   snapping     turns with a grid that has H on it: v = n + 1/2 grid units turns into
//                H 2^b − n − 1/2, and the even one of its neighbours is that of n and n + 1 if
//                H 2^b is even. Rounding half up does not turn; it is left out
//   the pattern  of samples, but for those of one and of four, whose indices are permuted
//   guard band   around the window's origin, which is H away: it is judged as narrower by H
//
// Cases whose turned viewport is no float32 are left out: H − y0 − h is exact or not taken.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "cases/sample_pattern.h"
#include "oracle/transform.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

/// a + b where that is a double. Two-Sum: what the rounding left out is exact.
std::optional<double> exact_sum(double a, double b) {
  const double sum = a + b;
  const double of_b = sum - a;
  const double left_out = (a - (sum - of_b)) + (b - of_b);
  if (left_out != 0) return std::nullopt;
  return sum;
}

bool is_float(double value) {
  return std::abs(value) <= double{std::numeric_limits<float>::max()} &&
         static_cast<double>(static_cast<float>(value)) == value;
}

/// A side of the viewport: from `begin` to `begin + size`, both exact in double, size > 0; and
/// whether the clip coordinate runs the other way.
struct Side {
  double begin = 0;
  double size = 0;
  double end = 0;
  bool is_turned_round = false;
};

std::optional<Side> side_of(float begin, float size) {
  const std::optional<double> end = exact_sum(double{begin}, double{size});
  if (!end || size == 0) return std::nullopt;
  if (size < 0) return Side{*end, -double{size}, double{begin}, true};
  return Side{double{begin}, double{size}, *end, false};
}

/// Whether a row of the framebuffer's samples lies at v.
bool is_at_samples(double v, const cases::FramebufferSize& size) {
  const auto pattern = cases::standard_pattern(size.samples);
  return std::any_of(pattern.begin(), pattern.end(), [&](const cases::SamplePosition& position) {
    const auto row = exact_sum(v, -static_cast<double>(position.y) / 16);
    return row && *row >= 0 && *row < size.height && std::floor(*row) == *row;
  });
}

/// [sample]: the sample whose place it takes in the turned pattern, (x, y) → (16 − y, x); nothing
/// where the turned pattern is another.
std::optional<std::vector<std::uint8_t>> turned_samples(int samples) {
  const auto pattern = cases::standard_pattern(samples);
  std::vector<std::uint8_t> turned;
  for (const cases::SamplePosition& position : pattern) {
    const cases::SamplePosition to{16 - position.y, position.x};
    const auto found = std::find(pattern.begin(), pattern.end(), to);
    if (found == pattern.end()) return std::nullopt;
    turned.push_back(static_cast<std::uint8_t>(found - pattern.begin()));
  }
  return turned;
}

/// The turned viewport; the clip coordinates that were y and x have to change their sign where
/// `turns_x`, `turns_y`.
struct TurnedViewport {
  cases::Viewport viewport;
  bool turns_x = false;
  bool turns_y = false;
};

std::optional<TurnedViewport> turned_viewport(const cases::Case& c) {
  const std::optional<Side> across = side_of(c.viewport.x, c.viewport.width);
  const std::optional<Side> down = side_of(c.viewport.y, c.viewport.height);
  if (!across || !down) return std::nullopt;
  if (is_at_samples(down->begin, c.framebuffer) || is_at_samples(down->end, c.framebuffer)) {
    return std::nullopt;
  }
  const std::optional<double> x = exact_sum(static_cast<double>(c.framebuffer.height), -down->end);
  if (!x || !is_float(*x) || !is_float(across->begin)) return std::nullopt;
  // u' = H − v, v' = u: a clip x that grows with −v, and a clip y that grows with u where window y
  // grows with it.
  const bool is_d3d = c.rules == cases::Rules::d3d;
  TurnedViewport turned;
  turned.viewport = c.viewport;
  turned.viewport.x = static_cast<float>(*x);
  turned.viewport.y = static_cast<float>(across->begin);
  turned.viewport.width = static_cast<float>(down->size);
  turned.viewport.height = static_cast<float>(across->size);
  turned.turns_x = down->is_turned_round == is_d3d;
  turned.turns_y = across->is_turned_round != is_d3d;
  return turned;
}

cases::Scissor turned_scissor(const cases::Case& c) {
  const auto held = [](std::int64_t at, int size) {
    return static_cast<int>(std::clamp(at, std::int64_t{0}, std::int64_t{size}));
  };
  const cases::FramebufferSize& size = c.framebuffer;
  const int left = held(c.scissor->x, size.width);
  const int right = held(std::int64_t{c.scissor->x} + c.scissor->width, size.width);
  const int top = held(c.scissor->y, size.height);
  const int bottom = held(std::int64_t{c.scissor->y} + c.scissor->height, size.height);
  return {size.height - bottom, left, bottom - top, right - left};
}

cases::Case turned_case(const cases::Case& c, const TurnedViewport& turned) {
  cases::Case result = c;
  std::swap(result.framebuffer.width, result.framebuffer.height);
  result.viewport = turned.viewport;
  if (c.scissor) result.scissor = turned_scissor(c);
  for (cases::ClipVertex& p : result.positions) {
    p = {turned.turns_x ? -p.y : p.y, turned.turns_y ? -p.x : p.x, p.z, p.w};
  }
  return result;
}

/// What was drawn of the turned case, in the places that it has in the case as it was. A fragment
/// of no pixel or sample of the turned case gets one that the case does not have either.
cases::Framebuffer turned_back(const cases::Case& c, const cases::Framebuffer& drawn,
                               const std::vector<std::uint8_t>& turned_sample) {
  constexpr std::uint16_t kNowhere = std::numeric_limits<std::uint16_t>::max();
  cases::Framebuffer result = drawn;
  result.derivatives.clear();  // along the axes of the turned window; nobody asks for them
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    // x = H − 1 − j, y = i.
    const bool is_inside = std::cmp_less(drawn.x[i], c.framebuffer.height);
    result.x[i] = drawn.y[i];
    result.y[i] =
        is_inside ? static_cast<std::uint16_t>(c.framebuffer.height - 1 - drawn.x[i]) : kNowhere;
    const auto found = std::find(turned_sample.begin(), turned_sample.end(), drawn.sample[i]);
    if (found != turned_sample.end()) {
      result.sample[i] = static_cast<std::uint8_t>(found - turned_sample.begin());
    }
  }
  return result;
}

/// What the backend promises of the turned case, of the case as it was; nothing where it does not
/// turn.
std::optional<cases::Contract> turned_contract(const cases::Case& c, cases::Contract contract) {
  contract.tie_rule = cases::TieRule::unspecified;
  if (!contract.coverage) return contract;
  const cases::Snapping& grid = *contract.coverage;
  if (grid.rounding == cases::Rounding::half_up) return std::nullopt;
  const bool is_even = grid.subpixel_bits > 0 || c.framebuffer.height % 2 == 0;
  if (grid.rounding == cases::Rounding::nearest_even && !is_even) return std::nullopt;
  const auto height = static_cast<float>(c.framebuffer.height);
  contract.guard_band = std::max(contract.guard_band - height, 0.0F);
  return contract;
}

Result<Check> check(const cases::Case& c, backends::Backend& backend, const CheckOptions& options) {
  Result<cases::Case> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  for (cases::Attribute& attribute : clip->attributes) {
    if (attribute.location == cases::Location::centroid) {
      attribute.location = cases::Location::sample;
    }
  }
  Check none;
  none.is_applicable = false;
  const auto samples = turned_samples(clip->framebuffer.samples);
  const std::optional<TurnedViewport> viewport = turned_viewport(*clip);
  if (!samples || !viewport) return none;
  const cases::Case turned = turned_case(*clip, *viewport);
  const auto contract = turned_contract(*clip, backend.contract(turned));
  if (!contract) return none;

  const Result<cases::Framebuffer> drawn = draw(turned, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  Check check = judge_drawn(*clip, *contract, turned_back(*clip, *drawn, *samples), {}, options);
  for (records::Violation& violation : check.violations) {
    violation.note += violation.note.empty() ? "" : "; ";
    violation.note += "drawn turned by a quarter, at pixel (" +
                      std::to_string(clip->framebuffer.height - 1 - static_cast<int>(violation.y)) +
                      ", " + std::to_string(violation.x) + ")";
  }
  return check;
}

/// Cases with the viewport's borders between rows of samples, and with one or four of these.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  if (!turned_samples(c.framebuffer.samples)) c.framebuffer.samples = draw.one_in(2) ? 1 : 4;
  return made;
}

const LawRegistration kRegistration(
    {.name = "a quarter turn turns the picture",
     .reason = "Clip positions and viewport that are turned by 90° multiply M by a matrix of "
               "determinant 1.",
     .exceptions = "ties, snapping whose rounding does not turn, patterns of samples that do not, "
                   "cases whose turned viewport is no float32",
     .generate = &generate,
     .check = &check});

}  // namespace
}  // namespace rastercheck::properties
