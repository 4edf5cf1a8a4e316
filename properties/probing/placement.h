#pragma once

// Finds out where a backend places things, by and large: upside down, mirrored, transposed, moved
// by half pixels, or in a viewport that is a pixel too small.
//
// The triangles' vertices lie at whole pixels, which belong to every grid, so no grid moves them. A
// placement predicts each sample that lies farther from all edges than a margin, and leaves the
// others undecided, so a backend may be off by the margin. The turn is found first, with a margin
// so wide that moves and a small viewport cannot matter.

#include <vector>

#include "properties/probing/fine_triangle.h"
#include "records/probe.h"

namespace rastercheck::properties {

/// Where a window position is drawn. Applied in the order of the members.
struct Placement {
  bool is_transposed = false;
  bool is_mirrored = false;     ///< left to right
  bool is_upside_down = false;  ///< top to bottom
  int shrink_x = 0;             ///< pixels by which the viewport is too narrow
  int shrink_y = 0;             ///< pixels by which the viewport is too low
  int move_x = 0;               ///< half pixels towards +x
  int move_y = 0;               ///< half pixels towards +y
  bool operator==(const Placement&) const = default;

  bool is_turned() const { return is_transposed || is_mirrored || is_upside_down; }
  bool is_moved() const { return move_x != 0 || move_y != 0; }
  bool is_shrunk() const { return shrink_x != 0 || shrink_y != 0; }
};

FineTriangle placed(const FineTriangle& triangle, const Placement& placement);

/// The share of samples against a placement that explains (nearly) all of a drawing: 1 in 50.
inline constexpr std::uint64_t kFewAgainst = 50;

/// True if (nearly) all votes are in favour, and there are enough to tell.
bool is_sure(const records::Sureness& votes);

/// Counts samples that are drawn as a placement predicts, or otherwise. A sample that is neither
/// predicted nor drawn does not count, nor does a triangle without any drawn sample.
records::Sureness votes_of(const std::vector<FineDrawing>& drawings, const Placement& placement,
                           double margin);
/// Counts the samples about which two placements disagree; those drawn as `one` predicts are in
/// favour.
records::Sureness votes_between(const std::vector<FineDrawing>& drawings, const Placement& one,
                                const Placement& other, double margin);

/// The margin that is left to backends when moves are looked for, in pixels.
inline constexpr double kFineMargin = 1.0 / 8;

struct FoundPlacement {
  Placement placement;
  records::Sureness turn;    ///< against a drawing as asked
  records::Sureness move;    ///< against the same placement without the move
  records::Sureness shrink;  ///< against the same placement in the whole viewport
  /// True if the placement explains the drawing up to kFineMargin, not just the turn.
  bool is_fine = false;
};

/// Returns the placement that explains (nearly) all of the drawings, each of its parts being
/// needed; empty if none does.
std::optional<FoundPlacement> find_placement(const std::vector<FineDrawing>& drawings);

}  // namespace rastercheck::properties
