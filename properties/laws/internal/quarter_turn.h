#pragma once

// Turns the window by a quarter, exactly:
//
//   (u, v) → (H − v, u),   H the framebuffer's height          pixel (i, j) → (H − 1 − j, i)
//
// Since u = x0 + W/2 + x/w W/2 and v = y0 + h/2 ± y/w h/2 (− for D3D), the viewport of size h × W
// at (H − y0 − h, x0) and the clip position (∓y, ±x, z, w) give exactly these window positions. A
// negative height (or width) is treated as a positive one from the other end, which only flips the
// clip coordinate's sign, so no turned viewport has a negative width.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/fragments.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// A turn without rounding. Turned clip positions are (±y, ±x, z, w).
struct QuarterTurn {
  cases::Viewport viewport;           ///< the turned viewport
  std::vector<std::uint8_t> samples;  ///< from carried_samples()
  bool negates_y = false;             ///< turned x is −y
  bool negates_x = false;             ///< turned y is −x
};

/// Returns nothing if the turned viewport is not float32, if the sample pattern changes under the
/// turn, or if a sample lies exactly on the viewport's upper or lower side (only one of the two
/// sides belongs to the viewport, and the turn exchanges which).
std::optional<QuarterTurn> quarter_turn_of(const cases::Case& c);

/// Turns the case's framebuffer, viewport and scissor; positions and camera stay.
cases::Case turned_window(const cases::Case& c, const QuarterTurn& turn);

cases::ClipVertex turned(const cases::ClipVertex& p, const QuarterTurn& turn);
cases::ClipVertex turned_back(const cases::ClipVertex& p, const QuarterTurn& turn);

/// Maps fragments of the turned case to their places in the original case. Drops derivatives, which
/// are along the turned axes. A fragment outside the turned case stays outside the original one.
cases::Fragments turned_back(const cases::Case& c, const cases::Fragments& drawn,
                             const QuarterTurn& turn);

/// Returns what the backend's contract for the turned case promises for the original case. Returns
/// nothing if the turn changes rounding: v = n + 1/2 grid units becomes H 2^b − n − 1/2, and even
/// neighbours stay even only if H 2^b is even. The result names no tie rule, since none survives
/// the turn.
std::optional<cases::Contract> turned_back(const cases::Case& c, const cases::Contract& contract);

/// "drawn turned by a quarter, at pixel (…, …)", for a violation at a place of the original case.
std::string turned_note(const cases::Case& c, const records::Violation& violation);

}  // namespace rastercheck::properties
