#pragma once

// The first level's knowledge of what a contract leaves open of values: which certainly lie between
// two that it permits, and which beyond all, by how much.
//
// Shape placed. A placement moves vertex i, at window position x_i, by δ_i. The affine map
//
//   T(p) = p + Σ α_i(p) δ_i,     α_i(p) = w_i E_i(p)/|det M|,  Σ α_i = 1,
//
// takes each x_i there, and what is carried with the vertices has at T(p) the value that it had at
// p. So the moved triangle has at a sample p the value that the exact one has at q = T^-1(p). With
// A the linear part of Σ α_i δ_i,
//
//   q = p − Σ α_i(p) δ'_i,     δ'_i = (1 + A)^-1 δ_i.
//
// ρ bounds A, in the norm that the largest coordinate gives, and S the weights:
//
//   ρ = Σ w_i band_i/|det M|,    band_i = reach (|A_i| + |B_i|),    as |δ_i| <= reach,
//   S >= Σ |α_i(p)|,             |p − q| <= reach S/(1 − ρ).
//
// A sample that may be covered has E_i(p) >= −band_i (TriangleSetup::edge_bands), so there
// S = 1 + 2ρ; at a pixel's centre, which is at most 1/2 away along either axis,
// S = 1 + 2ρ (1 + 1/(2 reach)).
//
// Between. The kernel (filter_kernels.h) looks at four placements: all vertices moved as far as
// they go to the left or the right, up or down. Values on both sides of a computed one among
// theirs, and the exact triangle's where the basis is unspecified, hold it between them. Where some
// placement turns the triangle round, or has 1/w <= 0 at a sample, all that lies between the
// vertices' values is permitted there, so only such values are asked about.
//
// Beyond. How G(q) (filter_kernels.h) changes with the x of a δ_i has the sign of
//
//   −α_i(q) (G_x (1 + A_yy) − G_y A_yx),
//
// G_x and G_y being its slopes, and alike with y. The second factor is the same for all vertices,
// and depends on the y of their δ only. So where all α_i(q) > 0, whichever y they have, G is least
// where all x are moved the same way, and alike the y: among the four placements. Elsewhere another
// one may have less. Σ α_i δ_i at q and at p differ by at most reach S ρ/(1 − ρ); at p the four
// have the least but for what negative α_i, whose sum is at least −(S − 1)/2, make of δ_i that
// differ by up to 2 reach: together
//
//   Σ |g_i| band_i (2 S ρ/(1 − ρ) + S − 1)
//
// less. A computed value with G > 0 at all placements lies above the greatest reading, by
//
//   min G(q)/Σ E_i(q),     Σ E_i(q) within (|Σ A_i| + |Σ B_i|) reach S/(1 − ρ) of Σ E_i(p),
//
// or G(q)/|det M| of an affine value. Readings are cut down to what lies between the vertices'
// values; the exact triangle's is not.
//
// Shape cut. What is permitted are the values that the exact polygon has within `reach` of a sample
// along both axes (TriangleValues::cut_value). The kernel looks at the corners of that square,
// where it lies inside the polygon: the extremes are there.

#include <array>
#include <optional>
#include <vector>

#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/triangle_setup.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// Knows one triangle, and the points where its values are evaluated.
struct PlacementFilter {
  std::array<Shift, kShifts> shifts;
  std::vector<FilterLine> guards;
  /// What E_i may be off by at a shifted sample, the band of `edges` included.
  std::array<double, 3> edge_error{};
  /// Where some E_i is less, placements that the kernel does not look at may count.
  std::array<double, 3> least_weight{};
  /// How much less or more E_i then has to be taken for.
  std::array<double, 3> edge_change{};
  /// What Σ E_i may change by from a sample to where it is shifted.
  double divisor_change = 0;
};

/// The filter of shape placed or cut, for samples or, `at_center`, for the centres of pixels with
/// several samples; `edges` are those of the exact triangle, about the corner of `box`. Nothing
/// where doubles say too little of the triangle.
std::optional<PlacementFilter> placement_filter(const TriangleSetup& triangle,
                                                const std::array<FilterLine, 3>& edges,
                                                const PixelBox& box, bool at_center);

/// By how much, in scale ULP, the value computed at the lane's sample lies beyond all that the
/// contract leaves open; nothing where doubles are not sure that it does. `ideal` encloses its
/// ideal error.
std::optional<records::Enclosure> excess_of(const PlacementFilter& filter, const ValueFilter& value,
                                            const ShiftedReadings& readings,
                                            const BatchWeights& weights, const BatchShifts& shifts,
                                            std::size_t lane, double computed,
                                            const records::Enclosure& ideal);

}  // namespace rastercheck::oracle
