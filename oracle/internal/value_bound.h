#pragma once

#include <cstddef>
#include <optional>

#include "cases/case.h"
#include "cases/contract.h"
#include "oracle/internal/triangle_setup.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// The bound that the contract promises for an attribute, or for the depth if `attribute` is empty;
/// 0 for a flat attribute.
cases::ValueBound bound_of(const TriangleSetup& triangle, std::optional<std::size_t> attribute);

/// The reason why any value of an attribute (of the depth if `attribute` is empty) is right all
/// over a drawn triangle; empty if values are judged.
std::optional<records::NotJudged> why_free(const TriangleSetup& triangle,
                                           std::optional<std::size_t> attribute);

/// A lower limit of the bound at every place where an attribute, or the depth, is judged. An error
/// within this limit needs no further test.
double least_bound(const TriangleSetup& triangle, std::optional<std::size_t> attribute);

/// g of cases::ValueBound at a point: the greatest 1/w of the triangle's vertices (of its corners
/// after clipping if some w <= 0), divided by 1/w at the point. Empty if 1/w <= 0, and of lines
/// that cross w = 0.
std::optional<Field> horizon_ratio(const TriangleSetup& triangle, const HomogeneousPoint& p);

/// K of cases::ValueBound at a point, for values linear in window space (`is_affine`) or in clip
/// space. Empty if the divisor is not positive.
std::optional<Field> condition(const TriangleSetup& triangle, bool is_affine,
                               const HomogeneousPoint& p);

}  // namespace rastercheck::oracle
