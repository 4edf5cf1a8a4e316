#pragma once

// Cuts triangles into parts at vertices that are exact means of the triangle's own vertices, and
// checks that a drawing of the parts matches a drawing of the whole.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "properties/law.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// Returns the case with three vertices of its own for each triangle, and numbers of so few bits
/// that weighted means of three vertices are exact in float32 if the weights are multiples of 1/4.
/// Each coordinate, attribute and clip distance becomes a multiple of 2^-147 and of 2^-12 p, where
/// p is the power of two at or below its greatest magnitude at the triangle's vertices. Attributes
/// become smooth and located at the sample, because only such attributes have means where the clip
/// positions do. The depth test is off.
cases::Case with_short_vertices(const cases::Case& c);

/// Rounds three positions as with_short_vertices() does.
void shorten_positions(std::span<cases::ClipVertex, 3> positions);

/// Appends the vertex Σ quarters_i vertices_i / 4 and returns its index. The quarters must be >= 0
/// and sum to 4. Position, attributes and clip distances are exact.
std::uint32_t add_mixed(cases::Case& c, const std::array<std::uint32_t, 3>& vertices,
                        const std::array<int, 3>& quarters);

/// A case, and the same case with its triangles cut into parts. The vertices of `whole` come first
/// in `parts`.
struct Parted {
  cases::Case whole;
  cases::Case parts;
  std::vector<std::uint32_t> triangle_of;  ///< [part]: its triangle in `whole`
  std::string note;                        ///< for violations: how the parts were made
  /// True for samples on which parts and whole need not agree, besides those that the contract
  /// leaves open. May be empty.
  std::function<bool(const cases::SamplePlace& place)> is_exempt;
};

/// Draws both cases, and checks that the parts together draw what the whole draws: each sample
/// once, with values within the sum of both bounds (close_drawings.h) if the contract takes values
/// from the exact positions. A part's vertices are no farther from 0 than the whole's, and their w
/// are no farther apart, so a promise for the whole also holds for a part.
///
/// If vertices are snapped, so are the vertices that the parts add. Moving each vertex by at most
/// `reach` along both axes moves each point of an outline by at most √2 reach. If every part keeps
/// its orientation, the number of parts that cover a point is the winding number of their outline
/// around the point (each inner edge occurs twice, in opposite directions). Around a point that
/// neither outline passes while it moves, the whole's outline has the same winding number. So a
/// sample is open if it is
///
/// - within 3 reach (or 3 clip tolerances, if more) of the whole's boundary. At least 2√2 are
///   needed, since the boundary in the oracle is snapped, too
/// - in a triangle with a part that is clipped, or whose orientation may flip
/// - permitted for the whole
/// - permitted for a part, under a contract that names no tie rule or may place vertices off the
///   grid
Result<Check> check_parted(const Parted& parted, backends::Backend& backend);

}  // namespace rastercheck::properties
