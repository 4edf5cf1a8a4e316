#pragma once

// Triangles in parts: vertices that are exact mixes of others, and what a drawing of the parts has
// in common with a drawing of the whole.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "properties/law.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// The case, each triangle with vertices of its own, whose numbers are so short that mixes of them
/// in quarters are float32: of each coordinate, attribute and clip distance, multiples of 2^-12 of
/// the power of two at or below the greatest of the triangle's three, and of 2^-147. Attributes are
/// smooth, located at the sample, because those alone mix with the clip positions; there is no
/// depth test.
cases::Case with_short_vertices(const cases::Case& c);

/// Rounds three positions alike.
void shorten_positions(std::span<cases::ClipVertex, 3> positions);

/// Appends Σ quarters_i / 4 of the vertices, quarters that are not negative and sum to 4; its
/// position, attributes and clip distances are exact.
std::uint32_t add_mixed(cases::Case& c, const std::array<std::uint32_t, 3>& vertices,
                        const std::array<int, 3>& quarters);

/// A case and the same with its triangles in parts; vertices of the former are the first of the
/// latter.
struct Parted {
  cases::Case whole;
  cases::Case parts;
  std::vector<std::uint32_t> triangle_of;  ///< [part]
  std::string note;                        ///< for violations: how the parts came about
  /// Samples whose being drawn by the parts or by the whole need not say the same, besides those
  /// that the contract leaves open. May be empty.
  std::function<bool(const cases::SamplePlace& place)> is_exempt;
};

/// Draws both. What the parts draw together is what the whole draws, each sample once, and of the
/// same values: within the sum of the bounds (close_drawings.h), where the contract takes them from
/// the exact positions. A part's vertices are no farther from 0 than the whole's, nor their w
/// farther apart, so that what is promised of the whole is promised of a part.
///
/// Where vertices are snapped, those that parts add are too. Moving each vertex by at most `reach`
/// along both axes moves each point of an outline by at most √2 reach. Of parts that all turn as
/// they should, with no others between, the number that covers a point is how often their outline
/// runs around it (each edge inside is there twice, in opposite directions), and that is the same
/// for the whole at a point that neither outline passes. So samples are open that are
///
/// - within 3 reach, or clip tolerances, of the whole's boundary; >= 2√2, the oracle's is snapped
/// - of a triangle some part of which may turn the other way, or is clipped
/// - permitted of the whole
/// - permitted of a part, under a contract that names no tie rule or keeps no grid
Result<Check> check_parted(const Parted& parted, backends::Backend& backend);

}  // namespace rastercheck::properties
