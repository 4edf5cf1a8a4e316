#pragma once

// The window turned by a quarter, exactly:
//
//   (u, v) → (H − v, u),   H the framebuffer's height          pixel (i, j) → (H − 1 − j, i)
//
// With u = x0 + W/2 + x/w W/2 and v = y0 + h/2 ± y/w h/2 (− for D3D), a viewport of the sizes h × W
// at (H − y0 − h, x0) and the clip position (∓y, ±x, z, w) give just these window positions. A
// negative height (or width) is taken for a positive one from the other end, which only changes
// the clip coordinate's sign, so that no turned viewport has a negative width.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/fragments.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// A turn that has no rounding. Turned clip positions are (±y, ±x, z, w).
struct QuarterTurn {
  cases::Viewport viewport;           ///< the turned one
  std::vector<std::uint8_t> samples;  ///< of carried_samples()
  bool negates_y = false;             ///< turned x is −y
  bool negates_x = false;             ///< turned y is −x
};

/// Nothing where the turned viewport is no float32, a sample lies exactly on an upper or lower side
/// of the viewport (one of the two is inside, and turns into one of the other kind), or the pattern
/// of samples does not turn.
std::optional<QuarterTurn> quarter_turn_of(const cases::Case& c);

/// The case's framebuffer, viewport and scissor turned; positions and camera stay.
cases::Case turned_window(const cases::Case& c, const QuarterTurn& turn);

cases::ClipVertex turned(const cases::ClipVertex& p, const QuarterTurn& turn);
cases::ClipVertex turned_back(const cases::ClipVertex& p, const QuarterTurn& turn);

/// What was drawn of the turned case, in the places that it has in the case as it was, without
/// derivatives, which are along the turned axes. A fragment of no pixel or sample of the turned
/// case gets one that the case does not have either.
cases::Fragments turned_back(const cases::Case& c, const cases::Fragments& drawn,
                             const QuarterTurn& turn);

/// What the backend promises of the turned case, of the case as it was; nothing where its rounding
/// does not turn: v = n + 1/2 grid units turns into H 2^b − n − 1/2, and the even one of its
/// neighbours is that of n and n + 1 if H 2^b is even. No tie rule turns.
std::optional<cases::Contract> turned_back(const cases::Case& c, const cases::Contract& contract);

/// "drawn turned by a quarter, at pixel (…, …)", for a violation at a place of the case as it was.
std::string turned_note(const cases::Case& c, const records::Violation& violation);

}  // namespace rastercheck::properties
