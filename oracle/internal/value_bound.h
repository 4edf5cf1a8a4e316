#pragma once

#include <cstddef>
#include <optional>

#include "cases/case.h"
#include "cases/contract.h"
#include "oracle/internal/triangle_setup.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// What the contract promises of an attribute, or of the depth where there is none; 0 of flat ones.
cases::ValueBound bound_of(const TriangleSetup& triangle, std::optional<std::size_t> attribute);

/// Why any value of an attribute, or of the depth where there is none, is right all over a triangle
/// that is drawn; nothing where it is not.
std::optional<records::NotJudged> why_free(const TriangleSetup& triangle,
                                           std::optional<std::size_t> attribute);

/// A number that the bound at every place where an attribute, or the depth, is judged reaches: what
/// is found within it needs no further question.
double least_bound(const TriangleSetup& triangle, std::optional<std::size_t> attribute);

/// g of cases::ValueBound at a point: the greatest 1/w of the triangle's vertices (of its corners
/// after clipping where some w <= 0), divided by 1/w there. Nothing where 1/w <= 0.
std::optional<Field> horizon_ratio(const TriangleSetup& triangle, const HomogeneousPoint& p);

/// K of cases::ValueBound at a point, of what is linear in window space or in clip space. Nothing
/// where the divisor is not positive.
std::optional<Field> condition(const TriangleSetup& triangle, bool is_affine,
                               const HomogeneousPoint& p);

}  // namespace rastercheck::oracle
