#pragma once

// The first level's test for values that a contract leaves open. The test finds the computed values
// that certainly lie between two permitted values, and those that certainly lie beyond all
// permitted values, with the distance.
//
// Shape placed. A placement moves vertex i, at window position x_i, by δ_i. The affine map
//
//   T(p) = p + Σ α_i(p) δ_i,     α_i(p) = w_i E_i(p)/|det M|,  Σ α_i = 1,
//
// takes each x_i to its moved position. The moved triangle has at T(p) the value that the exact
// triangle has at p. So at a sample p the moved triangle has the value that the exact one has at q
// = T^-1(p). With A the linear part of Σ α_i δ_i,
//
//   q = p − Σ α_i(p) δ'_i,     δ'_i = (1 + A)^-1 δ_i.
//
// ρ bounds A in the maximum norm, and S bounds the weights:
//
//   ρ = Σ w_i band_i/|det M|,    band_i = reach (|A_i| + |B_i|),    as |δ_i| <= reach,
//   S >= Σ |α_i(p)|,             |p − q| <= reach S/(1 − ρ).
//
// A sample that may be covered has E_i(p) >= −band_i (TriangleSetup::edge_bands), so there
// S = 1 + 2ρ; at a pixel's centre, which is at most 1/2 away along either axis,
// S = 1 + 2ρ (1 + 1/(2 reach)).
//
// Between. The kernel (filter_kernels.h) looks at four placements, in which all vertices are moved
// as far as possible to the left or right, and up or down. A computed value certainly lies in the
// range if these readings, and the exact triangle's if the basis is unspecified, lie on both sides
// of it. If some placement turns the triangle round, or has 1/w <= 0 at a sample, every value
// between the vertices' values is permitted there, so only such values are tested.
//
// Beyond. The derivative of G(q) (filter_kernels.h) by the x of a δ_i has the sign of
//
//   −α_i(q) (G_x (1 + A_yy) − G_y A_yx),
//
// where G_x and G_y are the slopes of G; likewise for y. The second factor is the same for all
// vertices and depends only on the y of their δ. So if all α_i(q) > 0, G is least when all x are
// moved the same way, whatever the y, and vice versa: at one of the four placements. If some α_i(q)
// <= 0, another placement may have a smaller G. Σ α_i δ_i at q and at p differ by at most reach S
// ρ/(1 − ρ). At p, one of the four placements has the least G, except that a vertex with α_i < 0
// should be moved the other way, by up to 2 reach; the sum of these α_i is at least −(S − 1)/2.
// Altogether, G may be smaller by
//
//   Σ |g_i| band_i (2 S ρ/(1 − ρ) + S − 1)
//
// A computed value with G > 0 at all placements lies above the greatest reading, by
//
//   min G(q)/Σ E_i(q),     Σ E_i(q) within (|Σ A_i| + |Σ B_i|) reach S/(1 − ρ) of Σ E_i(p),
//
// or G(q)/|det M| for an affine value. Readings of the placements are clamped to the range of the
// vertices' values; the exact triangle's reading is not.
//
// Shape cut. The permitted values are those that the exact polygon has within `reach` of a sample
// along both axes (TriangleValues::cut_value). If that square lies inside the polygon, the kernel
// looks at its corners, where the extremes are.

#include <array>
#include <optional>
#include <vector>

#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/triangle_setup.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// The filter of one triangle and one kind of evaluation point.
struct PlacementFilter {
  std::array<Shift, kShifts> shifts;
  std::vector<FilterLine> guards;
  /// The largest error of E_i at a shifted sample, including the band of `edges`.
  std::array<double, 3> edge_error{};
  /// If some E_i is below this, placements that the kernel does not look at may count.
  std::array<double, 3> least_weight{};
  /// If some E_i is below its least_weight, the amount by which E_i must be decreased or increased
  /// to allow for the placements that the kernel does not look at.
  std::array<double, 3> edge_change{};
  /// The largest change of Σ E_i from a sample to its shifted place.
  double divisor_change = 0;
};

/// Makes the filter of a triangle of shape placed or cut, for samples or, with `at_center`, for the
/// centres of pixels with several samples. `edges` are those of the exact triangle, relative to the
/// corner of `box`. Empty if doubles are too inaccurate.
std::optional<PlacementFilter> placement_filter(const TriangleSetup& triangle,
                                                const std::array<FilterLine, 3>& edges,
                                                const PixelBox& box, bool at_center);

/// The distance, in scale ULP, by which the value computed at the lane's sample lies beyond
/// everything that the contract leaves open; empty unless doubles prove that it does. `ideal`
/// encloses its ideal error.
std::optional<records::Enclosure> excess_of(const PlacementFilter& filter, const ValueFilter& value,
                                            const ShiftedReadings& readings,
                                            const BatchWeights& weights, const BatchShifts& shifts,
                                            std::size_t lane, double computed,
                                            const records::Enclosure& ideal);

}  // namespace rastercheck::oracle
