#pragma once

// The moves by which a hunt (properties/campaign/hunt.h) changes a case in search of larger errors:
// a table of named functions. A new move is one function and one row of the table in
// case_moves.cpp.
//
// A move changes one triangle, with one of its samples and one of its values in focus, and works on
// clip positions and attribute values. It keeps all numbers finite. It may use features that a
// backend lacks, such as a vertex behind the eye; fit_case() (properties/fitting.h) takes these
// away afterwards.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "cases/case.h"
#include "cases/sample_place.h"
#include "properties/draw.h"

namespace rastercheck::properties {

/// The part of a case that a move is about.
struct MoveFocus {
  cases::SamplePlace at = {};              ///< a triangle and one of its samples
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; empty for depth
};

struct CaseMove {
  std::string_view name;  ///< a clause: "a vertex towards the horizon"
  /// Changes the case; returns false, and leaves the case unchanged, if the move does not apply to
  /// the case. The case has no camera, and the focus exists in it.
  bool (*change)(cases::Case& c, const MoveFocus& focus, Draw& draw) = nullptr;
};

/// All moves. Appending one changes the results of hunts with the same seed.
std::span<const CaseMove> case_moves();
/// Returns the move with this name; nullptr if none.
const CaseMove* find_move(std::string_view name);

/// The shares of a triangle's vertices in a value at a sample, for the triangle without snapping: a
/// smooth value is Σ share_i r_i, with shares e_i / Σ e_i, and a noperspective value likewise, with
/// shares w_i e_i / Σ w_i e_i. Empty for a triangle without area, and for a zero sum.
std::optional<std::array<double, 3>> vertex_shares(const cases::Case& c, const MoveFocus& focus);

}  // namespace rastercheck::properties
